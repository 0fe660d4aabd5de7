"""What is installed between two builds of one checkout is taken in by the second: jobs/quickstart.sh, then tests/run.sh."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Configure(unittest.TestCase):
    def setUp(self):
        self.build = tempfile.mkdtemp(prefix="pbmpi-test-")
        self.addCleanup(shutil.rmtree, self.build, ignore_errors=True)

    def configured(self, *options):
        """The rules of the build, made by the options that jobs/quickstart.sh gives and `options`."""
        subprocess.run(["cmake", "-S", SOURCE, "-B", self.build, "-G", "Ninja", "-DPBMPI_BUILD_TESTS=OFF",
                        "-DPBMPI_BUILD_BENCHMARKS=OFF", *options], check=True, capture_output=True, timeout=120)
        with open(os.path.join(self.build, "build.ninja"), encoding="utf-8") as file:
            return file.read()

    @unittest.skipUnless(os.path.exists("/usr/include/valgrind/callgrind.h"), "no header of Valgrind")
    def test_valgrinds_header_is_noticed_when_it_comes_after_the_first_build(self):
        # Without the folder CMake sees what it sees before the package is installed.
        self.assertIn("PBMPI_HAS_CALLGRIND=0", self.configured("-DCMAKE_IGNORE_PATH=/usr/include"))
        self.assertIn("PBMPI_HAS_CALLGRIND=1", self.configured("-DCMAKE_IGNORE_PATH="))

    def test_a_quick_build_has_one_instruction_set_and_the_next_one_all(self):
        def packs(*options):
            return set(re.findall(r"solver_pack\.dir/pack_(\w+)\.cpp\.o:", self.configured(*options)))

        self.assertEqual(len(packs("-DPBMPI_SIMD=native")), 1)
        self.assertIn("baseline", packs("-DPBMPI_SIMD=all"))

    def test_the_environment_puts_a_build_on_the_paths_in_bash_and_zsh(self):
        for shell in filter(shutil.which, ("bash", "zsh")):
            script = f". '{SOURCE}/jobs/environment.sh' && echo \"$PATH $PYTHONPATH $OMPI_MCA_rmaps_base_oversubscribe\""
            said = subprocess.run([shell, "-c", script], check=True, capture_output=True, text=True, cwd=self.build).stdout
            self.assertTrue(said.startswith(f"{SOURCE}/build/release/bin:"), said)
            self.assertIn(f" {SOURCE}/build/release/python", said)
            self.assertTrue(said.endswith(" 1\n"), said)

    def test_ode_in_single_precision_is_optional_and_missed_by_name(self):
        result = subprocess.run(["cmake", "-S", SOURCE, "-B", self.build, "-G", "Ninja", "-DPBMPI_BUILD_TESTS=OFF",
                                 "-DPBMPI_BUILD_BENCHMARKS=OFF", f"-DPBMPI_ODE_SINGLE={self.build}/none"],
                                check=True, capture_output=True, text=True, timeout=120)
        self.assertRegex(result.stdout, r"pbmpi_ode_single .* is left out: .*\n?.*jobs/ode_single.sh")
        with open(os.path.join(self.build, "build.ninja"), encoding="utf-8") as file:
            self.assertNotIn("bin/pbmpi_ode_single", file.read())


if __name__ == "__main__":
    unittest.main()
