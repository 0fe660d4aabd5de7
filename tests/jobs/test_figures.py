"""The scripts that make the paper's figures, in their short form, and the classes of instructions."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
JOBS = os.path.join(SOURCE, "jobs")
sys.path[:0] = [JOBS, os.path.join(SOURCE, "tests", "app")]

import figure3  # noqa: E402
from harness import PATH  # noqa: E402


def sections(page):
    """What the page shows: charts, tables and pictures, by section."""
    return json.loads(re.search(r'id="sections-data">(.*?)</script>', page, re.DOTALL)[1])


class Figures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pbmpi-test-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def run_script(self, *args):
        return subprocess.run([os.path.join(JOBS, args[0]), *args[1:]], cwd=self.folder, capture_output=True, text=True,
                              timeout=280, check=False, env={**os.environ, "PATH": PATH})

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    @unittest.skipUnless(shutil.which("chromium"), "no chromium for the stills")
    def test_figure6_makes_one_page_beside_the_papers(self):
        result = self.run_script("figure6.sh", "--quick-look", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.read("out/figure6.html")
        self.assertNotIn("src=\"http", page, "it loads nothing")
        shown = sections(page)
        tables = {table["title"]: table for section in shown for table in section["tables"]}
        cores = tables["Cores"]
        self.assertEqual([row[0] for row in cores["rows"]], ["CrashSk", "Fight"])
        self.assertEqual(tables["Islands"]["rows"][0][:3], ["CrashSk", "ours", "3"], "CrashSk: 3 islands before the crash")
        crash = dict(zip(cores["header"], cores["rows"][0]))
        self.assertEqual(crash["paper"], "3")
        self.assertGreater(float(crash["islands parallel [Hz]"]), float(crash["serial [Hz]"]), "one core an island leaves less to do")
        self.assertEqual([picture["name"] for picture in shown[-1]["pictures"]], ["CrashSk", "Fight"])
        self.assertTrue(all(picture["png"].startswith("iVBOR") for picture in shown[-1]["pictures"]))
        bars = [bar["data"][0] for bar in shown[0]["charts"][0]["config"]["data"]["datasets"]]
        self.assertEqual([bar["x"] for bar in bars], ["CrashSk"] * 3)
        for bar, rate in zip(bars, (crash["serial [Hz]"], crash["islands parallel [Hz]"], crash["and spaces [Hz]"])):
            self.assertAlmostEqual(bar["y"], float(rate), delta=0.051, msg="the table is rounded")

    @unittest.skipUnless(shutil.which("valgrind") and shutil.which("objdump"), "no valgrind or objdump")
    def test_figure3_counts_both_steppers(self):
        result = self.run_script("figure3.sh", "--quick-look", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        scenes = json.loads(self.read("out/figure3.json"))["scenes"]
        quick, direct = scenes["2-Cars"]["quick"], scenes["2-Cars"]["direct"]
        self.assertEqual(quick["frames"], 5, "warm-up frames are left out")
        self.assertGreater(direct["instructions_per_frame"], quick["instructions_per_frame"], "the paper's finding")
        self.assertGreater(scenes["CrashSk"]["quick"]["instructions_per_frame"], quick["instructions_per_frame"],
                           "37 bodies against 10")
        for numbers in (quick, direct):
            self.assertAlmostEqual(sum(numbers["mix"].values()), 1, places=9)
            self.assertTrue(0 < numbers["collision_share"] < 0.5)
        page = self.read("out/figure3.html")
        self.assertIn("not counted", page, "2-Cars has no island large enough to extrapolate direct of CrashSk from")
        self.assertIn(f"CrashSk  quick  {scenes['CrashSk']['quick']['instructions_per_frame'] / 1e6:10.2f} M a frame", result.stdout)

    def test_effects_have_a_page_a_text_and_a_table(self):
        result = self.run_script("effects.sh", "--quick-look", "out", "--stepper", "sor", "--effect", "friction",
                                 "restitution", "--frames", "1", "--floor-seeds", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, self.read("out/effects.txt") + "\n" + self.read("out/effects.md"))
        for scene in ("2-Cars", "CrashSk"):
            self.assertIn(f"{scene}, sor double", result.stdout)
        self.assertIn("| `sor double` | 2-Cars | CrashSk |\n", self.read("out/effects.md"))
        self.assertIn("What effects cost", self.read("out/effects.html"))
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "out"))),
                         ["effects.h5", "effects.html", "effects.md", "effects.txt"])

    def test_unknown_options_are_refused(self):
        for script in ("effects.sh", "figure3.sh", "figure6.sh"):
            result = self.run_script(script, "--fast")
            self.assertEqual(result.returncode, 2)
            self.assertIn("--fast", result.stderr)


class Classes(unittest.TestCase):
    def test_an_instruction_counts_as_operation_load_and_store(self):
        for text, expected in {
            "mov 0x8(%rax),%rbx": ["load"],
            "mov %rbx,0x8(%rax)": ["store"],
            "mov %rbx,%rax": ["integer"],
            "movsd 0x8(%rax,%rcx,8),%xmm1": ["load"],
            "movsd %xmm1,(%rax)": ["store"],
            "mulsd %xmm1,%xmm2": ["floating point"],
            "mulsd 0x8(%rax),%xmm2": ["floating point", "load"],
            "add $0x1,0x8(%rax)": ["integer", "load", "store"],
            "cmp $0x1,0x8(%rax)": ["integer", "load"],
            "cmp 0x8(%rax),%rbx": ["integer", "load"],
            "jne 1234": ["branch"],
            "call *0x8(%rax)": ["branch", "load"],
            "ret ": ["branch"],
            "lea 0x8(%rax,%rbx,4),%rcx": ["integer"],
            "push %rbp": ["store"],
            "pop %rbp": ["load"],
            "fldt 0x10(%rsp)": ["load"],
            "fstpt 0x10(%rsp)": ["store"],
            "ucomisd 0x8(%rax),%xmm0": ["floating point", "load"],
            "comisd %xmm0,%xmm1": ["floating point"],
        }.items():
            mnemonic, _, operands = text.partition(" ")
            self.assertEqual(figure3.classify(mnemonic, operands), expected, text)


if __name__ == "__main__":
    unittest.main()
