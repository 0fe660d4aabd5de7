"""docs/python.md is run as it stands, and prints what it says.

`test_tutorial.py --fill` writes what it prints into the page.
"""
import os
import sys
import unittest

import tutorial
from support import PackageTest, SOURCE

from harness import BIN

PAGE = SOURCE / "docs" / "python.md"


class Tutorial(PackageTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("bin"))
        os.symlink(sys.executable, self.path("bin/python3"))
        before = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", before)
        os.environ["PATH"] = os.pathsep.join((self.path("bin"), BIN, before))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def test_the_page_does_what_it_says(self):
        page = PAGE.read_text(encoding="utf-8")
        outputs = []
        for line, told, printed in tutorial.run(page, str(PAGE)):
            outputs.append(printed)
            if not FILL:
                self.assertEqual(printed, told, f"docs/python.md:{line}; if that is right, run {__file__} --fill")
        self.assertGreater(len(outputs), 8)
        self.assertGreater(os.path.getsize("error.png"), 1000)
        if FILL:
            PAGE.write_text(tutorial.filled(page, outputs), encoding="utf-8")


FILL = "--fill" in sys.argv
if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--fill"])
