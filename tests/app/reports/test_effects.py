"""pbreport effects: costs, errors and noise floors in words and numbers."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import document, effects, errors, page, words  # noqa: E402
from reports.command_line import one_file, parse  # noqa: E402
from reports.files import BadInput, Study  # noqa: E402


def row(effect, called_for, same_bits, share, scene="Crash", stepper="quick", kind=None, **others):
    """A row of /cases; `same_bits` None: it was not measured."""
    found = {"scene": scene, "setting": f"{stepper}, 1 x 20", "effect": effect,
             "kind": kind or ("left_out" if called_for else "demanded"), "reason": "3 things" if called_for else "nothing calls for it",
             "called_for": int(called_for), "same_bits": -1 if same_bits is None else int(same_bits), "worlds": 1}
    for name in ("time_with", "time_without", "time_cost", "time_share"):
        found |= {name: share, f"{name}_p10": share, f"{name}_p90": share}
    for table in ("defect", "drift"):
        for error in errors.KINDS:
            found |= {f"{table}_{error}_{what}": 0.0 for what in ("rms", "p99", "max")} | {f"{table}_{error}_bands": [1, 0, 0, 0, 0]}
    return found | others


def floor(share, **others):
    return row("", False, False, share, kind="floor", **others)


def report_of(*rows, **parameters):
    study = Study("effects.h5", {}, parameters, {"cases": {name: [one[name] for one in rows] for name in rows[0]}})
    return effects.report_of(study, [])


def only_scene(*rows):
    study = Study("effects.h5", {}, {}, {"cases": {name: [one[name] for one in rows] for name in rows[0]}})
    return effects.scenes_of(study, [])[0]


class Numbers(unittest.TestCase):
    def test_the_noise_floor_is_the_largest_of_the_seeds_in_either_direction(self):
        scene = only_scene(floor(0.01, defect_body_position_rms=2e-3), floor(-0.03, drift_body_position_rms=5e-3))
        self.assertEqual((scene.floor_share(), scene.floor_error("defect"), scene.floor_error("drift")), (0.03, 2e-3, 5e-3))

    def test_says_when_an_unneeded_effect_changed_the_result(self):
        def note(*values):
            return only_scene(row("friction", *values)).effects[0].note()
        self.assertEqual(note(False, True, 0), "demanded: nothing calls for it; no bit changes")
        self.assertIn("AND YET THE RESULT CHANGES", note(False, False, 0))
        self.assertEqual(note(True, False, 0), "left out: 3 things")

    def test_shares_are_percent_and_nothing_is_a_dash(self):
        self.assertEqual([words.percent(share) for share in (0.572, -0.0001, float("nan"))], ["57.2 %", "0.0 %", "-"])


class Printed(unittest.TestCase):
    def test_markdown_has_a_table_a_stepper_with_costs_errors_and_the_floor(self):
        single = {"stepper": "sor single"}
        report = report_of(
            row("friction", True, False, 0.154, defect_body_position_rms=0.0441), row("joints", True, None, 0),
            floor(-0.021, defect_body_position_rms=2.3e-4),
            row("friction", False, True, 0.019, scene="Cars"), row("joints", True, None, 0, scene="Cars"),
            row("friction", True, False, 0.154, defect_body_position_rms=4e-6, **single), row("joints", True, None, 0, **single),
            floor(-0.021, defect_body_position_rms=2.3e-4, **single))
        self.assertEqual(document.markdown(report),
                         "| `quick` | Crash | Cars |\n|---|---|---|\n"
                         "| `friction` | 15, 44 mm | (2) |\n"
                         "| noise floor | 2, 0.2 mm | 0, 0 |\n"
                         "\n| `sor single` | Crash |\n|---|---|\n"
                         "| `friction` | 15, 0 |\n"
                         "| noise floor | 2, 0.2 mm |\n")

    def test_what_comes_only_on_request_is_demanded_in_every_form_of_the_report(self):
        for called_for in (False, True):  # files of layout 1.2 say that it is called for
            report = report_of(row("sleeping", called_for, False, 0.1, kind="demanded", reason="only on request; after 0.5 s"))
            for text in (document.markdown(report), page.page_of(report)):
                self.assertIn("(10), other bits", text)
            self.assertIn("demanded: only on request; after 0.5 s", document.text(report))

    def test_markdown_shows_it_if_demanding_changed_the_result(self):
        self.assertIn("| `damping` | (0), other bits |", document.markdown(report_of(row("damping", False, False, -0.001))))


class CommandLine(unittest.TestCase):
    def refusal(self, *given):
        try:
            one_file(parse(effects.COMMAND, list(given)), "a study of effects", "effects.h5")
        except BadInput as error:
            return str(error)
        return ""

    def test_contradictions_are_refused(self):
        self.assertIn("no file", self.refusal())
        self.assertIn("one study", self.refusal("a.h5", "b.h5"))
        self.assertIn("one of the two", self.refusal("a.h5", "--json", "--markdown"))
        self.assertIn("did you mean --html", self.refusal("a.h5", "--htm", "x"))
        self.assertIn("name a file", self.refusal("a.h5", "--html", ""))
        self.assertEqual(self.refusal("a.h5", "--html", "a.html"), "")

    def test_lists_are_given_in_parts_and_other_options_once(self):
        options = parse(effects.COMMAND, ["a.h5", "--scene", "A", "B", "--scene", "C"])
        self.assertEqual(options.scene, ["A", "B", "C"])
        self.assertEqual(parse(effects.COMMAND, ["a.h5"]).scene, [])
        self.assertIn("more than once", self.refusal("a.h5", "--csv", "a", "--csv", "b"))

    def test_no_file_is_written_over_that_is_read(self):
        this = __file__
        self.assertIn("as well", self.refusal(this, "--csv", this))


if __name__ == "__main__":
    unittest.main()
