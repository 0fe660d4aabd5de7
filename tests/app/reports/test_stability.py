"""pbreport stability: verdicts in words and numbers, and what a field of the map opens."""
import base64
import json
import math
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import document, map_page, stability  # noqa: E402
from reports.files import BadInput, Study  # noqa: E402

NUMBERS = {"limit_right": 0.01, "limit_broken": 0.1, "broken_at": math.inf, "row_visits": 1234.4, "step_time": 2.5e-6}


def row_of(scene, setting, verdict, value, **others):
    nothing = {name: 0.0 for name in stability.METRICS}
    return {"scene": scene, "group": "rest", "row": 7, "oracle": "it stands", "source": "a book", "setting": setting, "stepper": "sor",
            "bodies": 1, "seconds": 2.0, "dt": 0.01, "verdict": verdict, "decided_by": "drift", "value": value, "value_unit": "m",
            "simulated": 2.0, "drift_band": 0, **NUMBERS, **nothing, **others}


def study_of(rows, **tables):
    cases = {name: [row[name] for row in rows] for name in rows[0]}
    attributes = {"command_line": "pbstudy stability", "pbmpi_version": "0.1.0", "git_revision": "abc"}
    empty = {"curves": {name: [] for name in ("case", "time", "energy", "joint_gap", "penetration", "drift")},
             "poses": {name: [] for name in ("case", "time", "body", "pose")}}
    return Study("made.h5", attributes, {}, {"cases": cases} | empty | tables)


ROWS = [row_of("hard/rest/box", "quick", "pass", 0.005), row_of("hard/rest/box", "sor", "degraded", 0.0123),
        row_of("tower", "quick", "broken", 1.2, broken_at=3.14), row_of("tower", "sor", "n/a", math.nan, limit_right=math.nan,
                                                                        limit_broken=math.nan, decided_by="left out by --most-work")]
# One body, with poses at two instants under quick.
POSES = {"case": [0, 0], "time": [0.5, 2.0], "body": [0, 0], "pose": [[1, 2, 3, 1, 0, 0, 0], [4, 5, 6, 0, 1, 0, 0]]}
BODIES = {"scene": ["hard/rest/box"], "name": ["box"], "pose": [[0, 0, 0.5, 1, 0, 0, 0]]}
GEOMS = {"scene": ["hard/rest/box"] * 2, "body": [-1, 0], "kind": ["ground", "prop"], "shape": ["plane", "box"],
         "size": [[0, 0, 0], [1, 1, 1]], "local": [[0, 0, 0, 1, 0, 0, 0]] * 2}
CURVES = {"case": [0, 0, 2], "time": [1.0, 2.0, 1.0], "energy": [5.0, 4.0, 9.0], "joint_gap": [0.0] * 3, "penetration": [0.0] * 3,
          "drift": [0.001, 0.002, 1.0]}


def floats(text):
    return np.frombuffer(base64.b64decode(text), "<f4").tolist()


class Map(unittest.TestCase):
    def setUp(self):
        self.study = study_of(ROWS, poses=POSES, bodies=BODIES, geoms=GEOMS, curves=CURVES)
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
        texts = [stability.decided_text(row) for scene in self.found.scenes for row in scene.results()]
        self.assertEqual(texts, ["drift 5 mm", "drift 12.3 mm", "drift 1.2 m at 3.14 s", ""])
        self.assertEqual(stability.with_unit(0.05, "m/s"), "50 mm/s")
        self.assertEqual(stability.with_unit(0.05, ""), "0.05")
        self.assertEqual(stability.with_unit(2e4, "J"), "2e+04 J")

    def test_a_field_is_darker_the_farther_its_number_is_from_right(self):
        severities = [stability.severity(row) for scene in self.found.scenes for row in scene.results()]
        self.assertAlmostEqual(severities[1], math.log10(1.23) / 3)
        self.assertEqual([severities[0], severities[3]], [0, 0])
        [far, rigid] = study_of([row_of("a", "quick", "broken", 1e9), row_of("a", "sor", "broken", 1.0, limit_right=0.0)]).rows()
        self.assertEqual((stability.severity(far), stability.severity(rigid)), (1, 1))

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

    def test_a_field_opens_the_curves_and_the_replay_of_its_case(self):
        page = stability.map_json(self.study, self.found)
        field, other = page["rows"][0]["cells"]
        self.assertEqual(floats(field["curves"][0]["value"]), [5, 4])
        self.assertEqual([curve["title"] for curve in field["curves"]], ["Energy", "Joint gap", "Deepest contact", "Drift"])
        self.assertEqual((other["curves"], other["replay"]), ([], None))
        replay = field["replay"]
        self.assertEqual((replay["time_s"], replay["step"], replay["number"]), ([0, 0.5, 2], [0, 50, 200], [0, 1, 2]))
        self.assertEqual(floats(replay["position"]), [0, 0, 0.5, 1, 2, 3, 4, 5, 6])
        self.assertEqual(floats(replay["orientation"]), [1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0])
        self.assertEqual(list(base64.b64decode(replay["geoms"]["shape"])), [0, 1])
        self.assertEqual((replay["shape_names"], replay["kind_names"]), (["plane", "box"], ["ground", "prop"]))
        self.assertIn("right up to 10 mm, broken beyond 100 mm. 1234 row visits and 2.5 us", field["detail"])

    def test_a_study_that_has_not_recorded_its_bodies_has_no_replay(self):
        recorded = map_page.Recorded(study_of(ROWS, poses=POSES))
        self.assertIsNone(recorded.replay(0, recorded.still("hard/rest/box"), 0.01))


if __name__ == "__main__":
    unittest.main()
