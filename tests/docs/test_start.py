"""docs/start.md is run as it stands, section by section, each in an empty folder, and prints what it says.

`test_start.py --fill` writes what it prints into the page. Sections that need the Python module are left out where it is not built.
"""
import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(SOURCE / "tests" / folder) for folder in ("python", "app")]

import tutorial  # noqa: E402
from harness import BIN  # noqa: E402

PAGE = SOURCE / "docs/start.md"
FILL = "--fill" in sys.argv
SECTION = re.compile(r"^(?=## )", re.MULTILINE)
HAS_MODULE = importlib.util.find_spec("pbmpi") is not None


class Start(unittest.TestCase):
    def setUp(self):
        before = os.environ.copy()
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(before)))
        self.addCleanup(os.chdir, os.getcwd())
        os.environ["PATH"] = os.pathsep.join((str(BIN), os.environ["PATH"]))
        os.environ["PBMPI_BIN"] = str(BIN)

    def test_every_section_does_what_it_says(self):
        sections = SECTION.split(PAGE.read_text(encoding="utf-8"))
        written = []
        for section in sections:
            needs_module = "import pbmpi\n" in section
            if needs_module and not HAS_MODULE:
                written.append(section)
                continue
            with tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                os.symlink(SOURCE / "jobs", "jobs")
                outputs = []
                for line, told, printed in tutorial.run(section, str(PAGE)):
                    outputs.append(printed)
                    if not FILL:
                        self.assertEqual(printed, told, f"{section.splitlines()[0]}, line {line}; if that is right, run {__file__} --fill")
                self.made(section)
                written.append(tutorial.filled(section, outputs))
        if FILL:
            PAGE.write_text("".join(written), encoding="utf-8")

    def made(self, section):
        """The pages, plots and files that the section's commands name are there."""
        code = "".join(code for _, code, _ in tutorial.blocks_of(section))
        for name in re.findall(r"(?:--html|--output|--csv) ([\w.]+)|savefig\(\"([\w.]+)\"", code):
            self.assertGreater(os.path.getsize("".join(name)), 100, name)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--fill"])
