"""Files of runs and studies as arrays and tables, beside what h5py and pbreport read in them."""
import csv
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
import pbmpi
from pbmpi._parts import FREE, FREE_BEGINNINGS

from support import SOURCE, PackageTest

from harness import BIN, PBMPI, PBREPORT, rank_pids, wait_until

BODIES = "particles/bodies"


class Files(PackageTest):
    def run_pbmpi(self, *args):
        result = self.run_command([PBMPI, "--quiet", *map(str, args)])
        self.assertEqual(result.returncode, 0, result.stderr)

    def read(self, *names):
        run = pbmpi.read([self.path(name) for name in names] if len(names) > 1 else self.path(names[0]))
        self.addCleanup(run.close)
        return run


class Whole(Files):
    def test_arrays_and_tables_are_what_the_file_holds(self):
        self.run_pbmpi("--scene", "CrashSk", "--replicas", 3, "--frames", 9, "--record-every", 2, "--output", "run.h5")
        run = self.read("run.h5")
        with h5py.File(self.path("run.h5")) as file:
            for name in ("position", "orientation", "velocity", "angular_velocity"):
                rows = getattr(run, name)
                self.assertTrue(np.array_equal(rows, file[f"{BODIES}/{name}/value"][:]), name)
                self.assertEqual(rows.units, file[f"{BODIES}/{name}/value"].attrs.get("unit", b"").decode())
            self.assertTrue(np.array_equal(run.time, file[f"{BODIES}/position/time"][:]))
            self.assertEqual(run.frames.wall.tolist(), file["timings/frame/wall"][:].tolist())
            self.assertTrue(np.array_equal(run.worlds.energy.to_numpy().reshape(12, 3), file["observables/world/energy"][:]))
            momentum = file["observables/world/linear_momentum"][:]
            self.assertEqual(run.worlds.linear_momentum_y.loc[5, 2], momentum[5, 2, 1])
            self.assertTrue(np.array_equal(run.ranks.collide, file["timings/rank/collide"][:, 0]))
            self.assertEqual(run.bodies.name.tolist(), file[f"{BODIES}/name"].asstr()[:].tolist())
            self.assertTrue(np.array_equal(run.bodies[[f"inertia_{a}{b}" for a in "xyz" for b in "xyz"]], file[f"{BODIES}/inertia"][:].reshape(-1, 9)))
            self.assertEqual(run.attributes["state_hash"], file.attrs["state_hash"].decode())
            self.assertEqual(run.parameters["scene_text"], file["parameters/scene_text"].asstr()[()].strip())
        self.assertEqual((run.num_frames, run.first_frame, run.position.shape), (12, 0, (6, 111, 3)))
        self.assertEqual(run.frames.index.tolist(), list(range(12)))
        self.assertEqual(run.frames.measured.tolist(), [0] * 3 + [1] * 9)
        self.assertEqual(run.body("car.chassis", 1), 37)
        with self.assertRaisesRegex(KeyError, "name the world"):
            run.body("car.chassis")
        self.assertRegex(repr(run), "'CrashSk' 12 frames, complete")
        self.assertEqual(len(run.events), 0)

    def test_units_are_those_of_the_file(self):
        self.run_pbmpi("--scene", "CrashSk", "--frames", 1, "--output", "run.h5")
        run = self.read("run.h5")
        self.assertEqual(run.worlds.attrs["units"]["linear_momentum_x"], "kg m s-1")
        self.assertEqual((run.frames.attrs["units"]["wall"], run.bodies.attrs["units"]["mass"]), ("s", "kg"))
        self.assertEqual((run.joints.attrs["units"]["anchor_a_x"], run.geoms.attrs["units"]["shape"]), ("m", ""))
        self.assertEqual(run.table("worlds").gravity_z.tolist(), [-9.81])

    def test_pbreport_tells_the_same(self):
        self.run_pbmpi("--scene", "CrashSk", "--replicas", 2, "--frames", 2, "--record", "contacts", "--output", "run.h5")
        text = self.run_command([PBREPORT, "csv", self.path("run.h5"), "--table", "observables"]).stdout
        lines = list(csv.reader(io.StringIO(text)))
        column = next(place for place, name in enumerate(lines[0]) if name.split()[0] == "energy")
        self.assertEqual([float(line[column]) for line in lines[1:]], self.read("run.h5").worlds.energy.tolist())

    def test_rows_that_only_some_runs_have(self):
        self.run_pbmpi("--scene", "CrashSk", "--frames", 2, "--stepper", "quick", "--record", "islands", "--output", "run.h5")
        run = self.read("run.h5")
        self.assertEqual(run.array("timings/island/rows").shape, (5, 37))
        self.assertEqual(run.table("timings/island").index.names, ["frame", "body"])
        for missing in (run.array, run.table):
            with self.assertRaises(KeyError):
                missing("observables/residual/joint_speed" if missing == run.array else "observables/residual")
        with self.assertRaisesRegex(KeyError, "no row a frame"):
            run.array("geoms/size")


class Joined(unittest.TestCase):
    def test_the_parameters_that_change_no_result_are_those_of_pbreport_join(self):
        text = (SOURCE / "src/app/reports/runs.py").read_text(encoding="utf-8")
        [names] = re.findall(r"^FREE = \((.*?)\)", text, re.DOTALL | re.MULTILINE)
        self.assertEqual(FREE, set(re.findall(r'"(\w+)"', names)))
        [beginnings] = re.findall(r"name in FREE or name\.startswith\((.*?)\)", text)
        self.assertEqual(set(FREE_BEGINNINGS), set(re.findall(r'"(\w+)"', beginnings)))


class Killed(Files):
    def test_committed_frames_of_a_killed_run_are_there_and_no_more(self):
        process = self.start(1, "--scene", "CrashSk", "--frames", 1000000, "--record-every", 50, "--output", "run.h5")

        def committed():
            try:
                with h5py.File(self.path("run.h5")) as file:
                    return int(file.attrs["frames_committed"])
            except OSError:
                return 0
        wait_until(lambda: committed() > 0, "the first frames")
        for pid in rank_pids(process).values():
            os.kill(pid, signal.SIGKILL)
        process.wait()
        run, frames = self.read("run.h5"), committed()
        self.assertLess(frames, 1000003, "it was killed before its end")
        self.assertEqual((run.num_frames, len(run.frames), len(run.position)), (frames, frames, frames // 50))
        self.assertEqual(run.attributes["complete"], 0)
        self.assertEqual(run.frames.step.tolist(), [3 * (frame + 1) for frame in range(frames)])
        self.assertTrue(np.isfinite(run.position[-1]).all())
        self.assertGreater(float(run.worlds.energy.iloc[-1]), 0)
        self.assertIn("not complete", repr(run))


class Resumed(Files):
    """All tests look at the same files: one run of 15 frames, and the same in three parts."""

    @classmethod
    def setUpClass(cls):
        cls.files = tempfile.mkdtemp(prefix="pbmpi-test-")
        cls.addClassCleanup(shutil.rmtree, cls.files)
        scene = ["--scene", "CrashSk", "--replicas", "2"]
        for args in ([*scene, "--frames", "12", "--output", "whole.h5"],
                     [*scene, "--frames", "3", "--checkpoint", "run.ck.h5", "--output", "run.h5"],
                     ["--resume", "run.ck.h5", "--frames", "10", "--output", "longer.h5"],
                     ["--resume", "run.ck.h5", "--frames", "7", "--checkpoint", "run.ck.h5", "--output", "second.h5"],
                     ["--resume", "run.ck.h5", "--frames", "12", "--output", "third.h5"],
                     [*scene, "--frames", "3", "--output", "seed.h5", "--seed", "2"],
                     ["--scene", "CrashSk", "--frames", "3", "--output", "one.h5"]):
            subprocess.run([PBMPI, "--quiet", *args], cwd=cls.files, check=True)

    def setUp(self):
        super().setUp()
        self.folder = self.files

    def test_the_files_of_a_resumed_run_are_one_run(self):
        self.compare(self.read("third.h5", "run.h5", "second.h5"))

    def test_frames_that_two_files_have_are_taken_once(self):
        joined = self.read("run.h5", "longer.h5", "third.h5")
        self.assertEqual(joined.num_frames, 15)
        self.compare(joined)

    def compare(self, joined):
        whole = self.read("whole.h5")
        result = self.run_command([PBREPORT, "join", *sorted(joined.paths), "--output", self.path("joined.h5"), "--quiet"])
        self.assertEqual(result.returncode, 0, result.stderr)
        by_pbreport = self.read("joined.h5")
        for run in (whole, by_pbreport):
            for name in ("position", "velocity", "orientation", "angular_velocity", "time"):
                self.assertTrue(np.array_equal(getattr(joined, name), getattr(run, name)), name)
            self.assertTrue(joined.worlds.equals(run.worlds))
            self.assertEqual(joined.frames.step.tolist(), run.frames.step.tolist())
            self.assertEqual(joined.frames.index.tolist(), run.frames.index.tolist())
            for name in ("state_hash", "complete", "frames_committed"):
                self.assertEqual(joined.attributes[name], run.attributes[name], name)
        self.assertTrue(joined.events.equals(by_pbreport.events))
        self.assertGreater(len(joined.events), 0)
        self.assertTrue(joined.frames.wall.equals(by_pbreport.frames.wall))

    def test_files_that_are_not_of_one_run(self):
        def check(words, *names):
            with self.assertRaisesRegex(ValueError, words):
                self.read(*names)
        check("frames 6 to 9 are missing before .*third.h5; name the file", "run.h5", "third.h5")
        check("run.h5: it is named twice", "run.h5", "second.h5", "run.h5")
        check("seed is 2 in .*seed.h5 and 1 in|seed is 1 in .* and 2 in .*seed.h5", "seed.h5", "second.h5")
        check("replicas|worlds", "one.h5", "second.h5")
        shutil.copy(self.path("second.h5"), self.path("changed.h5"))
        with h5py.File(self.path("changed.h5"), "r+") as file:
            file["observables/world/energy"][0, 1] += 1e-9
        check("observables/world/energy of frames 6 to 9 is not the same in both", "whole.h5", "changed.h5")


class Refused(Files):
    def test_what_is_no_file_of_pbmpi(self):
        def check(error, words, path, **options):
            with self.assertRaisesRegex(error, words):
                pbmpi.read(path, **options)
        check(FileNotFoundError, "absent.h5: no such file", self.path("absent.h5"))
        check(ValueError, "text.h5: it is no HDF5 file", self.write("text.h5", "not HDF5"))
        with h5py.File(self.path("other.h5"), "w") as file:
            file["x"] = 1
        check(ValueError, "other.h5: it is no file of pbmpi or pbstudy", self.path("other.h5"))
        self.run_pbmpi("--scene", "CrashSk", "--frames", 1, "--checkpoint", "run.ck.h5", "--output", "run.h5")
        check(ValueError, "it is a checkpoint, for `pbmpi --resume", self.path("run.ck.h5"))
        check(ValueError, "it is a run; table= is for other files", self.path("run.h5"), table="frames")
        check(ValueError, "no file is named", [])
        shutil.copy(self.path("run.h5"), self.path("new.h5"))
        with h5py.File(self.path("new.h5"), "r+") as file:
            file.attrs["version"] = np.array([2, 0])
        check(ValueError, "layout has version 2.x, and this pbmpi reads 1.x", self.path("new.h5"))

    def test_what_files_need_is_named_where_it_is_not_there(self):
        self.write("h5py.py", "raise ImportError('none here')\n")
        code = "import pbmpi; pbmpi.Batch('CrashSk', 1)\ntry: pbmpi.read('run.h5')\nexcept ImportError as error: print(error)"
        path = self.folder + os.pathsep + os.environ["PYTHONPATH"]
        result = self.run_command([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": path})
        self.assertIn("needs h5py, which is not there; install it (Debian: python3-h5py)", result.stdout, result.stderr)


class Tables(Files):
    def test_the_cases_of_a_study_and_the_frames_of_a_comparison(self):
        study = os.path.join(BIN, "pbstudy")
        result = self.run_command([study, "effects", "--scene", "CrashSk", "--frames", "1", "--repeats", "1", "--output", "effects.h5", "--quiet"])
        self.assertEqual(result.returncode, 0, result.stderr)
        cases = pbmpi.read(self.path("effects.h5"))
        with h5py.File(self.path("effects.h5")) as file:
            self.assertEqual(cases.effect.tolist(), file["cases/effect"].asstr()[:].tolist())
            self.assertEqual(cases.hash_variant.tolist(), file["cases/hash_variant"].asstr()[:].tolist())
            np.testing.assert_array_equal(cases.time_cost, file["cases/time_cost"][:])
        self.assertEqual((cases.attrs["units"]["time_cost"], cases.attrs["filetype"]), ("s", "pbmpi-study"))
        self.assertEqual(cases.attrs["attributes"]["study"], "effects")
        with self.assertRaisesRegex(ValueError, "no table 'frames'; it has cases"):
            pbmpi.read(self.path("effects.h5"), table="frames")
        self.run_pbmpi("--scene", "CrashSk", "--frames", 2, "--output", "run.h5")
        with self.assertRaisesRegex(ValueError, "effects.h5: it is a pbmpi-study; only files of one run"):
            pbmpi.read([self.path("run.h5"), self.path("effects.h5")])


if __name__ == "__main__":
    unittest.main()
