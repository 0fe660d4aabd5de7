"""One file has one writer at a time, and no output takes the place of an input, of a device or of another output."""
import hashlib
import json
import os
import pathlib
import signal
import stat
import subprocess
import threading
import unittest

import h5py
from harness import PBMPI, PBREPORT, TIMEOUT_S, ProgramTest, end_group, rank_pids, wait_until

SHORT = ["--scene", "CrashSk", "--frames", "5", "--quiet"]
LONG = ["--scene", "CrashSk", "--replicas", "4", "--frames", "1000000", "--record-every", "1000", "--quiet"]
STUDY = ["pbstudy", "accuracy", "--scene", "CrashSk", "--frames", "2", "--floor-seeds", "1", "--iterations", "5",
         "--nature-steps", "12", "--repeats", "1", "--quiet"]
SCENE = 'title = "mine"\nbase = "CrashSk"\n'


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class OneWriter(ProgramTest):
    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def long_run(self, *args):
        process = self.start(2, *LONG, *args)
        wait_until(lambda: os.path.exists(self.path("run.h5")) and rank_pids(process), "the file's skeleton")
        return process

    def end_run(self, process):
        if process.poll() is None:
            for pid in rank_pids(process).values():
                os.kill(pid, signal.SIGTERM)
            process.wait(timeout=TIMEOUT_S)

    def test_a_second_run_with_the_same_output_is_refused_with_host_and_process_of_the_first(self):
        first = self.long_run("--output", "run.h5")
        os.symlink("run.h5", self.path("link.h5"))
        for name in ("run.h5", "link.h5", f"../{os.path.basename(self.folder)}/run.h5"):
            result = self.pbmpi(2, *SHORT, "--output", name)
            self.refused(result, f"process {rank_pids(first)[0]} on host {os.uname().nodename} writes it")
        self.end_run(first)
        self.assertEqual(first.returncode, 75)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(len(file["timings/frame/wall"]), file.attrs["frames_committed"])
        self.assertEqual(self.pbmpi(1, *SHORT, "--output", "run.h5").returncode, 0, "the name is free again")

    def test_a_second_run_with_the_same_place_for_checkpoints_is_refused(self):
        first = self.long_run("--output", "run.h5", "--checkpoint", "ck.h5")
        self.refused(self.pbmpi(1, *SHORT, "--output", "other.h5", "--checkpoint", "ck.h5"), "ck.h5", "writes it")
        self.assertFalse(os.path.exists(self.path("other.h5")))
        self.end_run(first)
        self.assertEqual(first.returncode, 75)

    def test_a_killed_run_keeps_its_name_from_nobody(self):
        for killed in ("ranks", "mpirun"):
            first = self.long_run("--output", "run.h5", "--checkpoint", "ck.h5")
            pids = list(rank_pids(first).values()) if killed == "ranks" else [first.pid]
            for pid in pids:
                os.kill(pid, signal.SIGKILL)
            result = self.pbmpi(2, *SHORT, "--output", "run.h5", "--checkpoint", "ck.h5")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(sorted(os.listdir(self.folder)), ["ck.h5", "run.h5", "run.xdmf"])
            os.remove(self.path("run.h5"))

    def test_a_second_study_with_the_same_output_is_refused(self):
        study = [os.path.join(os.path.dirname(PBMPI), STUDY[0]), *STUDY[1:], "--output", "study.h5"]
        first = subprocess.Popen(["mpirun", "-n", "1", *study], cwd=self.folder, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(end_group, first)
        wait_until(lambda: os.path.exists(self.path(".study.h5.lock")), "the study's lock")
        os.kill(list(rank_pids(first).values())[0], signal.SIGSTOP)
        result = self.run_command(["mpirun", "-n", "1", *study])
        self.refused(result, "study.h5", "writes it")
        os.kill(list(rank_pids(first).values())[0], signal.SIGCONT)
        self.assertEqual(first.wait(timeout=TIMEOUT_S), 0)
        self.assertEqual(os.listdir(self.folder), ["study.h5"])

    def test_a_run_whose_file_was_removed_fails_and_spoils_no_other(self):
        first = self.long_run("--output", "run.h5")
        os.rename(self.path("run.h5"), self.path("moved.h5"))
        self.write("run.h5", "mine")
        self.end_run(first)
        self.assertEqual(first.returncode, 1)
        with open(self.path("run.h5"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")
        with h5py.File(self.path("moved.h5")) as file:
            self.assertEqual(len(file["timings/frame/wall"]), file.attrs["frames_committed"])


class NothingOverwritten(ProgramTest):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.pbmpi(1, *SHORT, "--output", "run.h5").returncode, 0)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_a_scene_or_an_options_file_is_never_the_output(self):
        scene, options = self.write("my.toml", SCENE), self.write("my.options", "frames = 2\n")
        os.link(scene, self.path("hard.toml"))
        os.symlink("my.toml", self.path("soft.toml"))
        before = digest(scene), digest(options)
        for output in ("my.toml", "./my.toml", "hard.toml", "soft.toml"):
            for option in ("--output", "--checkpoint"):
                result = self.pbmpi(1, "--scene", "my.toml", "--frames", "1", option, output)
                self.refused(result, output, "not written over")
        self.refused(self.pbmpi(1, *SHORT, "--config", "my.options", "--output", "my.options"), "not written over")
        self.refused(self.pbmpi(1, "--scene", "CrashSk", "--frames", "1", "--output", "my.options"), "no HDF5 file")
        self.assertEqual((digest(scene), digest(options)), before)

    def test_two_outputs_are_two_files(self):
        self.refused(self.pbmpi(1, *SHORT, "--output", "a.h5", "--checkpoint", "a.xdmf"), "a.xdmf", "written, too")
        self.refused(self.report("run.h5", "--html", "page", "--xdmf", "./page"), "written, too")
        self.refused(self.report("run.h5", "--html", "run.h5"), "not written over")

    def test_a_file_of_one_type_does_not_replace_one_of_another(self):
        self.assertEqual(self.pbmpi(1, *SHORT, "--output", "a.h5", "--checkpoint", "ck.h5").returncode, 0)
        self.refused(self.pbmpi(1, *SHORT, "--output", "ck.h5"), "pbmpi-checkpoint")
        self.refused(self.pbmpi(1, *SHORT, "--output", "b.h5", "--checkpoint", "run.h5"), "pbmpi-run")
        self.refused(self.report("run.h5", "--html", "a.h5"), "HDF5")

    def test_data_of_somebody_else_stay(self):
        """HDF5 files without the attribute filetype, of a type unknown here, behind a block of the user's own; no HDF5."""
        for name, block, kind in (("plain", 0, None), ("other", 0, "solver-mesh"), ("block", 1024, None)):
            with h5py.File(self.path(name), "w", userblock_size=block) as file:
                file["measured"] = range(1000)
                if kind:
                    file.attrs["filetype"] = kind
        self.write("text", "notes of my own")
        pbstudy = ["mpirun", "-n", "1", os.path.join(os.path.dirname(PBMPI), STUDY[0])]
        self.assertEqual(self.pbmpi(1, *SHORT, "--seed", 2, "--output", "b.h5").returncode, 0)
        for name in ("plain", "other", "block", "text"):
            before = digest(self.path(name))
            writers = [lambda: self.pbmpi(1, *SHORT, "--output", name),
                       lambda: self.pbmpi(2, *SHORT, "--output", name),
                       lambda: self.pbmpi(1, *SHORT, "--output", "new.h5", "--checkpoint", name),
                       lambda: self.run_command([*pbstudy, *STUDY[1:], "--output", name]),
                       lambda: self.run_command([*pbstudy, "calibrate", "--output", name])]
            if name != "text":  # a text may replace a text
                writers += [lambda: self.report("run.h5", "--html", name), lambda: self.report("run.h5", "--xdmf", name),
                            lambda: self.report("csv", "run.h5", "--output", name)]
            for number, write in enumerate(writers):
                with self.subTest(name=name, writer=number):
                    self.refused(write(), name, "HDF5 file", "; ")
                    self.assertEqual(digest(self.path(name)), before)
        left = set(os.listdir(self.folder)) - {"run.h5", "run.xdmf", "b.h5", "b.xdmf"}
        self.assertEqual(left, {"plain", "other", "block", "text"}, "nothing else is left")

    def test_sidecars_of_different_files_do_not_meet(self):
        for name in ("s.xdmf", "run.hdf5"):
            result = self.pbmpi(1, *SHORT, "--output", name)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertTrue(h5py.is_hdf5(self.path(name)))
            with open(self.path(name + ".xdmf"), encoding="utf-8") as file:
                self.assertIn(f"{name}:/", file.read())
        sidecar = digest(self.path("run.xdmf"))
        result = self.pbmpi(1, *SHORT, "--output", "run")
        self.assertEqual(result.returncode, 0)
        self.assertIn("no sidecar", result.stderr)
        self.assertEqual(digest(self.path("run.xdmf")), sidecar)

    def test_the_sidecar_can_be_left_out_and_costs_nothing_else_where_it_cannot_be_written(self):
        self.assertEqual(self.pbmpi(1, *SHORT, "--output", "none.h5", "--no-xdmf").returncode, 0)
        self.assertFalse(os.path.exists(self.path("none.xdmf")))
        os.mkdir(self.path("dir.xdmf"))
        self.write("text.xdmf", "notes of my own")
        for name in ("dir", "text"):
            result = self.pbmpi(1, *SHORT, "--output", f"{name}.h5", "--report", "json")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("warning: no sidecar", result.stderr)
            self.assertTrue(json.loads(result.stdout)["complete"])
        with open(self.path("text.xdmf"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "notes of my own")

    def test_devices_pipes_and_standard_output_are_written_to_and_stay(self):
        for option in ("--html", "--xdmf"):
            result = self.report("run.h5", option, "/dev/stdout", "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout[:200].lower(), "<!doctype html|<\\?xml")
            with open(self.path("redirected"), "w", encoding="utf-8") as file:
                subprocess.run([PBREPORT, "run.h5", option, "/dev/stdout"], cwd=self.folder, stdout=file, check=True)
            written = pathlib.Path(self.path("redirected")).read_text("utf-8")
            self.assertRegex(written[:200].lower(), "<!doctype html|<\\?xml")
            self.assertIn("scene: CrashSk", written[1000:], "the summary stands behind it")
            os.mkfifo(self.path("pipe"))
            read = []
            reader = threading.Thread(target=lambda: read.append(pathlib.Path(self.path("pipe")).read_text("utf-8")))
            reader.start()
            self.assertEqual(self.report("run.h5", option, "pipe", "--quiet").returncode, 0)
            reader.join()
            self.assertEqual(read[0][:200], result.stdout[:200])
            self.assertEqual(read[0][-20:], result.stdout[-20:])
            self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode))
            os.remove(self.path("pipe"))
        self.assertTrue(os.path.islink("/dev/stdout"))

    def test_a_pipe_that_nobody_reads_and_what_is_no_plain_file_keep_nobody_waiting(self):
        os.mkfifo(self.path("pipe"))
        for words in (["run.h5", "--html", "pipe"], ["run.h5", "--xdmf", "pipe"], ["csv", "run.h5", "--output", "pipe"]):
            self.refused(self.report(*words), "pipe", "nobody reads")
        self.refused(self.pbmpi(2, *SHORT, "--output", "pipe"), "not a regular file")
        self.refused(self.pbmpi(2, *SHORT, "--output", "a.h5", "--checkpoint", "pipe"), "not a regular file")
        os.mkfifo(self.path("a.xdmf"))
        result = self.pbmpi(1, *SHORT, "--output", "a.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("warning: no sidecar", result.stderr)

    def test_a_lock_file_that_is_no_plain_file_is_refused(self):
        pbstudy = ["mpirun", "-n", "1", os.path.join(os.path.dirname(PBMPI), STUDY[0])]
        commands = {".new.h5.lock": lambda: self.pbmpi(2, *SHORT, "--output", "new.h5"),
                    ".ck.h5.lock": lambda: self.pbmpi(1, *SHORT, "--output", "new.h5", "--checkpoint", "ck.h5"),
                    ".study.h5.lock": lambda: self.run_command([*pbstudy, *STUDY[1:], "--output", "study.h5"]),
                    ".run.h5.lock": lambda: self.report("repair", "run.h5"),
                    ".new.xdmf.lock": lambda: self.report("run.h5", "--xdmf", "new.xdmf")}
        for make in (os.mkfifo, os.mkdir, lambda path: os.symlink("pipe", path), lambda path: os.symlink("/dev/null", path),
                     lambda path: os.symlink("nothing", path)):
            for lock, command in commands.items():
                make(self.path(lock))
                self.refused(command(), f"{lock}, which locks it, is not a regular file")
                (os.rmdir if os.path.isdir(self.path(lock)) else os.remove)(self.path(lock))
            if not os.path.exists(self.path("pipe")):
                os.mkfifo(self.path("pipe"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["pipe", "run.h5", "run.xdmf"])

    @unittest.skipUnless(os.geteuid() == 0, "making a device needs root")
    def test_a_device_is_not_replaced_by_a_file(self):
        os.mknod(self.path("null"), 0o666 | stat.S_IFCHR, os.makedev(1, 3))
        os.mknod(self.path("disk"), 0o666 | stat.S_IFBLK, os.makedev(7, 250))
        for option in ("--html", "--xdmf"):
            self.assertEqual(self.report("run.h5", option, "null").returncode, 0)
            self.refused(self.report("run.h5", option, "disk"), "device")
        self.assertTrue(stat.S_ISCHR(os.stat(self.path("null")).st_mode))
        for name in ("null", "disk"):
            self.refused(self.pbmpi(1, *SHORT, "--output", name), "not a regular file")

    def test_links_stay_links_also_those_that_point_to_nothing(self):
        os.symlink("far.html", self.path("near.html"))
        os.symlink("far.h5", self.path("near.h5"))
        os.symlink("round", self.path("round"))
        for _ in range(2):
            self.assertEqual(self.report("run.h5", "--html", "near.html", "--quiet").returncode, 0)
            self.assertEqual(self.pbmpi(1, *SHORT, "--output", "near.h5").returncode, 0)
            for name in ("near.html", "near.h5"):
                self.assertTrue(os.path.islink(self.path(name)))
            self.assertTrue(os.path.isfile(self.path("far.html")) and h5py.is_hdf5(self.path("far.h5")))
        self.refused(self.report("run.h5", "--html", "round"), "round")

    def test_what_is_replaced_keeps_its_rights_and_nothing_else_is_left(self):
        self.write("page.html", "older")
        for name in ("page.html", "run.h5"):
            os.chmod(self.path(name), 0o640)
        self.assertEqual(self.report("run.h5", "--html", "page.html", "--quiet").returncode, 0)
        self.assertEqual(self.pbmpi(1, *SHORT, "--output", "run.h5").returncode, 0)
        for name in ("page.html", "run.h5"):
            self.assertEqual(stat.S_IMODE(os.stat(self.path(name)).st_mode), 0o640)
        self.assertEqual(sorted(os.listdir(self.folder)), ["page.html", "run.h5", "run.xdmf"])


if __name__ == "__main__":
    unittest.main()
