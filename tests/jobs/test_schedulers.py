"""The forms of the job scripts for PBS and LSF, run by stubs of these, and all shell scripts read by shellcheck."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py

from stub_schedulers import Queue

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SMALL = "--replicas 2 --frames 1"
LONG = "--replicas 2 --frames 60 --steps-per-frame 300 --record-every 20"


class SchedulerTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pbmpi-jobs-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.work = os.path.join(self.folder, "work")
        os.mkdir(self.work)
        self.queue = Queue(self.folder)

    def submit(self, program, *args, arguments, script="", **more):
        environment = {**os.environ, "PATH": self.queue.bin + os.pathsep + os.environ["PATH"], "PBMPI_HOME": SOURCE,
                       "PBMPI_ARGS": arguments, **more}
        subprocess.run([program, *args], cwd=self.work, env=environment, check=True, capture_output=True, text=True,
                       input=script)

    def qsub(self, name, arguments, *options, **more):
        self.submit("qsub", "-V", *options, os.path.join(SOURCE, "jobs", "pbs", name), arguments=arguments, **more)

    def bsub(self, name, arguments, *options, **more):
        with open(os.path.join(SOURCE, "jobs", "lsf", name), encoding="utf-8") as file:
            self.submit("bsub", *options, arguments=arguments, script=file.read(), **more)

    def left(self, suffix=".h5"):
        return sorted(name for name in os.listdir(self.work) if name.endswith(suffix))

    def attributes(self, name):
        with h5py.File(os.path.join(self.work, name)) as file:
            return dict(file.attrs)

    def all_done(self, results):
        for code, output in results:
            self.assertEqual(code, 0, output)


class Pbs(SchedulerTest):
    def test_one_scene_over_the_hosts_of_the_job(self):
        self.qsub("pbmpi.pbs", "CrashSk " + SMALL)
        self.all_done(self.queue.run_all())
        self.assertEqual(self.left(""), ["CrashSk-100.h5", "CrashSk-100.html", "CrashSk-100.xdmf"])
        with h5py.File(os.path.join(self.work, "CrashSk-100.h5")) as file:
            self.assertEqual(file["ranks/host"].shape[0], 2)

    def test_bad_usage_keeps_its_exit_code(self):
        self.qsub("pbmpi.pbs", "")
        self.assertEqual(self.queue.run_all()[0][0], 2)

    def test_without_the_checkout_it_says_what_is_missing(self):
        self.qsub("pbmpi.pbs", "CrashSk " + SMALL, PBMPI_HOME=self.work)
        code, output = self.queue.run_all()[0]
        self.assertEqual(code, 2)
        self.assertIn("PBMPI_HOME", output)

    def test_a_sweep_as_an_array(self):
        self.qsub("sweep.pbs", "CrashSk substeps 2 4 -- " + SMALL, "-J", "0-2")
        first, second, none = self.queue.run_all()
        self.all_done([first, second])
        self.assertEqual(self.left(), ["CrashSk-substeps-2-100_0.h5", "CrashSk-substeps-4-100_1.h5"])
        self.assertEqual(none[0], 2)
        self.assertIn("-J 0-1", none[1])

    def test_a_run_of_a_sweep_ends_by_itself_before_the_walltime(self):
        self.qsub("sweep.pbs", "CrashSk substeps 24 -- " + LONG, "-l", "walltime=00:00:02", PBMPI_NOTICE="1")
        code, output = self.queue.run_all()[0]
        self.assertEqual(code, 75, output)
        self.assertEqual(self.left(), ["CrashSk-substeps-24-100.checkpoint.h5", "CrashSk-substeps-24-100.h5"])

    def test_a_job_whose_walltime_is_up_is_submitted_again_and_goes_on(self):
        script = os.path.join(SOURCE, "jobs", "pbs", "pbmpi.pbs")
        limit = ("-l", "walltime=00:00:02")
        self.qsub("pbmpi.pbs", "CrashSk " + LONG, *limit, PBMPI_REQUEUE="yes", PBMPI_NOTICE="1", PBMPI_SUBMIT=f"{script}")
        results = self.queue.run_all()
        self.assertEqual(results[0][0], 75, results[0][1])
        self.all_done(results[1:])
        self.assertEqual(len(results), 2)
        self.assertEqual(self.left(), ["CrashSk-100.2.h5", "CrashSk-100.checkpoint.h5", "CrashSk-100.h5"])
        self.assertEqual(self.attributes("CrashSk-100.2.h5")["first_frame"], self.attributes("CrashSk-100.h5")["frames_committed"])
        self.assertEqual(self.attributes("CrashSk-100.2.h5")["complete"], 1)

    def test_a_round_of_scaling_a_task(self):
        self.qsub("scaling.pbs", "--frames 1 out CrashSk:worlds:2", "-J", "1-2")
        self.all_done(self.queue.run_all())
        with open(os.path.join(self.work, "out", "scaling.txt"), encoding="utf-8") as report:
            self.assertIn("CrashSk, 2 worlds", report.read())
        self.assertEqual(sum(name.endswith(".h5") for name in os.listdir(os.path.join(self.work, "out"))), 4)


class Lsf(SchedulerTest):
    def test_one_scene(self):
        self.bsub("pbmpi.lsf", "CrashSk " + SMALL)
        self.all_done(self.queue.run_all())
        self.assertEqual(self.left(""), ["CrashSk-100.h5", "CrashSk-100.html", "CrashSk-100.xdmf"])

    def test_arrays_begin_with_1(self):
        self.bsub("sweep.lsf", "CrashSk substeps 2 4 -- " + SMALL, "-J", "sweep[1-3]")
        first, second, none = self.queue.run_all()
        self.all_done([first, second])
        self.assertEqual(self.left(), ["CrashSk-substeps-2-100_1.h5", "CrashSk-substeps-4-100_2.h5"])
        self.assertEqual(none[0], 2)
        self.assertIn("[1-2]", none[1])

    def test_a_job_that_is_warned_goes_back_into_the_queue_and_on(self):
        self.bsub("pbmpi.lsf", "CrashSk " + LONG, PBMPI_REQUEUE="yes")
        results = self.queue.run_all(warn_when=lambda: "CrashSk-100.h5" in self.left())
        self.assertEqual([code for code, _ in results], [75, 0], results)
        self.assertEqual(self.left(), ["CrashSk-100.2.h5", "CrashSk-100.checkpoint.h5", "CrashSk-100.h5"])

    def test_a_task_that_is_warned_goes_back_into_the_queue_without_the_others_of_its_array(self):
        self.bsub("scaling.lsf", "--ranks 1,2 --frames 30 out CrashSk:worlds:2 -- --steps-per-frame 300", "-J", "scaling[1-2]",
                  PBMPI_REQUEUE="yes")
        seen = set()

        def begins():
            folder = os.path.join(self.work, "out")
            runs = re.compile(r".*-k\d\.h5")  # a stopped one leaves a checkpoint, too
            new = set(filter(runs.fullmatch, os.listdir(folder) if os.path.isdir(folder) else [])) - seen
            seen.update(new)
            return bool(new)
        results = self.queue.run_all(warn_when=begins)
        self.assertEqual([code for code, _ in results], [75, 75, 0, 0], results)
        self.assertEqual(len(seen), 2)
        with open(os.path.join(self.work, "out", "scaling.txt"), encoding="utf-8") as report:
            self.assertEqual(report.read().count("2 of 5 repeats"), 4, "for each point, in the sentence and in the table")

    def test_a_study_goes_on_with_the_cases_that_are_left(self):
        study = "stability --scene hard/free/cradle hard/free/exchange hard/rest/column10 --setting sor quick --dt 0.002 0.001"
        self.bsub("study.lsf", study, PBMPI_REQUEUE="yes")
        results = self.queue.run_all(warn_when=lambda: len(self.left(".cases-0") + self.left(".cases-1")) == 2)
        self.assertEqual([code for code, _ in results], [75, 0], results)
        self.assertEqual(self.left(""), ["stability-100.h5", "stability-100.html"])


class Scripts(unittest.TestCase):
    def test_shellcheck_finds_nothing(self):
        scripts = [os.path.join(folder, name) for top in ("jobs", "tests") for folder, _, names in os.walk(os.path.join(SOURCE, top))
                   for name in names if name.endswith((".sh", ".sbatch", ".pbs", ".lsf"))] + [os.path.join(SOURCE, ".ci", "run")]
        self.assertGreater(len(scripts), 30)
        result = subprocess.run(["shellcheck", "--severity=warning", "--external-sources", *scripts], cwd=SOURCE, capture_output=True,
                                text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
