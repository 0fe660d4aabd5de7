"""pbreport study: which settings are on the front, which is chosen, and how it is described."""
import contextlib
import io
import json
import math
import os
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import accuracy, errors, stability  # noqa: E402
from reports.accuracy import Case, SceneCases  # noqa: E402
from reports.files import BadInput, Row, Study  # noqa: E402
from reports.study import answers, diagrams  # noqa: E402
from reports.study.answers import Limit  # noqa: E402
from made_up import put  # noqa: E402

STEP = "--stepper sor --dt 0.01 --iterations 3 --substeps 2 --precision single"


def columns_of(time_ms, error_mm, **others):
    """A row of /cases as {column: value}: one body with that error, no joint, nothing watched at rest."""
    found = {"scene": "Fake", "kind": "setting", "stepper": "sor", "setting": "sor single, 2 x 3", "options": STEP, "dt": 0.01,
             "substeps": 2, "iterations": 3, "steps_per_frame": 3, "worlds": 1, "warmup": 0, "frames": 5,
             "frame_time_worst": 1e-3 * time_ms, "frame_time_median": 0.9e-3 * time_ms, "row_visits": 100.0,
             "joint_gap": 0.0, "penetration": 0.0, "rest_fallen": math.nan, "rest_fell_at": math.nan, "rest_creep": math.nan,
             "rest_energy_gain": math.nan, "estimate_iterations": 0, "own": -1,
             "solve_iterations": math.nan, "determined": [0.25, 0.75, 1.0], "within": [0.0, 0.5, 1.0]}
    for table in ("defect", "drift", "own_defect"):
        for kind in errors.KINDS:
            found |= {f"{table}_{kind}_{what}": 0.0 for what in errors.NUMBERS}
            found[f"{table}_{kind}_bands"] = [1, 0, 0, 0, 0] if (table, kind) == ("defect", "body_position") else [0] * 5
    return found | {"defect_body_position_rms": 1e-3 * error_mm} | others


def case(*args, hard=None, **others):
    return Case(Row({name: [value] for name, value in columns_of(*args, **others).items()}, 0), hard)


BLOWN_UP = {"defect_joint_position_bands": [0, 0, 0, 0, 1]}


HOLDS, BREAKS, UNTRIED = stability.Tally(99, 2), stability.Tally(99, 36), stability.Tally()
FRAMES = {"scene": ["Fake", "Other"], "frame": [3, 3], "soft_steps": [96, 6], "ode_steps": [48, 6], "determined": [[0.25, 0.75, 1.0]] * 2}
FRAMES |= {f"{what}_{part}": [value, 0.0] for value, (what, part) in zip((1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4), (
    (what, part) for what in ("soft_halved", "ode_halved", "apart") for part in ("median", "p90")))}


def scene(fells=(), watched=(), uncertainty_mm=None):
    """`fells`, `watched`: places of settings that fell bodies at rest, or were seen to let none fall."""
    settings = [(4, 2), (1, 10), (2, 12), (2, 5), (3, 5), (0.5, 8)]  # 2 is dominated, 4 is as bad as 3 and dearer
    rest = {place: {"rest_fallen": 2.0, "rest_fell_at": 1.25} for place in fells} | {place: {"rest_fallen": 0.0} for place in watched}
    found = SceneCases("Fake", [case(*one, **rest.get(place, BLOWN_UP if place == 5 else {})) for place, one in enumerate(settings)])
    if uncertainty_mm is not None:
        found.add(case(90, uncertainty_mm, kind="nature"))
    return found


def places(cases, some):
    return [cases.settings.index(one) for one in some]


def place(cases, **limit):
    chosen = Limit(**limit).chosen(cases)
    return None if chosen is None else cases.settings.index(chosen)


class Choice(unittest.TestCase):
    def test_the_front_holds_what_nothing_beats_and_its_error_falls(self):
        cases = scene()
        self.assertEqual(places(cases, cases.front("rms")), [1, 3, 0])

    def test_what_blew_up_is_never_chosen_however_fast(self):
        cases = scene()
        self.assertFalse(cases.settings[5].finite())
        self.assertEqual(place(cases, budget_s=0.6e-3), None)
        cases.settings[5] = case(0.5, 8)
        self.assertEqual(places(cases, cases.front("rms")), [5, 3, 0])

    def test_a_budget_takes_the_least_error_and_a_tolerance_the_least_time(self):
        for limit, chosen in (({"budget_s": 3.5e-3}, 3), ({"budget_s": 1}, 0), ({"budget_s": 0.6e-3}, None), ({"tolerance_m": 6e-3}, 3),
                              ({"tolerance_m": 1e-3}, None), ({}, None)):
            self.assertEqual(place(scene(), **limit), chosen, limit)

    def test_what_fells_at_rest_is_never_chosen_but_stays_on_the_front(self):
        cases = scene(fells=[3], watched=[0])
        self.assertEqual(places(cases, cases.front("rms")), [1, 3, 0])
        self.assertEqual(place(cases, budget_s=2.5e-3), 1)
        self.assertEqual(place(cases, tolerance_m=6e-3), 4)
        self.assertFalse(cases.settings[1].fells(), "nothing was watched")

    def test_what_does_not_hold_the_hard_cases_is_never_chosen(self):
        cases = scene()
        for tally, chosen in ((HOLDS, 3), (BREAKS, 1), (UNTRIED, 1)):
            cases.settings[3].hard = tally
            self.assertEqual(place(cases, budget_s=2.5e-3), chosen, tally)

    def test_a_length_is_kept_by_nine_bodies_in_ten_of_those_determined_for_it(self):
        cases = SceneCases("Fake", [case(1, 2, within=[0.0, 0.89, 1.0]), case(2, 50, within=[0.0, 0.9, 1.0]),
                                    case(3, 1, within=[math.nan, 1.0, 1.0])])
        for length_m, chosen in ((1e-3, None), (1e-2, 1), (0.1, 0), (5e-2, 0), (1.5e-3, 2)):
            self.assertEqual(place(cases, tolerance_m=length_m), chosen, length_m)

    def test_where_nature_determines_no_body_to_a_length_nothing_is_said_of_it(self):
        nothing = {"defect_body_position_bands": [0] * 5, "within": [math.nan, math.nan, 1.0], "determined": [0.0, 0.0, 0.5]}
        cases = SceneCases("Fake", [case(1, 0, **nothing)])
        cases.add(case(90, 0, kind="nature", **nothing))
        self.assertEqual(cases.front("rms"), [])
        self.assertEqual(place(cases, tolerance_m=0.1), 0)
        for limit, length in ((Limit(budget_s=1), "1 mm"), (Limit(tolerance_m=1e-2), "1 cm")):
            self.assertIsNone(limit.chosen(cases))
            self.assertEqual(limit.why_none(cases), f"nature determines no body to {length}")

    def test_a_limit_that_only_what_falls_would_keep_is_said_to_be_so(self):
        cases = scene(fells=[1])
        self.assertIn("without felling", accuracy.choice_text(cases, Limit(budget_s=1.5e-3)))
        for one, words in ((BREAKS, "of the study keeps it without felling what stands at rest or breaking hard cases"),
                           (UNTRIED, "that was tried on the hard cases keeps it without felling what stands at rest")):
            cases.settings[1].hard = one
            self.assertIn(words, Limit(budget_s=1.5e-3).why_none(cases))
        self.assertTrue(accuracy.choice_text(cases, Limit(budget_s=1e-6)).endswith("no setting of the study keeps it"))
        self.assertEqual(accuracy.choice_text(cases, Limit()), "")

    def test_each_diagram_has_a_front_of_its_own(self):
        cases = SceneCases("Fake", [case(1, 1, defect_joint_position_rms=9e-3), case(2, 2, defect_joint_position_rms=3e-3)])
        self.assertEqual(places(cases, cases.front("rms")), [0])
        self.assertEqual(places(cases, cases.front("joint")), [0, 1])


class Answers(unittest.TestCase):
    def setUp(self):
        self.cases = SceneCases("Fake", [case(1, 10, within=[0.0, 0.95, 1.0]), case(3, 4), case(9, 1, within=[0.5, 1.0, 1.0])])

    def test_each_scene_answers_the_papers_budget_and_three_lengths(self):
        found = [answers.answer_json(limit, self.cases) for limit in answers.ANSWERS]
        self.assertEqual([one["asked"] for one in found], ["3.33 ms", "1 mm", "1 cm", "10 cm"])
        self.assertEqual([one.get("error_m") for one in found], [4e-3, None, 10e-3, 10e-3])
        self.assertEqual(found[0] | {"run": ""}, {"asked": "3.33 ms", "setting": "sor single, 2 x 3, dt 0.01 s", "error_m": 4e-3,
                                                  "frame_time_s": 3e-3, "run": ""})
        self.assertEqual(found[1], {"asked": "1 mm", "setting": None, "reason": "no setting of the study keeps it"})

    def test_the_answers_are_one_sentence_that_says_whether_hard_cases_were_asked(self):
        text = answers.answer_text(self.cases)
        self.assertEqual(text, "Least error (rms of body positions) in 3.33 ms: sor single, 2 x 3, dt 0.01 s (3.000 ms, 4 mm); least time for "
                         "1 mm: none, no setting of the study keeps it; least time for 1 cm: sor single, 2 x 3, dt 0.01 s (1.000 ms, 95 % within it, "
                         "10 mm); least time for 10 cm: sor single, 2 x 3, dt 0.01 s (1.000 ms, 100 % within it, 10 mm) (settings not held "
                         "against the hard cases: --hard-cases stability.h5).")
        for one in self.cases.settings:
            one.hard = HOLDS
        self.assertTrue(answers.answer_text(self.cases).endswith("(1.000 ms, 100 % within it, 10 mm)."))


class HardCases(unittest.TestCase):
    def study(self, **columns):
        """Of 20 cases under sor, the last of which has a step of its own; `columns`: what they have else."""
        cases = {"scene": [f"case{place}" for place in range(20)], "setting": ["sor"] * 20, "cut": [0] * 20, "dt": [0.01] * 19 + [0.002],
                 "options": [f"--stepper sor --dt {dt} --iterations 3" for dt in [0.01] * 19 + [0.002]], "verdict": ["pass"] * 20}
        return Study("stability.h5", {}, {}, {"cases": cases | columns})

    def tally(self, study, options="--iterations 3 --dt 0.01 --stepper sor", dt_s=0.01):
        return stability.tallies(study).get(stability.step_key(options, dt_s))

    def test_one_case_in_twenty_may_break(self):
        for broken, holds in ((0, True), (1, True), (2, False)):
            tally = self.tally(self.study(verdict=["broken"] * broken + ["degraded"] * (20 - broken)))
            self.assertEqual((tally, tally.holds()), (stability.Tally(20, broken), holds))
        self.assertEqual(BREAKS.remark(), "breaks 36 of 99 hard cases")
        self.assertEqual((HOLDS.remark(), UNTRIED.remark(), UNTRIED.holds()), ("", "not tried on the hard cases", False))

    def test_a_setting_is_found_by_its_options_and_its_step(self):
        for options, dt_s in (("--stepper sor --iterations 4", 0.01), ("--stepper sor --iterations 3", 0.005)):
            self.assertIsNone(self.tally(self.study(), options, dt_s))
        own = self.study(setting=["sor, dt 0.005 s"] * 20, dt=[0.005] * 20)
        self.assertEqual(self.tally(own, dt_s=0.005), stability.Tally(20, 0))
        self.assertIsNone(self.tally(own))

    def test_cut_worlds_and_cases_that_cannot_run_do_not_count(self):
        self.assertIsNone(self.tally(self.study(cut=[1] * 20)))
        self.assertEqual(self.tally(self.study(verdict=["n/a"] * 5 + ["broken"] * 15)), stability.Tally(15, 15))


class Nature(unittest.TestCase):
    def test_its_uncertainty_is_its_own_error_by_the_measure(self):
        self.assertTrue(math.isnan(scene().uncertainty_m("rms")))
        cases = scene(uncertainty_mm=4)
        self.assertEqual((cases.uncertainty_m("rms"), cases.uncertainty_m("median")), (4e-3, 0))
        self.assertTrue(cases.is_inside(cases.settings[0]), "2 mm")
        self.assertEqual(answers.result_text(Limit(budget_s=1), cases, cases.settings[0]).split(", ")[-1],
                         "below the 4 mm to which nature is known")
        self.assertFalse(cases.is_inside(cases.settings[3]), "5 mm")
        self.assertEqual(answers.result_text(Limit(budget_s=1), cases, cases.settings[3]), "2.000 ms, 5 mm")
        self.assertEqual(cases.determined(), {"1 mm": 0.25, "1 cm": 0.75, "10 cm": 1.0})

    def test_its_table_has_a_row_a_frame_of_the_scene(self):
        columns = {name: [value] for name, value in columns_of(1, 1).items()}
        [found] = accuracy.scenes_of(Study("a.h5", {}, {}, {"cases": columns, "nature": FRAMES}))
        with self.assertRaises(BadInput):
            accuracy.scenes_of(Study("old.h5", {}, {}, {"cases": columns}))
        self.assertEqual(accuracy.nature_table(found).rows,
                         [["3", "96", "0.1", "0.2", "48", "0.3", "0.4", "0.5", "0.6", "25.0", "75.0", "100.0"]])

    def test_the_floor_of_own_solutions_is_that_of_their_stepper(self):
        own = {"kind": "own_floor", "own_defect_body_position_bands": [1, 0, 0, 0, 0]}
        cases = SceneCases("Fake")
        for stepper, rms_m in (("sor", 1e-6), ("sor", 3e-6), ("quick", 5e-6)):
            cases.add(case(1, 1, stepper=stepper, own_defect_body_position_rms=rms_m, **own))
        self.assertEqual(cases.own_floor_m("sor"), 3e-6)
        self.assertTrue(math.isnan(cases.own_floor_m("direct")))
        self.assertTrue(math.isnan(case(1, 1).own_error_m()), "it has no own solution")


class Words(unittest.TestCase):
    def test_remarks_say_what_was_chosen_what_falls_and_what_breaks(self):
        cases = scene(fells=[3])
        self.assertEqual(accuracy.remarks(cases, Limit(), cases.settings[1]), "")
        self.assertEqual(accuracy.remarks(cases, Limit(), cases.settings[3]), "fells 2 bodies at rest, the first after 1.25 s")
        self.assertEqual(accuracy.remarks(cases, Limit(budget_s=1), cases.settings[0]), "chosen")
        one = case(1, 1, hard=BREAKS, rest_fallen=1.0, rest_fell_at=0.5)
        self.assertEqual(accuracy.remarks(cases, Limit(), one), "fells 1 body at rest, the first after 0.5 s; breaks 36 of 99 hard cases")

    def test_a_setting_says_its_estimate_and_its_step(self):
        self.assertEqual(case(1, 1).setting(), "sor single, 2 x 3, dt 0.01 s")
        self.assertEqual(case(1, 1, estimate_iterations=2).setting(), "sor single, 2 x 3, 2 a step, dt 0.01 s")

    def test_a_setting_becomes_the_options_that_give_it(self):
        one = case(1, 10)
        self.assertEqual(accuracy.config_text(one).splitlines(), [
            "# sor single, 2 x 3, dt 0.01 s: frame time 1.000 ms, error rms 10 mm, max 0 mm", "scene = Fake", "stepper = sor", "dt = 0.01",
            "iterations = 3", "substeps = 2", "precision = single", "steps-per-frame = 3", "replicas = 1", "warmup = 0", "frames = 5"])
        self.assertEqual(one.run_command(), f"mpirun -n 1 pbmpi --scene Fake {STEP} --steps-per-frame 3 --replicas 1 --warmup 0 --frames 5")


class Diagrams(unittest.TestCase):
    def test_a_diagram_has_a_line_a_stepper_the_chosen_and_hides_the_other_settings(self):
        cases = scene(uncertainty_mm=4)
        cases.add(case(5, 3, setting="sor double, 2 x 3, law ode", options=STEP.replace("single", "double --law ode")))
        cases.add(case(1, 1, kind="estimate", **BLOWN_UP))
        config = diagrams.diagram(cases, Limit(tolerance_m=6e-3), "rms", "Position", "error [mm]").config
        sor, others, chosen = config["data"]["datasets"]
        self.assertEqual((sor["label"], [point["x"] for point in sor["data"]]), ("sor", [1, 2, 4]), "of both precisions and laws")
        self.assertEqual((others["label"], others["hidden"]), ("other settings", True))
        self.assertEqual([point["y"] for point in others["data"]], [12, 5, 3], "none that blew up")
        self.assertEqual(chosen["data"][0]["label"], "chosen: sor single, 2 x 3, dt 0.01 s (2 substeps of 3 iterations): 2.000 ms, 5 mm")
        self.assertEqual([(band["label"], band["to"]) for band in config["options"]["plugins"]["pbmpi"]["bands"]],
                         [("uncertainty of nature [mm]", 4), ("tolerance [mm]", 6)])

    def test_a_tolerance_is_drawn_where_its_measure_is(self):
        bands = diagrams.bands(scene(), Limit(tolerance_m=1e-3), "max")
        self.assertNotIn("tolerance [mm]", [band["label"] for band in bands])
        self.assertIn("budget [ms]", [band["label"] for band in diagrams.bands(scene(), Limit(budget_s=1e-3), "max")])


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "accuracy.h5")
        self.config = os.path.join(folder.name, "chosen.cfg")
        rows = [columns_of(1, 10), columns_of(2, 5, rest_fallen=0.0, rest_fell_at=math.inf), columns_of(0.5, 8, **BLOWN_UP),
                columns_of(1, 3, kind="estimate", estimate_iterations=1),
                columns_of(9, 2, kind="nature", within=[math.nan] * 3)]
        with h5py.File(self.path, "w") as file:
            file.attrs["filetype"], file.attrs["study"], file.attrs["version"] = np.bytes_("pbmpi-study"), np.bytes_("accuracy"), [1, 7]
            file["parameters/seed"], file["parameters/nature_steps"], file["parameters/nature_error"] = 1, 768, 1e-4
            for name in rows[0]:
                put(file, f"cases/{name}", [row[name] for row in rows])
            for name, values in FRAMES.items():
                put(file, f"nature/{name}", values)

    def printed(self, *words):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            accuracy.run([self.path, *words])
        return out.getvalue()

    def refusal(self, *words):
        with self.assertRaises(BadInput) as caught:
            accuracy.run(list(words))
        return str(caught.exception)

    def test_json_has_the_front_the_estimates_and_the_choice(self):
        [found] = json.loads(self.printed("--json", "--budget", "3ms"))["scenes"]
        self.assertEqual([one["error_m"] for one in found["front"]], [10e-3, 5e-3])
        self.assertEqual((found["uncertainty_m"], found["determined"]["1 cm"], found["front"][0]["within"]["1 cm"]), (2e-3, 0.75, 0.5))
        self.assertEqual([(one["frame"], one["soft_steps"], one["apart_p90"]) for one in found["nature"]], [(3, 96, 6e-4)])
        self.assertEqual([one["setting"] for one in found["answers"]], ["sor single, 2 x 3, dt 0.01 s", None, None, "sor single, 2 x 3, dt 0.01 s"])
        self.assertEqual(found["estimates"][0]["estimate"], {"iterations": 1})
        self.assertEqual(found["chosen"]["at_rest"], {"fallen": 0, "fell_at_s": None, "creep_m_s": None, "energy_gain_j": None})
        self.assertNotIn("at_rest", found["front"][0], "nothing was watched")
        self.assertNotIn("own", found)
        self.assertIs(found["chosen"]["inside_uncertainty"], False)
        self.assertEqual(found["chosen"]["options"]["steps-per-frame"], "3")

    def test_text_shows_the_front_and_what_was_left_out(self):
        text = self.printed("--tolerance", "6mm", "--write-config", self.config)
        for words in ("3 settings. 1 of them blew up (inf or NaN) and is left out.", "run: mpirun -n 1 pbmpi --scene Fake --stepper sor",
                      "tolerance 6 mm: sor single, 2 x 3, dt 0.01 s (2.000 ms", "at most 768 a frame, until half the step moves nine bodies in ten",
                      "determined for 25 % of bodies and frames at 1 mm, 75 % at 1 cm, 100 % at 10 cm", "apart: 2 mm (rms of body positions)",
                      "sor single, 2 x 3, dt 0.01 s (chosen)"):
            self.assertIn(words, text)
        self.assertTrue(text.endswith("(settings not held against the hard cases: --hard-cases stability.h5).\n"), text)
        self.assertNotIn("Own solutions", text)
        config = pathlib.Path(self.config).read_text(encoding="utf-8")
        self.assertTrue(config.startswith("# sor single, 2 x 3, dt 0.01 s: frame time 2.000 ms"), config)

    def test_settings_that_break_hard_cases_are_not_chosen(self):
        path = self.config + ".h5"
        columns = {"scene": ["hard/a", "hard/b"], "setting": ["sor single"] * 2, "cut": [0, 0], "dt": [0.01] * 2, "options": [STEP] * 2,
                   "verdict": ["pass", "broken"]}
        with h5py.File(path, "w") as file:
            file.attrs.update({"filetype": np.bytes_("pbmpi-study"), "study": np.bytes_("stability"), "version": [1, 7]})
            for name, values in columns.items():
                put(file, f"cases/{name}", values)
        text = self.printed("--hard-cases", path, "--budget", "3ms")
        self.assertIn("budget 3 ms: no setting of the study keeps it without breaking hard cases\n", text)
        self.assertIn("(breaks 1 of 2 hard cases)", text)
        self.assertNotIn("--hard-cases", text)

    def test_contradictions_are_refused(self):
        for words, said in (([], "no file"), (["a.h5", "b.h5"], "one study"), (["a.h5", "--write-config", "p"], "--budget"),
                            (["a.h5", "--budget", "1ms", "--tolerance", "1cm"], "exclude"),
                            (["a.h5", "--budget", "3.33"], "unit"), ([self.path, "--html", self.path], "name another file"),
                            ([self.path, "--hard-cases", "s.h5", "--html", "s.h5"], "name another file"),
                            ([self.path, "--budget", "1us", "--write-config", self.config], "no setting of the study keeps"),
                            ([self.path, "--scene", "Fight"], "the study has Fake")):
            self.assertIn(said, self.refusal(*words), words)
        self.assertFalse(os.path.exists(self.config))


if __name__ == "__main__":
    unittest.main()
