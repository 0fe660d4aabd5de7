"""pbreport effects: what each effect costs, and what leaving it out does to the result; the file of pbstudy effects."""
import dataclasses
import math

from reports import charts, errors, page
from reports.command_line import Command, add_scene_option, deliver, one_file, parse
from reports.document import MARKDOWN, PAGE, TEXT, Chart, Column, Report, Section, Table
from reports.files import in_order_of, read_study
from reports.words import NO_NUMBER, percent, plural, stepper_in

COMMAND = Command("effects", "Shows what each effect costs: the file of pbstudy effects. The word effects may be left out.",
                  "effects.h5 [options]", page="share of the step and error if left out, effect by scene",
                  markdown="print a table a stepper instead: share of the step [%%] and defect without the effect, in brackets what demanding "
                  "it costs", csv="all cases as comma-separated values", add_options=add_scene_option)


class Effect:
    """A row of /cases: an effect that was left out, or demanded, and what that changed. `kind` floor: another solver seed alone."""

    def __init__(self, row):
        self.row = row
        self.name, self.kind, self.reason = row.effect, row.kind, row.reason
        self.same_bits = None if row.same_bits < 0 else row.same_bits == 1  # None: it was not measured
        self.defect, self.drift = errors.read(row, "defect"), errors.read(row, "drift")

    @property
    def measured(self):
        return self.same_bits is not None

    @property
    def demanded(self):
        return self.kind == "demanded"

    @property
    def share(self):
        return self.row.time_share

    def note(self):
        if not self.measured:
            return self.reason
        bits = "; no bit changes" if self.same_bits else ""
        if self.reason.startswith("nothing calls for it") and not self.same_bits:
            bits = "; AND YET THE RESULT CHANGES"
        return f"{'demanded' if self.demanded else 'left out'}: {self.reason}{bits}"


@dataclasses.dataclass
class Scene:
    """The effects of a scene with one stepper, and its noise floor."""
    name: str
    stepper: str
    floor: list = dataclasses.field(default_factory=list)
    effects: list = dataclasses.field(default_factory=list)

    def find(self, effect):
        return next((one for one in self.effects if one.name == effect), None)

    def floor_error(self, table):
        return max((getattr(one, table)["body_position"].rms for one in self.floor), default=0.0)

    def floor_share(self):
        return max((abs(one.share) for one in self.floor), default=0.0)

    def step_s(self):
        return self.floor[0].row.time_with if self.floor else math.nan

    def setting(self):
        if not self.effects:
            return self.stepper
        row = self.effects[0].row
        return f"{row.setting}, {plural(row.worlds, 'world')}"


def scenes_of(study, names):
    scenes = {}
    for row in study.rows():
        stepper = stepper_in(row.setting)
        scene = scenes.setdefault((row.scene, stepper), Scene(row.scene, stepper))
        (scene.floor if row.kind == "floor" else scene.effects).append(Effect(row))
    return in_order_of(names, list(scenes.values()), lambda scene: scene.name)


def millimetres(metres):
    """"44 mm", "0.2 mm"; "0" below 5 um."""
    if not math.isfinite(metres):
        return NO_NUMBER
    value = 1e3 * metres
    return "0" if value < 5e-3 else f"{value:.0f} mm" if value >= 1 else f"{value:.1g} mm"


def whole_percent(share):
    return str(math.floor(abs(100 * share) + 0.5) * (1 if share > 0 else -1)) if math.isfinite(share) else NO_NUMBER


def matrix_cell(scene, effect):
    """In brackets what demanding an effect costs; empty where it was not measured."""
    one = scene.find(effect)
    if one is None or not one.measured:
        return ""
    share = whole_percent(one.share)
    if one.demanded:
        return f"({share})" if one.same_bits else f"({share}), other bits"
    return f"{share}, {millimetres(one.defect['body_position'].rms)}"


def matrix(scenes, title=""):
    """An effect a row and a scene a column: what a reader compares."""
    columns = [Column(scene.name, lambda effect, scene=scene: matrix_cell(scene, effect)) for scene in scenes]
    measured = [one.name for one in scenes[0].effects if any(matrix_cell(scene, one.name) for scene in scenes)]
    table = Table.of(title, [Column(f"`{scenes[0].stepper}`", "`{}`".format), *columns], measured, of_words=True)
    table.rows.append(["noise floor", *(f"{whole_percent(scene.floor_share())}, {millimetres(scene.floor_error('defect'))}" for scene in scenes)])
    return table


def error_cell(table):
    return lambda one: "" if not one.measured else "0" if one.same_bits else f"{1e3 * getattr(one, table)['body_position'].rms:.4g}"


def if_measured(cell):
    return lambda one: cell(one) if one.measured else ""


COLUMNS = (Column("effect", lambda one: one.name),
           Column("step us", if_measured(lambda one: f"{1e6 * one.row.time_with:.2f}")),
           Column("cost us", if_measured(lambda one: f"{1e6 * one.row.time_cost:.2f}")),
           Column("of the step", if_measured(lambda one: percent(one.share))),
           Column("[p10, p90]", if_measured(lambda one: f"[{percent(one.row.time_share_p10)}, {percent(one.row.time_share_p90)}]")),
           Column("defect mm", error_cell("defect")), Column("drift mm", error_cell("drift")),
           Column("bodies by drift", lambda one: errors.bands_text(one.drift["body_position"]) if one.measured and not one.same_bits else ""),
           Column("", Effect.note))


def scene_section(scene):
    defect, drift = (f"{1e3 * scene.floor_error(table):.4g}" for table in ("defect", "drift"))
    text = (f"A step takes {1e6 * scene.step_s():.1f} us as the scene is. Noise floor (largest of {len(scene.floor)} other solver seeds): "
            f"time {percent(scene.floor_share())} of a step, defect rms {defect} mm, drift rms {drift} mm.")
    return Section(f"{scene.name}, {scene.setting()}", text, tables=[Table.of("", COLUMNS, scene.effects)], shown_in=(TEXT, PAGE))


def bars(title, text, axis, scenes, value, noise=False, errors_of_floor=False):
    """A group of bars for each effect, a bar for each scene; value(effect): a number, or None. `noise`: the band of shares that another
    solver seed alone seems to cost; `errors_of_floor`: bars of the errors that it causes."""
    names = [one.name for place, one in enumerate(scenes[0].effects) if any(value(scene.effects[place]) is not None for scene in scenes)]
    sets = []
    for place, scene in enumerate(scenes):
        values = [(one.name, value(one)) for one in scene.effects if value(one) is not None]
        if errors_of_floor:
            values.append(("noise floor", 1e3 * scene.floor_error("defect")))
        points = [charts.point(name, y, f"{scene.name}: {y:.3g}") for name, y in values]
        sets.append(charts.bars(scene.name, points, charts.COLOURS[place % len(charts.COLOURS)]))
    share = max(100 * scene.floor_share() for scene in scenes)
    marks = {"bands": [charts.band(-share, share, "noise floor", align="right")]} if noise else {}
    scale = "logarithmic" if errors_of_floor else "linear"
    return Chart(title, text, charts.chart("bar", sets, {"y": charts.axis(axis, scale)}, names + ["noise floor"] * errors_of_floor, **marks))


def share_of(demanded):
    return lambda one: 100 * one.share if one.measured and one.demanded == demanded else None


def defect_mm(one):
    return 1e3 * one.defect["body_position"].rms if one.measured and not one.same_bits else None


def overview(stepper, scenes):
    """What a page shows first of a stepper; Markdown shows its table alone."""
    text = ("Each case does the scene's measured frames with and without an effect, in turn, from the same states. The share is what the "
            "effect adds, of the time of the step that has it (medians); below zero the scene's step is shorter with it.")
    shown = [bars("Share of the step time", "Effects that the scene has.", "share of the step [%]", scenes, share_of(False), noise=True),
             bars("Error if left out", "Defect of all bodies after one frame, against the scene as it is.", "defect, rms [mm]", scenes,
                  defect_mm, errors_of_floor=True),
             bars("Demanded though the scene has it not", "What it costs; where nothing calls for it no bit of the result changes.",
                  "share of the step [%]", scenes, share_of(True), noise=True)]
    title = "Share of the step [%], defect rms if left out; in brackets what demanding costs where the scene has it not"
    return Section(stepper, text, shown, [matrix(scenes, title)], shown_in=(PAGE,))


def spread_json(row, name):
    return {"median": getattr(row, name), "p10": getattr(row, f"{name}_p10"), "p90": getattr(row, f"{name}_p90")}


def effect_json(one):
    found = {"effect": one.name, "kind": one.kind, "called_for": one.row.called_for == 1, "reason": one.reason}
    if not one.measured:
        return found
    found |= {"same_bits": one.same_bits, "time_s": {what: spread_json(one.row, f"time_{what}") for what in ("with", "without", "cost")},
              "share": spread_json(one.row, "time_share")}
    return found | {table: errors.json_of(getattr(one, table)) for table in ("defect", "drift")}


def scene_json(scene):
    floor = {"share": scene.floor_share(), "defect_m": scene.floor_error("defect"), "drift_m": scene.floor_error("drift")}
    return {"scene": scene.name, "stepper": scene.stepper, "step_s": scene.step_s(), "noise_floor": floor,
            "effects": list(map(effect_json, scene.effects))}


def report_of(study, names):
    scenes = scenes_of(study, names)
    steppers = {}
    for scene in scenes:
        steppers.setdefault(scene.stepper, []).append(scene)
    tables = [Section(tables=[matrix(some)], shown_in=(MARKDOWN,)) for some in steppers.values()]
    head = ("study: effects; both sides of a case start each frame from the scene's own state, in turn\n"
            "cost: with the effect - without it, median, of the processor time of a step of all worlds\n"
            "error if left out: all body positions against the scene as it is; defect after one frame, drift at the end of the\n"
            f"measured window; bodies {'/'.join(errors.BANDS)}\n")
    line, entries = page.origin_of_study(study)
    return Report("What effects cost", study.path, [*tables, *(overview(stepper, some) for stepper, some in steppers.items()), *map(scene_section, scenes)],
                  {"scenes": list(map(scene_json, scenes))}, head, line, entries)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    study = read_study(one_file(options, "a study of effects", "effects.h5"), "effects")
    deliver(report_of(study, options.scene), options, study.tables["cases"])
