"""pbreport engines: fronts, yardsticks and hard cases as they follow from the studies' tables by another hand, and what it refuses."""
import csv
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, ProgramTest  # noqa: E402

ACCURACY = ["--scene", "CrashSk", "2-Cars", "--stepper", "quick", "direct", "sor", "--iterations", "2", "20", "--substeps", "1", "4", "--dt",
            "0.01", "--frames", "2", "--repeats", "1", "--estimates", "0", "--floor-seeds", "1", "--nature-steps", "96",
            "--rest-seconds", "0.5"]
CASES = ["--scene", "hard/rest/column10", "hard/joints/chain20_1", "hard/contact/ramp_mu05_24", "--setting", "quick", "sor", "sor substeps=4"]


class Engines(ProgramTest):
    def study(self, kind, name, *args):
        result = self.run_command([os.path.join(BIN, "pbstudy"), kind, *args, "--output", name, "--quiet"])
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def engines(self, *args):
        result = self.report("engines", *args, "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return self.json(result)

    def rows(self, name):
        self.assertEqual(self.report(name, "--csv", "cases.csv", "--quiet").returncode, 0)
        with open(self.path("cases.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def front(self, cases, column):
        """(time, error) of what no other case beats in both, by rising time; what fells or blew up is left out."""
        points = sorted((float(case["frame_time_worst"]), float(case[column])) for case in cases
                        if float(case["rest_fallen"]) == 0 and int(case["defect_body_position_bands_4"]) == 0)
        return [(time, error) for i, (time, error) in enumerate(points) if all(error < other for _, other in points[:i])]

    def test_fronts_and_own_solutions_are_those_of_the_table(self):
        self.study("accuracy", "a.h5", *ACCURACY)
        found, rows = self.engines("a.h5"), self.rows("a.h5")
        self.assertEqual([scene["scene"] for scene in found["scenes"]], ["CrashSk", "2-Cars"])
        for scene in found["scenes"]:
            of_scene = [row for row in rows if row["scene"] == scene["scene"]]
            self.assertEqual([engine["engine"] for engine in scene["engines"]], ["quick", "direct", "sor"])
            for engine in scene["engines"]:
                cases = [row for row in of_scene if row["kind"] == "setting" and row["stepper"] == engine["engine"]]
                self.assertEqual(engine["settings"], len(cases))
                for name, column in (("nature", "defect_body_position_rms"), ("own", "own_defect_body_position_rms")):
                    points = [(point["frame_time_s"]["worst"], point[f"{name}_error_m"]) for point in engine[f"{name}_front"]]
                    self.assertEqual(points, self.front(cases, column), (scene["scene"], engine["engine"], name))
                    self.assertTrue(points)
                [floor] = [row for row in of_scene if row["kind"] == "own_floor" and row["stepper"] == engine["engine"]]
                [own] = [row for row in of_scene if row["kind"] == "own" and row["own"] == floor["own"]]
                solution = engine["own_solution"]
                self.assertEqual(solution["noise_m"], float(floor["own_defect_body_position_rms"]))
                self.assertEqual(solution["from_nature_m"], float(own["defect_body_position_rms"]))
                self.assertEqual(solution["from_fewer_iterations_m"],
                                 None if engine["engine"] == "direct" else float(own["own_defect_body_position_rms"]))
        text = self.report("engines", "a.h5", "--scene", "2-Cars").stdout
        self.assertIn("2-Cars: error against its own solution", text)
        self.assertNotIn("CrashSk: ", text)

    def test_without_own_solutions_there_is_one_yardstick(self):
        self.study("accuracy", "a.h5", *ACCURACY, "--own-iterations", "0")
        [scene, _] = self.engines("a.h5")["scenes"]
        for engine in scene["engines"]:
            self.assertTrue(engine["nature_front"])
            self.assertEqual(engine["own_front"], [])
        self.assertNotIn("its own solution", self.report("engines", "a.h5", "--markdown").stdout)

    def test_hard_cases_are_counted_by_group_and_setting(self):
        self.study("stability", "s.h5", *CASES)
        found, rows = self.engines("s.h5"), self.rows("s.h5")
        self.assertEqual(found["scenes"], [])
        self.assertEqual([one["engine"] for one in found["hard_cases"]], ["quick", "sor", "sor"])
        for one in found["hard_cases"]:
            for group, counts in one["groups"].items():
                verdicts = [row["verdict"] for row in rows if row["setting"] == one["setting"] and row["group"] == group]
                self.assertEqual(sum(counts.values()), len(verdicts))
                for verdict, count in counts.items():
                    self.assertEqual(count, verdicts.count(verdict))
            self.assertEqual(sum(one["all"].values()), 3)
        self.assertGreater(found["hard_cases"][1]["all"]["pass"], found["hard_cases"][0]["all"]["pass"], "sor holds more than quick")

    def test_a_study_is_found_wherever_its_hard_cases_stand(self):
        self.study("stability", "s.h5", *CASES)
        self.study("accuracy", "a.h5", "--scene", "CrashSk", "--stepper", "quick", "--iterations", "2", "--dt", "10ms", "--frames", "1",
                   "--repeats", "1", "--estimates", "0", "--floor-seeds", "1", "--nature-steps", "6", "--rest-seconds", "0",
                   "--own-iterations", "0")
        texts = [self.report(*args).stdout for args in (("a.h5", "--hard-cases", "s.h5"), ("--hard-cases", "s.h5", "a.h5"),
                                                        ("--hard-cases=s.h5", "a.h5"))]
        self.assertIn("CrashSk", texts[0])
        self.assertEqual(texts, [texts[0]] * 3)

    def test_what_an_engine_takes_otherwise_is_what_describe_says(self):
        if "not in this build" in " ".join(self.pbmpi(1, "--help", "all").stdout.split()):
            self.skipTest("this build lacks an engine")
        accuracy = ["--scene", "CrashSk", "--stepper", "bullet", "mujoco", *ACCURACY[ACCURACY.index("--iterations"):]]
        self.study("accuracy", "a.h5", *accuracy)
        found = self.engines("a.h5")
        for engine in ("bullet", "mujoco"):
            described = self.pbmpi(1, "--scene", "CrashSk", "--stepper", engine, "--describe").stdout
            lines = {line.removeprefix(f"{engine}: ") for line in described.splitlines() if line.startswith(f"{engine}: ")}
            self.assertEqual({one["text"] for one in found["differences"] if one["engine"] == engine}, lines)
            self.assertTrue(lines)
            self.assertIn("double precision", found["studies"][0]["versions"][engine])

    def test_one_study_of_each_kind_is_taken_and_nothing_else(self):
        self.study("stability", "s.h5", *CASES)
        self.assertEqual(self.pbmpi(1, "--scene", "CrashSk", "--frames", 2, "--output", "run.h5", "--quiet").returncode, 0)
        for args, message in (([], "no file given"), (["s.h5", "s.h5"], "give one study of stability"), (["run.h5"], "this is no study"),
                              (["s.h5", "--scene", "CrashSk"], "name one"), (["s.h5", "--json", "--markdown"], "print one of the two"),
                              (["missing.h5"], "missing.h5")):
            result = self.report("engines", *args)
            self.assertEqual((result.returncode, result.stdout), (2, ""), args)
            self.assertIn(message, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1)


unittest.main()
