"""pbreport stability: verdicts in words and numbers, and what a field of the map opens."""
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import document, page, stability  # noqa: E402
from reports.files import BadInput, Study  # noqa: E402

NUMBERS = {"limit_right": 0.01, "limit_broken": 0.1, "broken_at": math.inf, "row_visits": 1234.4, "step_time": 2.5e-6}


def row_of(scene, setting, verdict, value, **others):
    nothing = {name: 0.0 for name in stability.METRICS}
    return {"scene": scene, "group": "rest", "row": 7, "oracle": "it stands", "source": "a book", "setting": setting, "stepper": "sor",
            "cut": 0, "options": "--stepper sor --dt 0.01", "bodies": 1, "seconds": 2.0, "dt": 0.01,
            "verdict": verdict, "decided_by": "drift", "value": value, "value_unit": "m",
            "simulated": 2.0, "drift_band": 0, **NUMBERS, **nothing, **others}


def study_of(rows):
    cases = {name: [row[name] for row in rows] for name in rows[0]}
    attributes = {"command_line": "pbstudy stability", "pbmpi_version": "0.1.0", "git_revision": "abc"}
    return Study("made.h5", attributes, {}, {"cases": cases})


ROWS = [row_of("hard/rest/box", "quick", "pass", 0.005), row_of("hard/rest/box", "sor", "degraded", 0.0123),
        row_of("tower", "quick", "broken", 1.2, broken_at=3.14), row_of("tower", "sor", "n/a", math.nan, limit_right=math.nan,
                                                                        limit_broken=math.nan, decided_by="left out by --most-work")]


class Map(unittest.TestCase):
    def setUp(self):
        self.study = study_of(ROWS)
        self.found = stability.map_of(self.study)

    def test_cases_and_settings_are_in_the_order_of_the_file_and_can_be_chosen(self):
        self.assertEqual(self.found.settings, ["quick", "sor"])
        names = ["tower", "hard/rest/box"]
        self.assertEqual([scene.name for scene in stability.map_of(self.study, names).scenes], names)
        with self.assertRaisesRegex(BadInput, "--scene wall: the study has hard/rest/box, tower"):
            stability.map_of(self.study, ["wall"])

    def test_verdicts_are_counted_by_setting(self):
        self.assertEqual(self.found.counts(), [{"pass": 1, "degraded": 0, "broken": 1, "n/a": 0},
                                               {"pass": 0, "degraded": 1, "broken": 0, "n/a": 1}])

    def test_what_decided_is_a_length_that_people_read(self):
        texts = [stability.decided_text(row) for scene in self.found.scenes for row in scene.results]
        self.assertEqual(texts, ["drift 5 mm", "drift 12.3 mm", "drift 1.2 m at 3.14 s", ""])
        self.assertEqual(stability.with_unit(0.05, "m/s"), "50 mm/s")
        self.assertEqual(stability.with_unit(0.05, ""), "0.05")
        self.assertEqual(stability.with_unit(2e4, "J"), "2e+04 J")

    def test_markdown_has_a_line_a_case_and_the_counts_below(self):
        lines = document.markdown(stability.report_of(self.study, self.found)).splitlines()
        self.assertEqual(lines[:4], ["| row | case | quick | sor |", "|---|---|---|---|", "| 7 | `rest/box` | ok | drift 12.3 mm |",
                                     "| 7 | `tower` | **drift 1.2 m at 3.14 s** | - |"])
        self.assertEqual(len(lines), 2 + 2 + 4)

    def test_text_and_json_have_the_limits_or_say_why_there_are_none(self):
        report = stability.report_of(self.study, self.found)
        text = document.text(report)
        self.assertRegex(text, r"sor +degraded +10 mm +100 mm +drift 12.3 mm\n")
        self.assertRegex(text, r"sor +n/a +- +- +left out by --most-work\n")
        cell = json.loads(document.json(report))["cases"][1]["results"][1]
        self.assertEqual((cell["verdict"], cell["value"], cell["right_up_to"]), ("n/a", None, None))
        self.assertEqual(list(cell["metrics"]), list(stability.METRICS))

    def test_pages_colour_the_fields_and_say_how_to_see_each_run(self):
        report = stability.report_of(self.study, self.found)
        shown = [page.shown_section(section)["tables"] for section in report.sections if document.PAGE in section.shown_in]
        [[fields], [first], _] = shown
        self.assertEqual(fields["rows"][1], ["7", "tower", "drift 1.2 m at 3.14 s", "n/a"])
        self.assertEqual(fields["looks"], [["", "", "pass", "degraded"], ["", "", "broken", "na"]])
        self.assertEqual(len(fields["rows"]), 2 + 4, "the counts below have no colour")
        self.assertEqual(first["rows"][0][-1], "pbmpi --scene hard/rest/box --stepper sor --dt 0.01 --warmup 0 --steps-per-frame 3 --frames 67 "
                                               "--output case.h5")
        [cut, not_run] = study_of([row_of("a", "sor cut", "pass", 0.0, cut=1), ROWS[3]]).rows()
        self.assertEqual([stability.command(one) for one in (cut, not_run)], ["", ""])


if __name__ == "__main__":
    unittest.main()
