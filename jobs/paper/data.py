"""What jobs/paper.sh has measured, sorted by kind of file."""
import dataclasses
import pathlib

from reports.files import RUN, STUDY, BadInput, require

import figures
import instructions
import prediction
import runs
import suite


@dataclasses.dataclass
class PaperData:
    """All that the statements are judged by."""
    suite: list = dataclasses.field(default_factory=list)  # quick with 20 iterations
    one_iteration: list = dataclasses.field(default_factory=list)  # the cost of FEEC's estimate
    more_iterations: list = dataclasses.field(default_factory=list)  # works with any other number
    direct: list = dataclasses.field(default_factory=list)  # works
    plain: list = dataclasses.field(default_factory=list)  # (scene, passages) without pbmpi's contacts ahead of fast bodies
    figures: list = dataclasses.field(default_factory=list)
    counts: list = dataclasses.field(default_factory=list)
    prediction: object = None
    stability: dict = None  # as `pbreport stability --json` prints it
    files: list = dataclasses.field(default_factory=list)  # runs.Source of all that were read

    def find(self, scene):
        return next((one for one in self.suite if one.scene == scene), None)

    def works(self):
        return [one.work for one in self.suite]

    def find_figure(self, scene):
        return next((one for one in self.figures if one.name == scene), None)

    def scenes_with(self, *labels):
        """The scenes of the paper's Figures 8 and 9 that have all of these methods."""
        found = [self.find_figure(name) for name in figures.SCENES]
        return [scene for scene in found if scene and all(map(scene.find, labels))]


def files_of(paths):
    """[(path, is it named itself?)]: files, and all .h5 and .json files below folders."""
    found = []
    for path in map(pathlib.Path, paths):
        if path.is_dir():
            below = [one for one in path.rglob("*") if one.is_file() and one.suffix in (".h5", ".json")]
            found += [(str(one), False) for one in sorted(below, key=str)]
        else:
            found.append((str(path), True))
    return found


def add_study(path, is_named, kind, data):
    if kind in ("prediction", "stability"):
        require(getattr(data, kind) is None, f"{path}: a second study of {kind}; name one")
    if kind == "prediction":
        data.prediction = prediction.read_study(path)
    elif kind == "stability":
        data.stability = runs.pbreport("stability", path)
    elif is_named:
        raise BadInput(f"{path}: a study of {kind}, which decides nothing of the paper")
    else:
        return
    data.files.append(runs.source_of(path))


def add_counts(path, is_named, data):
    if not is_named and not instructions.is_of_counts(instructions.document_of(path)):
        return
    require(not data.counts, f"{path}: second counts of instructions; name one file")
    data.counts = instructions.read_counts(path)
    data.files.append(instructions.source_of(path))


def add_profiled(run, profiled):
    """Runs of one scene and setting are repeats, of which each time is the least."""
    setting = tuple(run.parameter(name) for name in ("scene", "stepper", "iterations"))
    if setting not in profiled:
        profiled[setting] = run
        return
    runs.require_same_state(run, profiled[setting])
    runs.keep_least(profiled[setting], run)


def sort_in(run, data):
    if run.parameter("stepper") == "direct":
        data.direct.append(suite.work_of(run))
    elif run.parameter("iterations") == "20":
        data.suite.append(suite.suite_of(run))
    elif run.parameter("iterations") == "1":
        data.one_iteration.append(suite.suite_of(run))
    else:
        data.more_iterations.append(suite.work_of(run))


def read(paths):
    """Scenes come out in the order of the paper's Table 1. A file that is named but of no use is refused; below folders other kinds
    are passed over."""
    data, profiled, recorded = PaperData(), {}, []
    for path, is_named in files_of(paths):
        if path.endswith(".json"):
            add_counts(path, is_named, data)
            continue
        filetype, kind = runs.kind_of(path)
        if filetype == STUDY:
            add_study(path, is_named, kind, data)
        elif is_named or filetype == RUN:
            run = runs.Run(path)
            data.files.append(runs.Source(path, run.attributes))
            if "-fast_bodies" in run.parameter("effects"):
                data.plain.append((run.scene, run.events.get("passage", 0)))
            elif run.profile is None:
                recorded.append(run)
            else:
                add_profiled(run, profiled)
    require(data.files, "paper: no file of jobs/paper.sh found in what is named")
    for run in profiled.values():
        sort_in(run, data)
    data.figures = figures.scenes_of(recorded)
    for scenes in (data.suite, data.one_iteration, data.direct):
        scenes.sort(key=lambda one: suite.place_of(one.scene))
    data.figures.sort(key=lambda one: suite.place_of(one.name))
    return data
