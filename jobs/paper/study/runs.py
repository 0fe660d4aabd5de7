"""The runs of one case: pbmpi under pbvalue, compared with the unpredicted run."""
import json
import math
import pathlib
import tempfile

from reports.errors import KINDS
from study import child
from study.cases import VARIANTS


class CaseRuns:
    """Runs of a case's program, whose files lie in `folder`. `request`: "programs", the folder of pbmpi; "tool", that of pbvalue; "options" of the
    study, the "scene", the "case"."""

    def __init__(self, request, folder):
        self.request, self.folder = request, folder
        self.options, self.scene, self.case = request["options"], request["scene"], request["case"]

    def program(self, name):
        return f"{self.request['programs']}/{name}"

    def start(self, command, name):
        return child.run(command, self.folder / name, self.options["time_limit_s"], VALGRIND_LIB=self.request["tool"])

    def simulate(self, name, iterations, tool=(), more=(), steps=0):
        """Runs pbmpi over all frames of the scene; it writes NAME.h5. `tool`: a command to put before it; `more`: its last options; `steps`: of a
        frame, in place of the scene's."""
        scene, case = self.scene, self.case
        steps = steps or scene["steps_per_frame"]
        frames = (scene["warmup"] + scene["frames"]) * scene["steps_per_frame"] // steps
        command = [*tool, self.program(case["program"]), "--scene", scene["given"], "--stepper", case["stepper"], "--warmup", 0, "--frames", frames,
                   "--steps-per-frame", steps, "--replicas", scene["worlds"], "--output", self.folder / f"{name}.h5",
                   "--report", "json", "--progress", "never", "--seed", self.options["seed"], *more]
        if case["stepper"] == "quick":
            command += ["--iterations", iterations]
        return self.start(list(map(str, command)), name)

    def difference(self, name, reference):
        """What "pbreport diff" says of NAME.h5; None if nothing can be compared."""
        return self.start([self.program("pbreport"), "diff", f"{self.folder}/{name}.h5", str(reference), "--json"], "diff").summary


def islands(summary, which):
    """Mean or largest number of islands of a run; not finite if unknown. `which`: "mean" or "max"."""
    return (summary or {}).get("islands", {}).get(which, math.nan)


def joined_errors(frames):
    """The errors of tables that "pbreport diff" made of one frame each, joined: {kind: {what: number}}. No p99, which cannot be computed from theirs.
    The rms is over entries that have a finite error, as in each table."""
    joined = {}
    for kind, unit in KINDS.items():
        squares, num_finite, largest, broken, bands = 0.0, 0, 0.0, 0, [0] * 5
        for errors in (frame[f"{kind}_{unit}"] for frame in frames):
            rms, most = (math.inf if errors[size] is None else errors[size] for size in ("rms", "max"))
            finite = errors["count"] - errors["broken"] - errors["bands"][-1]
            squares += finite * rms * rms if finite else 0.0
            num_finite += finite
            largest = max(largest, most)
            broken += errors["broken"]
            bands = [sum(pair) for pair in zip(bands, errors["bands"])]
        joined[kind] = {"rms": math.sqrt(squares / num_finite) if num_finite else 0.0, "max": largest, "bands": bands, "broken": broken}
    return joined


def unpredicted(request, folder):
    """The run that all cases of a scene and a stepper are compared with: with the scene's iterations and without FEEC, whatever the case's. Its file,
    its islands, and as "floor" its drift over the measured frames when only the solver's seed differs. Kept in `folder`."""
    case, scene = request["case"], request["scene"]
    kept = folder / f"base-{case['scene']}-{case['program']}-{case['stepper']}.kept"
    if not kept.exists():
        runs = CaseRuns(request, folder)
        base = runs.simulate(kept.stem, scene["iterations"])
        base.require_end(": the unpredicted run")
        seed = (request["options"]["seed"] + 1) % 2**64
        runs.simulate("floor", scene["iterations"], more=("--solver-seed", seed)).require_end(": the run of another seed")
        found = runs.difference("floor", kept.with_suffix(".h5"))
        kept.write_text(json.dumps({"islands": islands(base.summary, "mean"),
                                    "floor": joined_errors(found["drift_by_frame"][scene["warmup"]:] if found else [])}), encoding="utf-8")
    return json.loads(kept.read_text(encoding="utf-8")) | {"file": kept.with_suffix(".h5")}


def tool_command(request, report):
    """The words before pbmpi, without models of a processor."""
    case = request["case"]
    return ["valgrind", "--quiet", "--tool=pbvalue", f"--pbvalue-out-file={report}", f"--scope={case['scope']}",
            *([f"--threshold={case['threshold']:.17g}"] if case["threshold"] > 0 else []), *request["options"]["tool_options"]]


def model_options(request):
    case = request["case"]
    words = [f"--first-modelled={request['scene']['warmup']}", "--modelled=estimate" if case["feec"] else "--modelled=precise",
             "--model=none", "--model=predicted:predict=1"]
    for index, settings in enumerate(VARIANTS.values()):
        if case["has_variants"] and index > 0:
            words += [f"--model=none{index}:{settings}", f"--model=predicted{index}:{settings},predict=1"]
    return words


def compare(runs, base, result):
    """Adds to the result how far the run is from the unpredicted one."""
    found = runs.difference("run", base["file"])
    if found is None:
        return
    drift = found["drift_by_frame"]
    measured = drift[runs.scene["warmup"]:]
    if runs.case["feec"] and "estimate_drift" in found:
        measured = [found["estimate_drift"]]
    result.update(errors_known=1, same_hash=int(found["same_state_hash"]), defect=joined_errors(drift[:1]), drift=joined_errors(measured),
                  floor=base["floor"])


def run_case(request, folder):
    """What came out of a case: the columns of /cases that are not 0 by themselves, and as "sections" the tool's report. Raises child.RunError if a run
    ends as none should; its message goes on after the case's name."""
    case = request["case"]
    base = unpredicted(request, folder)
    with tempfile.TemporaryDirectory(dir=folder) as own:
        runs = CaseRuns(request, pathlib.Path(own))
        tool = tool_command(request, f"{own}/tool")
        run = runs.simulate("run", case["iterations"], tool + (model_options(request) if case["has_cycles"] else []),
                            ["--feec"] if case["feec"] else [])
        result = {"exit_code": run.exit_code, "sections": []}
        if case["threshold"] == 0:
            run.require_end("")  # fuzzy values may well crash the program
        if not run.has_ended_well:
            return result
        report = child.json_in(runs.folder / "tool")
        if report is None:
            raise child.RunError(f": pbvalue wrote no report\n{run.errors}")
        result.update(ended=1, sections=report["sections"], islands_mean=islands(run.summary, "mean"), islands_max=islands(run.summary, "max"),
                      base_islands_mean=base["islands"], nonfinite_frame=run.nonfinite_frame)
        compare(runs, base, result)
        if run.nonfinite_frame >= 0:  # which step of it: a run with one step a frame
            steps = runs.simulate("steps", case["iterations"], tool, steps=1)
            result["nonfinite_step"] = steps.nonfinite_frame if steps.has_ended_well else -1
        return result
