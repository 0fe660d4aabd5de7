"""What is installed can be moved, found and built against: test_install.py BUILD_FOLDER EXAMPLE_FOLDER COMPILER."""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "app"))
import harness  # noqa: E402

BUILD, EXAMPLE, COMPILER = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1)
PAGE = os.path.join(harness.SOURCE, "docs", "python.md")


class InstallTest(harness.ProgramTest):
    def command(self, *command, **environment):
        result = self.run_command(command, env={**os.environ, **environment})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def setUp(self):
        super().setUp()
        for component in ("library", "dev"):
            self.command("cmake", "--install", BUILD, "--prefix", self.path("first"), "--component", component)
        self.prefix = shutil.move(self.path("first"), self.path("moved"))
        [self.libraries] = {folder for folder, _, files in os.walk(self.prefix) if "libpbmpi.so" in files}

    def expect_the_hash_of_pbmpi(self, output):
        run = self.command(harness.PBMPI, "--scene", "CrashSk", "--replicas", "3", "--precision", "single", "--no-output",
                           "--report", "json")
        found = json.loads(run)["state_hash"]
        self.assertIn(f"\nhash: {found}\n", output)
        self.assertIn(f"\nhash after load: {found}\n", output)
        self.assertIn("\nsteps: 27 3 27\n", output)

    def test_a_project_finds_it_with_cmake(self):
        self.command("cmake", "-S", EXAMPLE, "-B", self.path("build"), f"-DCMAKE_PREFIX_PATH={self.prefix}",
                     f"-DCMAKE_CXX_COMPILER={COMPILER}")
        self.command("cmake", "--build", self.path("build"))
        self.expect_the_hash_of_pbmpi(self.command(self.path("build/example")))

    def build_by_hand(self, source):
        """Runs it, too; returns what it prints."""
        flags = self.command("pkg-config", "--cflags", "--libs", "pbmpi", PKG_CONFIG_PATH=self.libraries + "/pkgconfig").split()
        self.command(COMPILER, "-std=c++20", source, "-o", self.path("program"), *flags)
        return self.command(self.path("program"), LD_LIBRARY_PATH=self.libraries)

    def test_a_project_finds_it_with_pkg_config(self):
        self.expect_the_hash_of_pbmpi(self.build_by_hand(os.path.join(EXAMPLE, "main.cpp")))

    def test_the_program_of_the_page_does_what_the_page_says(self):
        with open(PAGE, encoding="utf-8") as page:
            [program] = re.findall(r"```cpp\n(.*?)```", page.read(), re.DOTALL)
        output = self.build_by_hand(self.write("page.cpp", program))
        run = json.loads(self.command(harness.PBMPI, "--scene", "CrashSk", "--replicas", "16", "--precision", "single", "--dt",
                                      "0.005", "--warmup", "0", "--frames", "1", "--steps-per-frame", "100", "--no-output",
                                      "--quiet", "--report", "json"))
        self.assertRegex(output, r"^car.chassis of world 0: x = \d+\.\d{3} m\nhash " + run["state_hash"] + "\\n$")

    def test_what_is_installed_names_no_place_of_the_build(self):
        texts = subprocess.run(["grep", "-rlE", f"{BUILD}|{self.path('first')}", "--include=*.cmake", "--include=*.pc",
                                "--include=*.h", self.prefix], capture_output=True, text=True, check=False)
        self.assertEqual(texts.stdout, "")
        dynamic = self.command("readelf", "--dynamic", os.path.join(self.libraries, "libpbmpi.so"))
        self.assertNotIn("PATH)", dynamic)


if __name__ == "__main__":
    unittest.main()
