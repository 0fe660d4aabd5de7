"""pbreport study: what accuracy costs in time, and the setting to choose; the file of pbstudy accuracy."""
import dataclasses
import math

from reports import errors
from reports.files import in_order_of

# By name: what of a case's errors it is. Settings are ranked by one of them; lengths in m.
MEASURES = {"rms": ("body_position", "rms"), "p99": ("body_position", "p99"), "max": ("body_position", "max"), "joint": ("joint_position", "rms")}
LISTS = {"setting": "settings", "estimate": "estimates", "floor": "floor", "own": "own", "own_floor": "own_floor"}


class Case:
    """A row of /cases: a setting, an estimate, or what says how far the reference is to be trusted. NaN: not measured."""

    def __init__(self, row):
        self.row = row
        self.scene, self.kind, self.stepper = row.scene, row.kind, row.stepper
        self.time_s, self.median_time_s = row.frame_time_worst, row.frame_time_median  # of a measured frame; a budget must hold the worst
        self.joint_gap_m, self.penetration_m = row.joint_gap, row.penetration
        self.own = row.own  # the row of its own solution: its equations, solved by its own stepper; -1: none
        self.defect, self.drift, self.own_defect = (errors.read(row, table) for table in ("defect", "drift", "own_defect"))

    @property
    def iterates(self):
        return self.stepper != "direct"

    def finite(self):
        """Did every body and joint stay finite?"""
        return errors.all_finite(self.defect)

    def fells(self):
        """Does it make something fall that should stand, as far as the study knows?"""
        return self.row.rest_fallen > 0

    def has_own(self):
        """Was it compared with its own solution?"""
        return self.own_defect["body_position"].count > 0

    def error_m(self, measure):
        kind, what = MEASURES[measure]
        return getattr(self.defect[kind], what)

    def own_error_m(self, measure):
        """Against its own solution; NaN without one."""
        kind, what = MEASURES[measure]
        return getattr(self.own_defect[kind], what) if self.has_own() else math.nan

    def setting(self):
        """"sor single, 14 x 1, look at 2 after 1 step, dt 0.01 s"."""
        text, row = self.row.setting, self.row
        if row.estimate_iterations > 0:
            text += f", look at {row.estimate_iterations}" if row.estimate_source == "same_solve" else f", {row.estimate_iterations} a step"
            if row.estimate_after > 0:
                text += f" after {row.estimate_after} step{'' if row.estimate_after == 1 else 's'}"
        return f"{text}, dt {row.dt:g} s"


@dataclasses.dataclass
class SceneCases:
    """The cases of a scene by their kinds. `own_floor`: own solutions from disturbed starts. `judges`: the cases of which there is one, by
    kind: reference, more_iterations, second_method, halved_dt. Estimates are never chosen, since more work follows them."""
    name: str
    settings: list = dataclasses.field(default_factory=list)
    estimates: list = dataclasses.field(default_factory=list)
    floor: list = dataclasses.field(default_factory=list)
    own: list = dataclasses.field(default_factory=list)
    own_floor: list = dataclasses.field(default_factory=list)
    judges: dict = dataclasses.field(default_factory=dict)

    def add(self, case):
        if case.kind in LISTS:
            getattr(self, LISTS[case.kind]).append(case)
        else:
            self.judges[case.kind] = case

    def floor_m(self, measure):
        """The noise floor: the largest error that another seed alone gave the reference."""
        return max((0.0, *(one.error_m(measure) for one in self.floor)))

    def own_floor_m(self, stepper, measure):
        """The noise floor of a stepper's own solution: the largest error that another start and seed gave it. NaN: none was measured."""
        found = [one.own_error_m(measure) for one in self.own_floor if one.stepper == stepper]
        return max((error for error in found if not math.isnan(error)), default=math.nan)

    def uncertainty(self, error):
        """How far the reference may be off, by error(case): its largest distance from itself with other seeds and more iterations, and
        from a second method. Not the effect of the step's length, which all settings share."""
        judges = [self.judges[kind] for kind in ("more_iterations", "second_method") if kind in self.judges]
        return max((0.0, *map(error, self.floor + judges)))

    def uncertainty_m(self, measure):
        return self.uncertainty(lambda one: one.error_m(measure))

    def pareto_front(self, error):
        """The settings that no other beats in both time and error(case), by ascending time: the error falls from each to the next. Not
        those that blew up, or whose error is infinite."""
        front, least = [], math.inf
        for one in sorted(filter(Case.finite, self.settings), key=lambda one: (one.time_s, error(one))):
            if error(one) < least:
                least = error(one)
                front.append(one)
        return front

    def front(self, measure):
        return self.pareto_front(lambda one: one.error_m(measure))

    def standing_front(self, measure):
        """The front of the settings that let nothing fall at rest."""
        return self.pareto_front(lambda one: math.inf if one.fells() else one.error_m(measure))


def scenes_of(study, names=()):
    """[SceneCases] in the order of the file, or of `names`."""
    scenes = {}
    for case in map(Case, study.rows()):
        scenes.setdefault(case.scene, SceneCases(case.scene)).add(case)
    return in_order_of(names, list(scenes.values()), lambda scene: scene.name)
