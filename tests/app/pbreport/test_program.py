"""pbreport on files that pbmpi really wrote, and on files that are none."""
import json
import os
import signal
import sys
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, PBREPORT, ProgramTest  # noqa: E402


PBSTUDY = os.path.join(BIN, "pbstudy")


class ReportTest(ProgramTest):
    def report(self, *args):
        return self.run_command([PBREPORT, *args])

    def run_scene(self, ranks=2, scene="CrashSk", *args):
        """The live summary of a run whose file is run.h5."""
        return self.summary(ranks, "--scene", scene, "--output", "run.h5", *args)

    def test_tells_the_same_as_the_run_itself(self):
        live = self.run_scene(2, "CrashSk", "--replicas", "3")
        told = json.loads(self.report("run.h5", "--json").stdout)
        for key in ("scene", "worlds", "bodies", "ranks", "stepper", "iterations", "dt", "steps_per_frame", "seed",
                    "frames", "rebalances", "state_hash", "effects", "complete"):
            self.assertEqual(told[key], live[key], key)
        for group in ("frame_rate", "frame_time_s", "islands", "contacts", "rows", "invariants", "efficiency"):
            for name, value in live[group].items():
                # The file holds the same doubles; only the order of a sum may differ.
                self.assertAlmostEqual(told[group][name], value, delta=1e-9 * max(1, abs(value)),
                                       msg=f"{group}.{name}")

    def test_tells_that_a_killed_run_is_incomplete(self):
        process = self.start(2, "--scene", "CrashSk", "--frames", "20000", "--output", "run.h5", "--quiet")
        while not os.path.exists(self.path("run.h5")):
            self.assertIsNone(process.poll(), "pbmpi ended before it was killed")
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        told = json.loads(self.report("run.h5", "--json").stdout)
        self.assertFalse(told["complete"])
        self.assertIn("none", told["state_hash"])
        self.assertEqual(self.report("run.h5", "--html", "run.html").returncode, 0)

    def test_prints_one_line_a_number(self):
        live = self.run_scene()
        result = self.report("run.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertIn("state_hash: " + live["state_hash"], lines)
        self.assertTrue(any(line.startswith("frame_rate: ") for line in lines))
        self.assertEqual(self.report("report", "run.h5").stdout, result.stdout)

    def test_writes_a_page_that_stands_alone(self):
        live = self.run_scene()
        result = self.report("run.h5", "--html", "run.html", "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        with open(self.path("run.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertIn(live["state_hash"], page)
        self.assertNotIn('src="', page.split("<script>")[0])

    def test_rewrites_the_sidecar(self):
        self.run_scene()
        result = self.report("run.h5", "--xdmf", "again.xdmf")
        self.assertEqual(result.returncode, 0, result.stderr)
        root = xml.etree.ElementTree.parse(self.path("again.xdmf")).getroot()
        self.assertEqual(root.tag, "Xdmf")

    def assert_refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_refuses_bad_input_with_one_message(self):
        self.assert_refused(self.report(), "no file given")
        self.assert_refused(self.report("absent.h5"), "absent.h5")
        self.assert_refused(self.report(self.write("text.h5", "not HDF5\n")), "text.h5")
        self.assert_refused(self.report("--frmaes", "x.h5"), "--frmaes")

    def test_refuses_a_place_where_it_cannot_write(self):
        self.run_scene()
        self.assert_refused(self.report("run.h5", "--html", "no/folder/x.html"), "no/folder/x.html")
        self.assert_refused(self.report("run.h5", "--html", "run.h5"), "run.h5")

    def test_a_place_that_takes_no_more_is_a_failure(self):
        disk = self.small_disk("8k")
        self.run_scene()
        study = [PBSTUDY, "effects", "--scene", "CrashSk", "--effect", "friction", "--frames", "1", "--repeats", "1", "-o", "study.h5", "-q"]
        self.assertEqual(self.run_command(study).returncode, 0)
        for args in (["run.h5", "--html", f"{disk}/x.html"], ["csv", "run.h5", "-o", f"{disk}/x.csv"], ["csv", "run.h5", "-o", "/dev/full"],
                     ["diff", "run.h5", "run.h5", "--html", f"{disk}/x.html"],
                     ["study.h5", "--csv", "/dev/full"], ["study.h5", "--html", f"{disk}/x.html"]):
            result = self.report(*args)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), (args, result.stderr))
            self.assertIn("it cannot be written: No space left on device", result.stderr)
            self.assertEqual(os.listdir(disk), [], "nothing is left behind")


if __name__ == "__main__":
    unittest.main()
