"""Submits the job scripts to a real Slurm of two nodes, and reads what they leave."""
import os
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

from slurm import Cluster, wait_until

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(SOURCE, "jobs", "pbmpi.sbatch")
SCALING = os.path.join(SOURCE, "jobs", "scaling.sbatch")
STUDY = os.path.join(SOURCE, "jobs", "study.sbatch")
SWEEP = os.path.join(SOURCE, "jobs", "sweep.sbatch")
JOB_LIMIT_S = 240  # a job that hangs, not a slow one: the longest here ends with Slurm's time limit of a minute
# Frames of 3 s: minutes of work in a file of a few MB, and a stop within a second.
ENDLESS = ("--frames", "20000", "--steps-per-frame", "300", "--record-every", "20")
STOPPED = "75:0"  # exit code:signal


class JobTest(unittest.TestCase):
    """One cluster for all tests that need one; each test submits from an empty folder of its own."""

    cluster = None

    @classmethod
    def setUpClass(cls):
        if JobTest.cluster is not None:
            return
        JobTest.cluster = Cluster().__enter__()
        unittest.addModuleCleanup(JobTest.cluster.__exit__, None, None, None)

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pbmpi-jobs-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def log_of(self, name):
        with open(self.path(name), encoding="utf-8", errors="replace") as file:
            return file.read()

    def submit(self, *args):
        return self.cluster.submit(*args, cwd=self.folder)

    def ended(self, job_id):
        """The job's fields, once it has ended."""
        return self.cluster.wait_for(job_id, JOB_LIMIT_S)[0]

    def wait_while_it_runs(self, job_id, condition, what):
        def met():
            self.assertIsNone(self.cluster.ended(job_id), f"no {what}, the job is over")
            return condition()
        wait_until(met, what, JOB_LIMIT_S)

    def start_endless(self):
        """A job of 4 ranks over both nodes, once its file is there; returns its id."""
        job_id = self.submit("-N2", "-n4", SCRIPT, "CrashSk", "--replicas", "4", *ENDLESS)
        self.wait_while_it_runs(job_id, lambda: os.path.exists(self.path(f"CrashSk-{job_id}.h5")), "file")
        return job_id

    def check_file(self, name, complete):
        """Opens the file of a run; its bodies must be finite in every frame committed. Returns what tests look at."""
        with h5py.File(self.path(name), "r") as file:
            self.assertEqual(int(file.attrs["complete"]), complete)
            committed = int(file.attrs["frames_committed"])
            self.assertEqual(len(file["timings/frame/wall"]), committed, "the file is cut to what was simulated")
            self.assertTrue(np.isfinite(file["particles/bodies/position/value"][:]).all())
            return {"frames": committed, "ranks": file["timings/rank/useful"].shape[1],
                    "parameters": {key: text_of(value[()]) for key, value in file["parameters"].items()}}


def text_of(value):
    return value.decode() if isinstance(value, bytes) else value


class Scene(JobTest):
    def test_runs_on_four_ranks_over_both_nodes_and_leaves_a_complete_file_and_its_page(self):
        job_id = self.submit("-N2", "-n4", SCRIPT, "CrashSk", "--replicas", "4", "--frames", "3")
        job = self.ended(job_id)
        log = self.log_of(f"slurm-{job_id}.out")
        self.assertEqual((job["JobState"], job["ExitCode"]), ("COMPLETED", "0:0"), log)
        self.assertEqual((job["NumNodes"], job["BatchHost"]), ("2", "n1"))
        run = self.check_file(f"CrashSk-{job_id}.h5", complete=1)
        self.assertEqual(run["ranks"], 4)
        self.assertEqual(run["parameters"]["env_SLURM_JOB_ID"], job_id)
        self.assertEqual(run["parameters"]["env_SLURM_JOB_NODELIST"], "n[1-2]")
        self.assertIn("state_hash: ", log)
        self.assertIn("<canvas", self.log_of(f"CrashSk-{job_id}.html"))

    def test_leaves_the_name_of_the_file_to_the_options(self):
        job_id = self.submit("-n1", SCRIPT, "CrashSk", "--frames", "1", "--output", "mine.h5")
        self.assertEqual(self.ended(job_id)["ExitCode"], "0:0", self.log_of(f"slurm-{job_id}.out"))
        self.check_file("mine.h5", complete=1)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".h5")], ["mine.h5"])
        self.assertTrue(os.path.exists(self.path("mine.html")))

    def test_bad_input_keeps_its_exit_code_and_leaves_no_file(self):
        job_id = self.submit("-n2", SCRIPT, "NoSuchScene")
        self.assertEqual(self.ended(job_id)["ExitCode"], "2:0")
        self.assertEqual(os.listdir(self.folder), [f"slurm-{job_id}.out"])
        self.assertEqual(self.log_of(f"slurm-{job_id}.out").count("pbmpi: "), 1, "one message from one rank")


class Stop(JobTest):
    def check_stopped(self, job_id):
        """The run ended early and in good order: its exit code, a closed file, its page."""
        job = self.ended(job_id)
        self.assertEqual(job["ExitCode"], STOPPED, self.log_of(f"slurm-{job_id}.out"))
        run = self.check_file(f"CrashSk-{job_id}.h5", complete=0)
        self.assertGreater(run["frames"], 0)
        self.assertTrue(os.path.exists(self.path(f"CrashSk-{job_id}.html")))
        return job

    def test_term_to_the_batch_shell_finishes_the_frame_and_exits_75(self):
        job_id = self.start_endless()
        self.cluster.command("scancel", "--batch", "--signal=TERM", job_id)
        self.assertEqual(self.check_stopped(job_id)["JobState"], "FAILED", "Slurm's word for any code but 0")

    def test_a_job_near_its_time_limit_stops_before_slurm_kills_it(self):
        job_id = self.submit("-n2", "--time=1", "--signal=B:TERM@50", SCRIPT, "CrashSk", "--replicas", "2", *ENDLESS)
        job = self.check_stopped(job_id)
        self.assertEqual(job["JobState"], "FAILED", "TIMEOUT would mean that Slurm had to kill it")

    def test_a_plain_cancel_leaves_a_file_that_opens_with_what_was_flushed(self):
        job_id = self.start_endless()
        name = f"CrashSk-{job_id}.h5"
        self.wait_while_it_runs(job_id, lambda: self.committed(name) > 0, "flush")
        self.cluster.command("scancel", job_id)
        self.assertEqual(self.ended(job_id)["JobState"], "CANCELLED")
        self.assertGreater(self.committed(name), 0)

    def test_a_job_that_ran_out_of_time_goes_back_into_the_queue_and_on_from_its_checkpoint(self):
        # Seconds of work, of which the first part gets one; the time limit is far.
        args = ("CrashSk", "--replicas", "2", "--frames", "60", "--steps-per-frame", "300", "--record-every", "20")
        job_id = self.submit("-n2", "--export=ALL,PBMPI_REQUEUE=yes", SCRIPT, *args)
        first, second = f"CrashSk-{job_id}.h5", f"CrashSk-{job_id}.2.h5"
        self.wait_while_it_runs(job_id, lambda: os.path.exists(self.path(first)), "file")
        self.cluster.command("scancel", "--batch", "--signal=TERM", job_id)
        wait_until(lambda: self.cluster.job(job_id)[0].get("Restarts") == "1", "the job to be queued again", JOB_LIMIT_S)
        wait_until(lambda: self.cluster.job(job_id)[0]["JobState"] != "COMPLETING", "the end of its first part", JOB_LIMIT_S)
        # Slurm would wait two minutes. Within a second the node would take it for what it has just killed.
        self.cluster.command("scontrol", "update", f"JobId={job_id}", "StartTime=now+3")
        job = self.ended(job_id)
        self.assertEqual((job["JobState"], job["ExitCode"]), ("COMPLETED", "0:0"), self.log_of(f"slurm-{job_id}.out"))
        before = self.check_file(first, complete=0)["frames"]
        self.assertEqual(before + self.check_file(second, complete=1)["frames"], 63)
        with h5py.File(self.path(second)) as file:
            self.assertEqual(int(file.attrs["first_frame"]), before)
        self.assertTrue(os.path.exists(self.path(f"CrashSk-{job_id}.2.html")))

    def committed(self, name):
        with h5py.File(self.path(name), "r") as file:
            committed = int(file.attrs["frames_committed"])
            self.assertTrue((file["timings/frame/wall"][:committed] > 0).all(), "a committed frame is in the file")
            return committed


class Sweep(JobTest):
    def test_each_task_of_the_array_leaves_the_file_of_its_value(self):
        job_id = self.submit("-n2", "--array=0-2", SWEEP, "CrashSk", "iterations", "5", "10", "20",
                             "--", "--replicas", "2", "--frames", "1")
        for job in self.cluster.wait_for(job_id, JOB_LIMIT_S):
            task = int(job["ArrayTaskId"])
            name = f"{job_id}_{task}"
            self.assertEqual(job["ExitCode"], "0:0", self.log_of(f"slurm-{name}.out"))
            value = (5, 10, 20)[task]
            run = self.check_file(f"CrashSk-iterations-{value}-{name}.h5", complete=1)
            self.assertEqual(run["parameters"]["iterations"], value)
            self.assertEqual(run["parameters"]["env_SLURM_ARRAY_TASK_ID"], str(task))
        self.assertEqual(len([name for name in os.listdir(self.folder) if name.endswith(".h5")]), 3)

    def test_a_task_without_a_value_says_which_array_to_ask_for(self):
        job_id = self.submit("-n1", "--array=2", SWEEP, "CrashSk", "iterations", "5", "10")
        self.assertEqual(self.ended(job_id)["ExitCode"], "2:0")
        self.assertIn("--array=0-1", self.log_of(f"slurm-{job_id}_2.out"))


class ScalingSweep(JobTest):
    def test_an_array_of_rounds_leaves_one_report_over_all(self):
        job_id = self.submit("-n2", "--array=1-2", SCALING, "--frames", "2", "out", "CrashSk:worlds:4", "Fight:spaces")
        for job in self.cluster.wait_for(job_id, JOB_LIMIT_S):
            self.assertEqual(job["ExitCode"], "0:0", self.log_of(f"slurm-{job_id}_{job['ArrayTaskId']}.out"))
        runs = {name for name in os.listdir(self.path("out")) if name.endswith(".h5")}
        self.assertEqual(runs, {f"{point}-k{k}.h5" for k in (1, 2) for point in (
            "CrashSk-worlds-w4-r1", "CrashSk-worlds-w4-r2", "Fight-worlds-w1-r1", "Fight-spaces-w1-r1", "Fight-spaces-w1-r2")})
        run = self.check_file("out/Fight-spaces-w1-r2-k2.h5", complete=1)
        self.assertEqual((run["ranks"], run["parameters"]["env_SLURM_ARRAY_TASK_ID"]), (2, "2"))
        text = self.log_of("out/scaling.txt")
        self.assertIn("CrashSk, 4 worlds, sor double: strong scaling, worlds over ranks", text)
        self.assertIn("Fight, 1 world, sor double: strong scaling, spaces over ranks", text)
        self.assertEqual(text.count("2 of 5 repeats"), 10, "each point has the runs of both tasks, in the sentence and in the table")


class Study(JobTest):
    def test_a_study_that_was_stopped_goes_back_into_the_queue_and_on_with_what_is_left(self):
        study = ("stability", "--scene", "hard/free/cradle", "hard/free/exchange", "hard/rest/column10", "--setting", "sor", "quick",
                 "--dt", "0.002", "0.001")
        job_id = self.submit("-n2", "--export=ALL,PBMPI_REQUEUE=yes", STUDY, *study)
        output = f"stability-{job_id}.h5"
        self.wait_while_it_runs(job_id, lambda: all(os.path.exists(self.path(f"{output}.cases-{rank}")) for rank in (0, 1)), "journal")
        self.cluster.command("scancel", "--batch", "--signal=TERM", job_id)
        wait_until(lambda: self.cluster.job(job_id)[0].get("Restarts") == "1", "the job to be queued again", JOB_LIMIT_S)
        wait_until(lambda: self.cluster.job(job_id)[0]["JobState"] != "COMPLETING", "the end of its first part", JOB_LIMIT_S)
        self.cluster.command("scontrol", "update", f"JobId={job_id}", "StartTime=now+3")
        job = self.ended(job_id)
        self.assertEqual((job["JobState"], job["ExitCode"]), ("COMPLETED", "0:0"), self.log_of(f"slurm-{job_id}.out"))
        self.assertIn("12 cases of 3 scenes", self.log_of(f"slurm-{job_id}.out"))
        self.assertEqual({name for name in os.listdir(self.folder) if name.startswith("stability")},
                         {output, f"stability-{job_id}.html"})


class WithoutSlurm(unittest.TestCase):
    """The same scripts started by hand: no cluster is needed."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pbmpi-jobs-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    @staticmethod
    def environment():
        return {**os.environ, "PBMPI_MPIRUN_OPTIONS": "-n 2"}

    def run_script(self, *args):
        return subprocess.run(args, cwd=self.folder, env=self.environment(), capture_output=True, text=True, check=False,
                              timeout=JOB_LIMIT_S)

    def test_one_scene(self):
        result = self.run_script(SCRIPT, "CrashSk", "--replicas", "2", "--frames", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["CrashSk.h5", "CrashSk.html", "CrashSk.xdmf"])

    def test_a_sweep_one_value_after_the_other(self):
        result = self.run_script(SWEEP, "CrashSk", "iterations", "5", "10", "--", "--frames", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.endswith(".h5")),
                         ["CrashSk-iterations-10.h5", "CrashSk-iterations-5.h5"])

    def test_term_to_the_script_finishes_the_frame_and_exits_75(self):
        with subprocess.Popen([SCRIPT, "CrashSk", *ENDLESS], cwd=self.folder, env=self.environment(),
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as script:
            wait_until(lambda: os.path.exists(os.path.join(self.folder, "CrashSk.h5")), "the file", JOB_LIMIT_S)
            script.terminate()
            _, errors = script.communicate(timeout=JOB_LIMIT_S)
        self.assertEqual(script.returncode, 75, errors)
        with h5py.File(os.path.join(self.folder, "CrashSk.h5"), "r") as file:
            self.assertEqual(int(file.attrs["complete"]), 0)

    def test_no_scene_is_bad_usage(self):
        result = self.run_script(SCRIPT)
        self.assertEqual(result.returncode, 2)
        self.assertIn("usage:", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
