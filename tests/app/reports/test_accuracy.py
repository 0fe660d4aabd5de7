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
from reports import accuracy, diagrams, errors  # noqa: E402
from reports.accuracy import Case, Limit, SceneCases  # noqa: E402
from reports.files import BadInput, Row  # noqa: E402

STEP = "--stepper sor --dt 0.01 --iterations 3 --substeps 2 --precision single"


def columns_of(time_ms, error_mm, **others):
    """A row of /cases as {column: value}: one body with that error, no joint, nothing watched at rest."""
    found = {"scene": "Fake", "kind": "setting", "stepper": "sor", "setting": "sor single, 2 x 3", "options": STEP, "dt": 0.01,
             "substeps": 2, "iterations": 3, "steps_per_frame": 3, "worlds": 1, "warmup": 0, "frames": 5,
             "frame_time_worst": 1e-3 * time_ms, "frame_time_median": 0.9e-3 * time_ms, "row_visits": 100.0,
             "joint_gap": 0.0, "penetration": 0.0, "rest_fallen": math.nan, "rest_fell_at": math.nan, "rest_creep": math.nan,
             "rest_energy_gain": math.nan, "estimate_iterations": 0, "own": -1,
             "solve_residual": math.nan, "solve_iterations": math.nan}
    for table in ("defect", "drift", "own_defect"):
        for kind in errors.KINDS:
            found |= {f"{table}_{kind}_{what}": 0.0 for what in ("rms", "p99", "max")}
            found[f"{table}_{kind}_bands"] = [1, 0, 0, 0, 0] if (table, kind) == ("defect", "body_position") else [0] * 5
    return found | {"defect_body_position_rms": 1e-3 * error_mm} | others


def case(*args, **others):
    return Case(Row({name: [value] for name, value in columns_of(*args, **others).items()}, 0))


BLOWN_UP = {"defect_joint_position_bands": [0, 0, 0, 0, 1]}


def scene(fells=(), watched=(), **others):
    """`fells`, `watched`: places of settings that fell bodies at rest, or were seen to let none fall."""
    settings = [(4, 2), (1, 10), (2, 12), (2, 5), (3, 5), (0.5, 8)]  # 2 is dominated, 4 is as bad as 3 and dearer
    rest = {place: {"rest_fallen": 2.0, "rest_fell_at": 1.25} for place in fells} | {place: {"rest_fallen": 0.0} for place in watched}
    found = SceneCases("Fake", [case(*one, **rest.get(place, BLOWN_UP if place == 5 else {})) for place, one in enumerate(settings)])
    found.floor = [case(9, 0.5), case(9, 2.5)]
    for kind, error_mm in others.items():
        found.add(case(90, error_mm, kind=kind))
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
        self.assertEqual(places(cases, cases.standing_front("rms")), [1, 4, 0])
        self.assertEqual(place(cases, budget_s=2.5e-3), 1)
        self.assertEqual(place(cases, tolerance_m=6e-3), 4)
        self.assertFalse(cases.settings[1].fells(), "nothing was watched")

    def test_a_limit_that_only_what_falls_would_keep_is_said_to_be_so(self):
        cases = scene(fells=[1])
        self.assertIn("without felling", accuracy.choice_text(cases, Limit(budget_s=1.5e-3)))
        self.assertTrue(accuracy.choice_text(cases, Limit(budget_s=1e-6)).endswith("no setting of the study keeps it"))
        self.assertEqual(accuracy.choice_text(cases, Limit()), "")

    def test_settings_are_ranked_by_the_measure_asked_for(self):
        cases = SceneCases("Fake", [case(1, 1, defect_joint_position_rms=9e-3), case(2, 2, defect_joint_position_rms=3e-3)])
        self.assertEqual(places(cases, cases.front("rms")), [0])
        self.assertEqual(places(cases, cases.front("joint")), [0, 1])
        self.assertEqual(place(cases, measure="joint", tolerance_m=5e-3), 1)


class Reference(unittest.TestCase):
    def test_the_noise_floor_is_that_of_the_worst_seed(self):
        self.assertEqual(scene().floor_m("rms"), 2.5e-3)

    def test_the_reference_is_known_to_the_worst_of_its_judges_but_for_the_steps_length(self):
        self.assertEqual(scene().uncertainty_m("rms"), 2.5e-3, "the noise floor")
        cases = scene(more_iterations=1, second_method=4, halved_dt=30)
        self.assertEqual(cases.uncertainty_m("rms"), 4e-3)
        self.assertTrue(cases.is_inside(cases.settings[0], "rms"), "2 mm")
        self.assertEqual(accuracy.inside_text(cases, Limit(), cases.settings[0]), ": within the 4 mm to which the reference is known")
        self.assertFalse(cases.is_inside(cases.settings[3], "rms"), "5 mm")
        self.assertEqual(accuracy.inside_text(cases, Limit(), cases.settings[3]), "")

    def test_the_floor_of_own_solutions_is_that_of_their_stepper(self):
        own = {"kind": "own_floor", "own_defect_body_position_bands": [1, 0, 0, 0, 0]}
        cases = SceneCases("Fake")
        for stepper, rms_m in (("sor", 1e-6), ("sor", 3e-6), ("quick", 5e-6)):
            cases.add(case(1, 1, stepper=stepper, own_defect_body_position_rms=rms_m, **own))
        self.assertEqual(cases.own_floor_m("sor", "rms"), 3e-6)
        self.assertTrue(math.isnan(cases.own_floor_m("direct", "rms")))
        self.assertTrue(math.isnan(case(1, 1).own_error_m("rms")), "it has no own solution")


class Words(unittest.TestCase):
    def test_remarks_say_what_was_chosen_what_falls_and_what_is_noise(self):
        cases = scene(fells=[3])
        self.assertEqual(accuracy.remarks(cases, Limit(), cases.settings[1]), "")
        self.assertEqual(accuracy.remarks(cases, Limit(), cases.settings[3]), "fells 2 bodies at rest, the first after 1.25 s")
        self.assertEqual(accuracy.remarks(cases, Limit(budget_s=1), cases.settings[0]), "chosen; at the noise floor")
        one = case(1, 1, rest_fallen=1.0, rest_fell_at=0.5)
        self.assertEqual(accuracy.remarks(cases, Limit(), one), "fells 1 body at rest, the first after 0.5 s; at the noise floor")

    def test_a_setting_says_its_estimate_and_its_step(self):
        self.assertEqual(case(1, 1).setting(), "sor single, 2 x 3, dt 0.01 s")
        self.assertEqual(case(1, 1, estimate_iterations=2).setting(), "sor single, 2 x 3, 2 a step, dt 0.01 s")

    def test_a_setting_becomes_the_options_that_give_it(self):
        one = case(1, 10)
        self.assertEqual(accuracy.config_text(one).splitlines(), [
            "# sor single, 2 x 3, dt 0.01 s: frame time 1.000 ms, defect rms 10 mm, max 0 mm", "scene = Fake", "stepper = sor", "dt = 0.01",
            "iterations = 3", "substeps = 2", "precision = single", "steps-per-frame = 3", "replicas = 1", "warmup = 0", "frames = 5"])
        self.assertEqual(one.run_command(), f"mpirun -n 1 pbmpi --scene Fake {STEP} --steps-per-frame 3 --replicas 1 --warmup 0 --frames 5")


class Diagrams(unittest.TestCase):
    def test_shapes_tell_substeps_and_sizes_iterations(self):
        cases = [case(1, 1, substeps=substeps, iterations=4 ** power) for power, substeps in enumerate((1, 2, 3, 5, 8, 13))]
        sweeps = diagrams.Sweeps(cases)
        self.assertEqual([sweeps.shape(substeps) for substeps in (1, 2, 8, 13)], ["circle", "triangle", "star", "star"])
        self.assertEqual([sweeps.radius(iterations) for iterations in (1, 32, 1024)], [3, 4.75, 6.5])
        self.assertEqual([entry["label"] for entry in sweeps.key()],
                         ["1 substep", "2 substeps", "3 substeps", "5 substeps", "8 substeps or more", "1 iteration", "1024 iterations"])

    def test_a_diagram_draws_what_did_not_blow_up_and_rings_the_chosen(self):
        cases = scene(second_method=4)
        cases.add(case(1, 1, kind="estimate", **BLOWN_UP))
        config = diagrams.diagram(cases, Limit(tolerance_m=6e-3), "rms", "Position", "defect [mm]").config
        front, settings, chosen = config["data"]["datasets"]
        self.assertEqual([point["x"] for point in front["data"]], [1, 2, 4])
        self.assertEqual((settings["label"], len(settings["data"])), ("sor single", 5))
        self.assertEqual(chosen["data"][0]["label"], "chosen: sor single, 2 x 3, dt 0.01 s (2 substeps of 3 iterations): 2.000 ms, 5 mm")
        self.assertEqual([(band["label"], band["to"]) for band in config["options"]["plugins"]["pbmpi"]["bands"]],
                         [("uncertainty of the reference [mm]", 4), ("another solver seed: noise floor [mm]", 2.5),
                          ("second method: ODE [mm]", 4), ("tolerance [mm]", 6)])

    def test_a_tolerance_is_drawn_where_its_measure_is(self):
        bands = diagrams.bands(scene(), Limit("rms", tolerance_m=1e-3), "max")
        self.assertNotIn("tolerance [mm]", [band["label"] for band in bands])
        self.assertIn("budget [ms]", [band["label"] for band in diagrams.bands(scene(), Limit("rms", budget_s=1e-3), "max")])


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "accuracy.h5")
        self.config = os.path.join(folder.name, "chosen.cfg")
        rows = [columns_of(1, 10), columns_of(2, 5, rest_fallen=0.0, rest_fell_at=math.inf), columns_of(0.5, 8, **BLOWN_UP),
                columns_of(1, 3, kind="estimate", estimate_iterations=1), columns_of(9, 1, kind="floor"),
                columns_of(9, 0, kind="reference", solve_residual=1e-6, solve_iterations=640.0), columns_of(9, 2, kind="more_iterations")]
        with h5py.File(self.path, "w") as file:
            file.attrs["filetype"], file.attrs["study"], file.attrs["version"] = np.bytes_("pbmpi-study"), np.bytes_("accuracy"), [1, 7]
            file["parameters/seed"], file["parameters/reference_iterations"] = 1, 640
            for name in rows[0]:
                values = [row[name] for row in rows]
                file[f"cases/{name}"] = np.array(values, dtype="S") if isinstance(values[0], str) else values

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
        self.assertEqual((found["noise_floor_m"], found["more_iterations_m"], found["uncertainty_m"]), (1e-3, 2e-3, 2e-3))
        self.assertEqual(found["reference"], {"residual_m": 1e-6, "iterations": 640})
        self.assertEqual(found["estimates"][0]["estimate"], {"iterations": 1})
        self.assertEqual(found["chosen"]["at_rest"], {"fallen": 0, "fell_at_s": None, "creep_m_s": None, "energy_gain_j": None})
        self.assertNotIn("at_rest", found["front"][0], "nothing was watched")
        self.assertNotIn("own", found)
        self.assertIs(found["chosen"]["inside_uncertainty"], False)
        self.assertEqual(found["chosen"]["options"]["steps-per-frame"], "3")

    def test_text_shows_the_front_and_what_was_left_out(self):
        text = self.printed("--tolerance", "6mm", "--write-config", self.config)
        for words in ("3 settings. 1 of them blew up (inf or NaN) and is left out.", "run: mpirun -n 1 pbmpi --scene Fake --stepper sor",
                      "tolerance 6 mm: sor single, 2 x 3, dt 0.01 s (2.000 ms", "solved to 0.001 mm a step, with 640 iterations",
                      "more iterations, and from a second method; 2 mm (rms of body positions)", "sor single, 2 x 3, dt 0.01 s (chosen)"):
            self.assertIn(words, text)
        self.assertNotIn("Own solutions", text)
        config = pathlib.Path(self.config).read_text(encoding="utf-8")
        self.assertTrue(config.startswith("# sor single, 2 x 3, dt 0.01 s: frame time 2.000 ms"), config)

    def test_contradictions_are_refused(self):
        for words, said in (([], "no file"), (["a.h5", "b.h5"], "one study"), (["a.h5", "--write-config", "p"], "--budget"),
                            (["a.h5", "--budget", "1ms", "--tolerance", "1cm"], "exclude"),
                            (["a.h5", "--measure", "mean"], "rms, p99, max or joint"),
                            (["a.h5", "--budget", "3.33"], "unit"), ([self.path, "--html", self.path], "name another file"),
                            ([self.path, "--budget", "1us", "--write-config", self.config], "no setting of the study keeps"),
                            ([self.path, "--scene", "Fight"], "the study has Fake")):
            self.assertIn(said, self.refusal(*words), words)
        self.assertFalse(os.path.exists(self.config))


if __name__ == "__main__":
    unittest.main()
