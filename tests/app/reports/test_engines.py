"""pbreport engines: fronts by two yardsticks, hard cases by group, what engines take otherwise."""
import json
import math
import pathlib
import sys
import tempfile
import types
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import document, engines, errors  # noqa: E402
from reports.files import BadInput, Study  # noqa: E402

ATTRIBUTES = {"command_line": "pbstudy", "pbmpi_version": "0.1.0", "git_revision": "abc"}


def table_of(rows):
    return {name: [row[name] for row in rows] for name in rows[0]}


def case_of(stepper, time_ms, error_mm, own_mm=math.nan, kind="setting", own=-1, **others):
    """A row of /cases of a study of accuracy: one body with that error."""
    row = {"scene": "Fake", "kind": kind, "stepper": stepper, "setting": f"{stepper}, {time_ms}", "options": "", "dt": 0.01, "worlds": 1,
           "frames": 5, "frame_time_worst": 1e-3 * time_ms, "frame_time_median": 1e-3 * time_ms, "row_visits": 0.0, "joint_gap": 0.0,
           "penetration": 0.0, "rest_fallen": 0.0, "estimate_iterations": 0, "own": own}
    for table, error in (("defect", error_mm), ("drift", math.nan), ("own_defect", own_mm)):
        for measured in errors.KINDS:
            here = measured == "body_position" and not math.isnan(error)
            row |= {f"{table}_{measured}_{what}": 1e-3 * error if here else 0.0 for what in errors.NUMBERS}
            row[f"{table}_{measured}_bands"] = [int(here), 0, 0, 0, 0]
    return row | others


BLOWN_UP = {"defect_joint_position_bands": [0, 0, 0, 0, 1]}
ACCURACY = [case_of("quick", 1, 10, 1), case_of("quick", 2, 5, 2), case_of("quick", 3, 4, 3, rest_fallen=2.0),
            case_of("sor", 1, 20, 9, **BLOWN_UP),
            case_of("quick", 50, 0.5, 0.25, "own", own=5), case_of("quick", 51, 0.7, 0.35, "own", own=6),
            case_of("quick", 50, 0.5, 0.125, "own_floor", own=6), case_of("sor", 99, 3, kind="nature")]
VERDICTS = (("box", "rest", ("pass", "broken")), ("wall", "rest", ("pass", "pass")), ("arm", "joints", ("n/a", "pass")))
STABILITY = [{"scene": scene, "group": group, "setting": setting, "stepper": setting, "verdict": verdict, "decided_by": "sink",
              "value": 0.1, "value_unit": "m", "broken_at": 2.0}
             for scene, group, verdicts in VERDICTS for setting, verdict in zip(("bullet", "sor"), verdicts)]
# What engines take otherwise, as studies of the two kinds have it.
OF_ACCURACY = {"engine": ["mujoco", "bullet"], "scene": ["Fake", "Fake"], "text": ["soft", "slow"]}
OF_STABILITY = {"engine": ["bullet"] * 3, "scene": ["box", "box", "wall"], "text": ["slow", "round", "slow"]}


def studies(**kinds):
    """{kind: Study} of rows of /cases and, where it is of version 1.7, differences."""
    found = {}
    for kind, (rows, differences) in kinds.items():
        tables = {"cases": table_of(rows), "nature": {}} | ({"differences": differences} if differences is not None else {})
        found[kind] = Study(f"{kind}.h5", ATTRIBUTES, {"build": "Release", "library_ode": "0.16", "seed": "1"}, tables)
    return found


def json_of(found):
    return json.loads(document.json(engines.report_of(found)))


class Report(unittest.TestCase):
    def setUp(self):
        self.found = engines.Engines(studies(accuracy=(ACCURACY, OF_ACCURACY), stability=(STABILITY, OF_STABILITY)), [])

    def test_each_yardstick_has_a_front_of_its_own_without_what_blew_up_or_fell(self):
        [scene] = json_of(self.found)["scenes"]
        quick, sor = scene["engines"]
        self.assertEqual([one["setting"] for one in quick["nature_front"]], ["quick, 1, dt 0.01 s", "quick, 2, dt 0.01 s"])
        self.assertEqual([one["setting"] for one in quick["own_front"]], ["quick, 1, dt 0.01 s"])
        self.assertEqual((quick["settings"], quick["felled"], sor["not_finite"], sor["nature_front"]), (3, 1, 1, []))

    def test_each_number_of_a_front_stands_under_its_heading(self):
        rows = [case_of("quick", 1, 10, 1, joint_gap=0.02, penetration=0.03), case_of("sor", 1, 20, 9, **BLOWN_UP)]
        scene = engines.Engines(studies(accuracy=(rows, OF_ACCURACY)), []).scenes[0]
        table = engines.front_table(scene, engines.NATURE)
        quick, sor = (dict(zip(table.header, row)) for row in table.rows)
        self.assertEqual(quick, {"engine": "quick", "worst frame [ms]": "1", "error rms [mm]": "10", "joint gap [mm]": "20", "depth [mm]": "30",
                                 "setting (substeps x iterations)": "quick, 1, dt 0.01 s"})
        self.assertEqual((sor["engine"], sor["worst frame [ms]"], sor["setting (substeps x iterations)"]),
                         ("sor", "-", engines.NOTHING_STANDS))

    def test_the_own_solution_is_that_whose_noise_was_measured(self):
        quick, sor = json_of(self.found)["scenes"][0]["engines"]
        self.assertEqual({name: round(1e3 * value, 9) for name, value in quick["own_solution"].items()},
                         {"from_nature_m": 0.7, "from_fewer_iterations_m": 0.35, "noise_m": 0.125})
        self.assertEqual(set(sor["own_solution"].values()), {None})

    def test_without_own_solutions_there_is_one_yardstick(self):
        found = engines.Engines(studies(accuracy=([case_of("quick", 1, 10)], OF_ACCURACY)), [])
        self.assertNotIn("its own solution", document.markdown(engines.report_of(found)))
        self.assertEqual(json_of(found)["scenes"][0]["engines"][0]["own_front"], [])

    def test_hard_cases_are_counted_by_group_and_setting(self):
        bullet, sor = json_of(self.found)["hard_cases"]
        self.assertEqual((bullet["engine"], bullet["groups"]["rest"]), ("bullet", {"pass": 2, "degraded": 0, "broken": 0, "n/a": 0}))
        self.assertEqual((sor["all"]["pass"], sor["all"]["broken"], bullet["all"]["n/a"]), (2, 1, 1))
        self.assertEqual(engines.held_table(self.found).rows[1], ["sor", "sor", "1 pass, 1 broken", "1 pass", "2 pass, 1 broken"])
        self.assertEqual(engines.case_table(self.found).rows[0], ["box", "pass: sink 100 mm", "broken: sink 100 mm at 2 s"])

    def test_differences_of_both_studies_are_joined_engine_by_engine(self):
        self.assertEqual(json_of(self.found)["differences"], [{"engine": "bullet", "text": "slow", "scenes": ["Fake", "box", "wall"]},
                                                              {"engine": "bullet", "text": "round", "scenes": ["box"]},
                                                              {"engine": "mujoco", "text": "soft", "scenes": ["Fake"]}])

    def test_a_study_without_differences_is_not_one_of_engines_that_express_all(self):
        nothing = {name: [] for name in OF_ACCURACY}
        alike = engines.Engines(studies(stability=(STABILITY, nothing)), [])
        self.assertEqual(engines.difference_table(alike).rows, [["all", "-", "nothing"]])
        with self.assertRaisesRegex(BadInput, "stability.h5: it does not say what engines take otherwise"):
            engines.Engines(studies(accuracy=(ACCURACY, OF_ACCURACY), stability=(STABILITY, None)), [])

    def test_a_chart_has_a_line_an_engine_and_marks_what_says_nothing(self):
        nature, own = (engines.front_chart(self.found.scenes[0], yardstick).config for yardstick in (engines.NATURE, engines.OWN))
        self.assertEqual([one["label"] for one in nature["data"]["datasets"]], ["quick"])
        marks = [[mark["label"] for mark in chart["options"]["plugins"]["pbmpi"]["bands"]] for chart in (nature, own)]
        self.assertEqual(marks, [["uncertainty of nature [mm]"], ["noise of quick [mm]"]])

    def test_versions_are_those_of_the_file(self):
        self.assertEqual(engines.versions_of(self.found.studies[0]), {"pbmpi": "0.1.0 (abc)", "build": "Release", "ode": "0.16"})


class Files(unittest.TestCase):
    def refusal(self, *paths, scene=None):
        with self.assertRaises(BadInput) as caught:
            engines.studies_named(types.SimpleNamespace(files=list(map(str, paths)), scene=scene))
        return str(caught.exception)

    def test_one_study_of_each_kind_is_taken_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = {}
            for kind in ("accuracy", "stability", "effects", None):
                paths[kind] = pathlib.Path(folder) / f"{kind}.h5"
                with h5py.File(paths[kind], "w") as file:
                    file.attrs["filetype"], file.attrs["version"] = np.bytes_("pbmpi-study" if kind else "pbmpi-run"), [1, 7]
                    file.attrs["study"] = np.bytes_(kind or "")
            self.assertIn("no file given", self.refusal())
            self.assertIn("this is a study of effects", self.refusal(paths["effects"]))
            self.assertIn("this is no study", self.refusal(paths[None]))
            self.assertIn("this is no study", self.refusal(pathlib.Path(folder) / "missing.h5"))
            self.assertIn("give one study of accuracy", self.refusal(paths["accuracy"], paths["accuracy"]))
            self.assertIn("name one", self.refusal(paths["stability"], scene=["CrashSk"]))


if __name__ == "__main__":
    unittest.main()
