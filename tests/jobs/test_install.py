"""What `cmake --install` leaves of the programs: complete, and without a trace of the folder in which they were built."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["PBMPI_BIN"]).parent


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(tempfile.mkdtemp(prefix="pbmpi-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.root, ignore_errors=True)
        cls.prefix = cls.root / "usr"
        subprocess.run(["cmake", "--build", BUILD, "--target", "package_texts"], check=True, capture_output=True, timeout=300)
        subprocess.run(["cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", "programs", "--strip"], check=True,
                       capture_output=True, timeout=300)

    def run_installed(self, *command):
        """With the installed programs first on PATH, in a folder of its own."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.root))
        result = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, check=False,
                                env={**os.environ, "PATH": f"{self.prefix}/bin:{os.environ['PATH']}", "PBMPI_BIN": ""})
        self.assertEqual(result.returncode, 0, result.stderr)
        return folder, result.stdout

    def files(self):
        return [path for path in self.prefix.rglob("*") if path.is_file() and not path.is_symlink()]

    def test_programs_pages_completions_and_documents_are_there(self):
        share = self.prefix / "share"
        for program in ("pbmpi", "pbstudy", "pbreport"):
            for path in (self.prefix / "bin" / program, share / "man/man1" / f"{program}.1.gz",
                         share / "bash-completion/completions" / program, share / "fish/vendor_completions.d" / f"{program}.fish"):
                self.assertTrue(path.is_file(), path)
        self.assertTrue((share / "zsh/vendor-completions/_pbmpi").is_file())
        suffixes = (".md", ".svg", ".webp", ".csv")
        pages, installed = ({path.relative_to(folder) for path in folder.rglob("*") if path.suffix in suffixes}
                            for folder in (SOURCE / "docs", share / "doc/pbmpi/docs"))
        self.assertEqual(installed, pages)

    def test_no_file_names_the_checkout_or_the_build(self):
        for path in self.files():
            self.assertFalse(str(SOURCE).encode() + b"/" in path.read_bytes(), path)

    def test_programs_need_nothing_of_the_checkout(self):
        folder, text = self.run_installed("pbmpi", "--scene", "CrashSk", "--frames", "1")
        self.assertIn("state_hash", text)
        shutil.copy(folder / "CrashSk.h5", self.root)
        folder, _ = self.run_installed("pbreport", str(self.root / "CrashSk.h5"), "--html", "page.html")
        self.assertGreater((folder / "page.html").stat().st_size, 500_000)  # three.js and Chart.js are in it

    def test_job_scripts_find_the_programs_on_the_path(self):
        folder, _ = self.run_installed(f"{self.prefix}/share/pbmpi/jobs/sweep.sbatch", "CrashSk", "substeps", "2", "--",
                                       "--frames", "1", "--warmup", "0")
        self.assertTrue((folder / "CrashSk-substeps-2.html").is_file())

    @unittest.skipUnless((BUILD / "lib/pbvalue/pbvalue-amd64-linux").exists(), "this build has no pbvalue")
    def test_valgrind_runs_the_installed_tool_and_a_study_says_when_valgrind_is_missing(self):
        self.run_installed("env", f"VALGRIND_LIB={self.prefix}/lib/pbvalue", "valgrind", "--quiet", "--tool=pbvalue",
                           "--pbvalue-out-file=report", "--scope=all", "true")
        link = self.prefix / "lib/pbvalue/default.supp"
        target = os.readlink(link)
        link.unlink()
        link.symlink_to("/nowhere/default.supp")
        self.addCleanup(lambda: (link.unlink(), link.symlink_to(target)))
        result = subprocess.run([sys.executable, SOURCE / "jobs/paper/predict.py", "--scene", "CrashSk"], cwd=self.root, timeout=60,
                                capture_output=True, text=True, check=False, env={**os.environ, "PBMPI_BIN": f"{self.prefix}/bin"})
        self.assertEqual(result.returncode, 2)
        self.assertIn("Valgrind is not installed", result.stderr)


if __name__ == "__main__":
    unittest.main()
