"""Writes the file of a joined run, which holds all that the file of an uninterrupted run holds, but for its checksums: pbreport adds them, and gives
the file its name."""
import os

import h5py
import numpy as np

from reports.command_line import put
from reports.files import BadInput, require
from reports.join.events import JoinedEvents
from reports.join.objects import Copier, require_same_objects, set_attribute
from reports.join.output import Output
from reports.join.plan import Plan, end_of
from reports.join.tables import EVENTS, datasets_of, name_of, require_equal_overlaps, shapes_of, tables_of, write_tables
from reports.runs import ESTIMATE, NOTHING, RESULTS, SEED, Run, difference_text, differences

WORLD_RESULTS = "world_results"  # what each part says of its own frames
UNTOLD = ("resumed_from", "joined_from", "frames")  # parameters that always differ


def open_all(paths):
    """All runs, sorted by first frame, and by their ends where those are equal."""
    for place, path in enumerate(paths):
        require(not any(os.path.samefile(path, other) for other in paths[:place]), f"{path}: it is named twice; name each file once")
    return sorted(map(Run, paths), key=lambda run: (run.first_frame, end_of(run)))


def require_one_run(a, b):
    """Raises BadInput unless two files are of one run."""
    for name, advice in (("version", "only files of one layout can be"), ("pbmpi_version", "only one version of pbmpi gives the same bits"),
                         ("scene", "they are of two runs"), ("record_every", "record all with the same interval")):
        one, other = (run.attributes.get(name, "(none)") for run in (a, b))
        require(one == other, f"{a.path} and {b.path} cannot be joined: {name} is {one} and {other}; {advice}")
    for matters in (RESULTS, SEED, ESTIMATE):
        for difference in differences(a, b, matters):
            raise BadInput(f"{a.path} and {b.path} are not of one run: {difference_text(difference, a, b)}")
    growing = [path for name, table in tables_of(a).items() for path in datasets_of(name, table)]
    require_same_objects(a, b, [*growing, *(f"events/{name}" for name in a.file["events"]), f"checksums/{EVENTS}", *results_in(a)])


def require_steps(run):
    """Raises BadInput unless all frames have the same number of steps, starting from the first frame."""
    steps, frames = run.frames("timings/frame/step"), run.first_frame + np.arange(run.num_frames)
    for row in np.flatnonzero(steps != (frames + 1) * int(run.number("steps_per_frame"))):
        raise BadInput(f"{run.path}: frame {frames[row]} ends with step {steps[row]}, which is none of one run")


def results_in(run):
    return [f"{WORLD_RESULTS}/{name}" for name in run.file.get(WORLD_RESULTS, {})]


def common_tables(parts, common_only):
    """The tables of the first part that all have; [(name, datasets)] of those that only some have. Raises BadInput for these unless `common_only`."""
    tables = [tables_of(part) for part in parts]
    of_some = {name: table for of_part in tables for name, table in of_part.items() if not all(name in other for other in tables)}
    require(not of_some or common_only, f"not all files have {', '.join(map(name_of, of_some))} (--record contacts and its like are to be asked for "
            "again with --resume); --common leaves out what only some have")
    return {name: table for name, table in tables[0].items() if name not in of_some}, [(name_of(name), datasets_of(name, table))
                                                                                       for name, table in of_some.items()]


def write_ranks(parts, file):
    """The ranks and hosts of the part with the most ranks; a rank that had another host before lists both."""
    num_ranks = max(part.num_ranks for part in parts)
    hosts = [dict.fromkeys(part.hosts[rank] for part in parts if rank < part.num_ranks) for rank in range(num_ranks)]
    names = [", ".join(names).encode() for names in hosts]
    worlds = np.zeros(num_ranks, np.int32)
    worlds[:parts[0].num_ranks] = parts[0].column("ranks/worlds_at_start")
    file["ranks/rank"] = np.arange(num_ranks, dtype=np.int32)
    file["ranks/host"] = np.array(names, h5py.string_dtype("utf-8", max(map(len, names))))
    file["ranks/worlds_at_start"] = worlds


def differences_from(first, other):
    """How a part differs from the first in settings that do not matter, e.g. "ranks is 3"."""
    texts = [f"{name} is {value}" for name, _, value in differences(first, other, NOTHING) if name not in UNTOLD and not name.startswith("env_")]
    revision = other.attributes.get("git_revision", "")
    return texts + ([f"git_revision is {revision}"] if revision != first.attributes.get("git_revision", "") else [])


def frames_of(parts, plan):
    """[parts] "a.h5: frames 0 to 5, 4 of them taken", and how each differs from the first."""
    used = [sum(stretch.count for stretch in plan.stretches if stretch.part == index) for index in range(len(parts))]
    return [(f"{part.path}: frames {part.first_frame} to {end_of(part) - 1}, {count} of them taken", differences_from(parts[0], part))
            for part, count in zip(parts, used)]


def provenance(parts, plan):
    """For /parameters/joined_from: a line a part, each followed by those of the part's own parts."""
    lines = []
    for part, (frames, differs) in zip(parts, frames_of(parts, plan)):
        lines.append("; ".join([f"{frames}; created {part.attributes['created']}", *differs]))
        lines += [f"  {line}" for line in part.parameter("joined_from").splitlines()]
    return "".join(f"{line}\n" for line in lines)


def write_end(parts, plan, events, file):
    """What the end of a run writes: of the last part's."""
    last = parts[plan.stretches[-1].part]
    text = provenance(parts, plan).encode()
    file["parameters/frames"] = np.int64(last.parameter("frames"))
    file["parameters/ranks"] = np.int64(max(part.num_ranks for part in parts))
    file["parameters/joined_from"] = np.array(text, h5py.string_dtype("utf-8", len(text)))
    for name, value in (("frames_committed", plan.num_frames), ("complete", int(last.complete)), ("state_hash", last.file.attrs["state_hash"])):
        set_attribute(file, name, value)
    for name, count in events.counts.items():
        set_attribute(file["events"], name, count)


def write(parts, plan, tables, left_out, events, output):
    with h5py.File(output, "w") as file:
        Copier(parts[0].file, file, shapes_of(parts, tables, plan, len(events.rows)), [*left_out, *results_in(parts[0])]).run()
        write_ranks(parts, file)
        write_tables(parts, tables, plan, file)
        events.write(file)
        write_end(parts, plan, events, file)


def text_of(parts, plan, left_out, output):
    lines = ["; ".join([frames, *differs]) for frames, differs in frames_of(parts, plan)]
    lines += [f"left_out: {name}, which not all files have" for name in left_out]
    last = parts[plan.stretches[-1].part]
    lines += [f"{output}: frames {plan.first} to {plan.first + plan.num_frames - 1}, {'complete' if last.complete else 'incomplete'}",
              f"state_hash: {last.state_hash}"]
    return "".join(f"{line}\n" for line in lines)


def run(words):
    """`words`: the file to write, the name that it is to get, "common" or "all" tables, "quiet" or "loud", the files of the parts."""
    path, output, tables, loud, *files = words
    parts = open_all(files)
    for part in parts:
        require_steps(part)
    for part in parts[1:]:
        require_one_run(parts[0], part)
    plan = Plan(parts, parts[0].record_every)
    tables, of_some = common_tables(parts, tables == "common")
    require_equal_overlaps(parts, tables, plan)
    events = JoinedEvents(parts, plan)
    file = Output(path)
    try:
        write(parts, plan, tables, [path for _, paths in of_some for path in paths], events, file)
    finally:
        file.finish(output)
    if loud == "loud":
        put(text_of(parts, plan, [name for name, _ in of_some], output))
