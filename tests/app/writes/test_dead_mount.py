"""A mount whose server does not answer: every program says so within seconds and ends with exit code 2, though what it asked may stay blocked."""
import contextlib
import ctypes
import os
import subprocess
import sys
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import AT_ONCE, BIN, PBMPI, PBREPORT, TIMEOUT_S, ProgramTest, alone  # noqa: E402

SHORT = [PBMPI, "--scene", "CrashSk", "--frames", "2", "--quiet"]
STUDY = [os.path.join(BIN, "pbstudy"), "stability", "--scene", "hard/free/cradle", "--setting", "sor", "--quiet"]


@unittest.skipUnless(os.geteuid() == 0 and os.access("/dev/fuse", os.W_OK), "mounting needs root and FUSE")
class DeadMount(ProgramTest):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.run_command([*SHORT, "--output", "run.h5"], env=self.without_mpirun()).returncode, 0)
        self.mount("dead")

    def without_mpirun(self):
        return {**alone(self.folder), **AT_ONCE}

    def mount(self, name):
        """A file system of this process, which takes each request and answers none: who asks is blocked, for SIGKILL, too, until the end."""
        os.mkdir(self.path(name))
        server = os.open("/dev/fuse", os.O_RDWR)
        options = f"fd={server},rootmode=40000,user_id=0,group_id=0"
        mounted = ctypes.CDLL(None).mount(b"dead", self.path(name).encode(), b"fuse", 0, options.encode())
        if mounted != 0:
            os.close(server)
            self.skipTest("FUSE cannot be mounted here")

        def serve():
            with contextlib.suppress(OSError):
                while True:
                    os.read(server, 1 << 17)

        threading.Thread(target=serve, daemon=True).start()
        # Lazily: a child that asks keeps it busy. The end of the server's descriptor lets all of them go.
        self.addCleanup(os.close, server)
        self.addCleanup(subprocess.run, ["umount", "-l", self.path(name)], check=True)

    def test_all_programs_name_the_path_and_end(self):
        os.symlink("dead/link.h5", self.path("link.h5"))
        mpirun = ["mpirun", "-n", "2"]
        report = [PBREPORT, "run.h5", "--quiet"]
        commands = {"--output dead/a.h5": [*mpirun, *SHORT, "--output", "dead/a.h5"],
                    "--output link.h5": [*SHORT, "--output", "link.h5"],
                    "--checkpoint dead/c.h5": [*mpirun, *SHORT, "--checkpoint", "dead/c.h5"],
                    "--resume dead/c.h5": [PBMPI, "--resume", "dead/c.h5"],
                    "--scene dead/s.toml": [PBMPI, "--scene", "dead/s.toml"],
                    "--config dead/c.cfg": [*SHORT, "--config", "dead/c.cfg"],
                    "--output dead/s.h5": [*mpirun, *STUDY, "--output", "dead/s.h5"],
                    "the path dead/r.xdmf": [*report, "--xdmf", "dead/r.xdmf"],
                    "the path dead/r.html": [*report, "--html", "dead/r.html"],
                    "the path dead/p.html": [*report, "--html=dead/p.html"],
                    "the path dead/r.csv": [PBREPORT, "csv", "run.h5", "--output=dead/r.csv"]}
        running = {path: subprocess.Popen(command, cwd=self.folder, env=self.without_mpirun() if command[0] != "mpirun" else
                                          {**os.environ, **AT_ONCE}, stderr=subprocess.PIPE, text=True)
                   for path, command in commands.items()}
        for path, process in running.items():
            with self.subTest(path=path):
                errors = process.communicate(timeout=TIMEOUT_S)[1]
                self.assertEqual(process.returncode, 2, errors)
                self.assertEqual(errors.count(f"{path}: its file system has not answered for 10 s"), 1, errors)


if __name__ == "__main__":
    unittest.main()
