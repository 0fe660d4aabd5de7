"""The rules of the statements on value prediction, and the bars of the paper's Figure 8."""
import unittest

import made_up  # noqa: F401  which adds the folder of what is tested

from prediction import Case, FrameRate, PredictionScene, Study, figure_8
from statements.prediction import judge_study
from statements.statement import CONFIRMED, REFUTED, UNDECIDABLE


def case_of(name, hz, predicted_hz, satisfied=0.5):
    return Case(name, ended=True, same_hash=True, mix=(0.34, 0.25, 0.06, 0.05, 0.30), collision_share=0.07,
                unpredicted=FrameRate(hz, satisfied), predicted=FrameRate(predicted_hz, satisfied), islands=10, base_islands=10,
                errors={"drift": (0, [])})


def scene_of(name):
    """The scene with the paper's numbers."""
    return PredictionScene(name, cases=[
        case_of("20Iter", 100, 105), case_of("19Iter", 104, 109), case_of("FEEC", 320, 330), case_of("FEEC+FVP6", 320, 321),
        case_of("FVP6", 100, 124, 0.6), case_of("FVP12", 100, 106)])


def study_of(*scenes):
    return Study(1 / 300, "FVP6", list(scenes))


class Verdicts(unittest.TestCase):
    def on(self, study, words):
        return next(verdict for verdict in judge_study(study) if words in verdict.statement.text)

    def finding(self, study, words):
        return self.on(study, words).finding

    def test_what_is_as_in_the_paper_is_confirmed(self):
        battle, fight, cars = map(scene_of, ("Battle2", "Fight", "2-Cars"))
        fight.find("FVP6").predicted.hz = cars.find("FVP6").predicted.hz = 103
        for scene in (battle, fight):  # FEEC with FVP6 is slower, with fewer islands
            scene.find("FEEC+FVP6").predicted.hz, scene.find("FEEC+FVP6").islands = 300, 8
        battle.find("FVP12").nonfinite_frame = 2
        for verdict in judge_study(study_of(battle, fight, cars)):
            if "alike" not in verdict.statement.text:  # needs runs of single phases
                self.assertEqual(verdict.finding, CONFIRMED, verdict)

    def test_what_is_not_is_refuted(self):
        battle, fight = map(scene_of, ("Battle2", "Fight"))
        battle.find("FVP6").predicted.hz = 105
        fight.find("FVP6").predicted.satisfied = 0.4
        fight.base.same_hash = False
        battle.base.mix = (0.2,) * 5
        for scene in (battle, fight):
            scene.find("FEEC").unpredicted.hz, scene.base.collision_share = 101, 0.4
        study = study_of(battle, fight)
        for words in ("Battle2", "Fight", "raises the frame rate by 220", "less attractive", "slows three tests", "1e-12",
                      "leaves the result", "34 %", "collision detection is"):
            verdict = self.on(study, words)
            self.assertEqual(verdict.finding, REFUTED, verdict)
            self.assertNotEqual(verdict.ours, "")

    def test_nothing_is_decided_where_nothing_was_measured(self):
        cars = scene_of("2-Cars")
        del cars.cases[2:]
        for words in ("Battle2", "Fight", "220", "less attractive", "slows three tests", "larger islands", "1e-12", "alike"):
            self.assertEqual(self.finding(study_of(cars), words), UNDECIDABLE, words)
        self.assertEqual({verdict.finding for verdict in judge_study(Study())}, {UNDECIDABLE})

    def test_the_majority_is_of_the_scenes_that_gain_little(self):
        battle, fight, cars = map(scene_of, ("Battle2", "Fight", "2-Cars"))
        fight.find("FVP6").predicted.hz = cars.find("FVP6").predicted.hz = 103
        self.assertEqual(self.finding(study_of(battle, fight, cars), "majority"), CONFIRMED)
        cars.find("FVP6").predicted.hz = 130
        self.assertEqual(self.finding(study_of(battle, fight, cars), "majority"), REFUTED)

    def test_frames_that_were_all_satisfied_before_decide_nothing(self):
        fight = scene_of("Fight")
        fight.base.unpredicted.satisfied = fight.find("FVP6").predicted.satisfied = 1
        self.assertEqual(self.finding(study_of(fight), "Fight"), UNDECIDABLE)

    def test_what_a_run_that_blew_up_gains_is_left_out(self):
        fight, battle = map(scene_of, ("Fight", "Battle2"))
        fight.find("FVP6").predicted.hz = 110
        broken = battle.find("FVP6")
        broken.predicted.hz, broken.nonfinite_frame = 1000, 3  # its bodies are lost, so there is less to compute
        self.assertIn("FVP6 +10.0 %", self.on(study_of(fight, battle), "less attractive").ours)

    def test_single_phases_go_by_their_drift(self):
        scene = scene_of("CrashSk")
        for name in ("FVP6 collision", "FVP6 step"):
            scene.cases.append(case_of(name, 100, 101))
            scene.cases[-1].errors = {"drift": (2e-3, [])}
        scene.find("FVP6").errors = {"drift": (1e-3, [])}
        self.assertEqual(self.finding(study_of(scene), "alike"), CONFIRMED)
        scene.find("FVP6").errors = {"drift": (1, [])}
        self.assertEqual(self.finding(study_of(scene), "alike"), REFUTED)

    def test_figure_8_has_the_papers_bars(self):
        bars = figure_8(scene_of("Fight"), "FVP6")
        self.assertEqual([(bar.name, bar.rate.hz) for bar in bars],
                         [("20Iter", 100), ("19Iter", 104), ("FEEC", 320), ("FVP6", 124), ("EVP", 105), ("FEEC+FVP6", 321)])


if __name__ == "__main__":
    unittest.main()
