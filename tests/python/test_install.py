"""The installed package finds its library, also where the whole prefix has been moved to."""
import os
import shutil
import subprocess
import sys
import unittest

from support import PackageTest

BUILD = os.environ["PBMPI_BUILD"]


class Install(PackageTest):
    def test_it_is_imported_from_a_prefix_that_was_moved(self):
        for component in ("library", "python"):
            result = self.run_command(["cmake", "--install", BUILD, "--prefix", self.path("first"), "--component", component])
            self.assertEqual(result.returncode, 0, result.stderr)
        shutil.move(self.path("first"), self.path("second"))
        (package,) = [folder for folder, _, files in os.walk(self.path("second")) if "py.typed" in files]
        self.assertEqual(sorted(os.listdir(package)), sorted(name for name in os.listdir(f"{BUILD}/python/pbmpi") if name != "__pycache__"))
        self.assertFalse(any(os.path.islink(os.path.join(package, name)) for name in os.listdir(package)))
        code = "import pbmpi; b = pbmpi.Batch('CrashSk', 2); b.step(3); print(pbmpi.__file__, b.hash())"
        environment = {**os.environ, "PYTHONPATH": os.path.dirname(package)}
        result = self.run_command([sys.executable, "-c", code], env=environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        path, digits = result.stdout.split()
        self.assertEqual(path, os.path.join(package, "__init__.py"))
        import pbmpi
        batch = pbmpi.Batch("CrashSk", 2)
        batch.step(3)
        self.assertEqual(digits, batch.hash())
        extension = next(name for name in os.listdir(package) if name.endswith(".so"))
        linked = subprocess.run(["ldd", os.path.join(package, extension)], capture_output=True, text=True, check=True).stdout
        self.assertRegex(linked, rf"libpbmpi\.so\S* => {self.path('second')}/")


if __name__ == "__main__":
    unittest.main()
