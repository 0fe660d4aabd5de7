"""pbstudy effects and the report of its file, end to end."""
import csv
import os
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, TIMEOUT_S, ProgramTest  # noqa: E402

FAST = ["--frames", 2, "--repeats", 2, "--floor-seeds", 2]
NOT_MEASURED = b"refused"


class Effects(ProgramTest):
    def study(self, ranks, *args, **options):
        command = ["mpirun", "-n", str(ranks), os.path.join(BIN, "pbstudy"), "effects", *map(str, args)]
        return self.run_command(command, **options)

    def made(self, ranks, name, *args):
        result = self.study(ranks, *args, "--output", name, "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        with h5py.File(self.path(name)) as file:
            self.assertEqual((file.attrs["filetype"], file.attrs["study"]), (b"pbmpi-study", b"effects"))
            return {key: column[:] for key, column in file["cases"].items()}

    def test_the_table_is_the_same_for_one_and_two_ranks_but_for_times(self):
        args = ["--scene", "2-Cars", "CrashSk", *FAST]
        one, two = self.made(1, "one.h5", *args), self.made(2, "two.h5", *args)
        self.assertEqual(set(one), set(two))
        for name, column in one.items():
            if not name.startswith("time_"):
                self.assertEqual(column.tobytes(), two[name].tobytes(), name)
        measured = one["kind"] != NOT_MEASURED
        self.assertTrue((one["time_with"][measured] > 0).all())
        self.assertTrue(np.isnan(one["time_with"][~measured]).all())
        self.assertTrue((one["drift_body_position_bands"].sum(axis=1)[measured & (one["scene"] == b"CrashSk")] == 37).all())

    def test_progress_counts_the_cases_of_all_ranks(self):
        command = ["mpirun", "-n", "2", os.path.join(BIN, "pbstudy"), "effects", "--scene", "CrashSk", "--stepper", "sor", *map(str, FAST),
                   "--progress", "always", "--quiet", "--output", "study.h5"]
        shown = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=TIMEOUT_S, check=True).stderr
        with h5py.File(self.path("study.h5")) as file:
            cases = len(file["cases/scene"])
        self.assertRegex(shown.strip().splitlines()[-1], rf"^pbstudy: .*; {cases} of {cases} cases done, \d+ s, about 0 s left *$")

    def test_unneeded_effects_change_no_bit_and_what_is_left_out_is_what_pbmpi_leaves_out(self):
        table = self.made(2, "study.h5", "--scene", "CrashSk", *FAST)
        rows = range(len(table["scene"]))
        unneeded = [i for i in rows if table["kind"][i] == b"demanded"]
        self.assertGreaterEqual(len(unneeded), 4, "events, steering, cross_space, restitution")
        for i in unneeded:
            self.assertEqual(table["same_bits"][i], 1, table["effect"][i])
            self.assertEqual(table["defect_body_position_max"][i], 0)
        for stepper in ("quick", "sor"):
            for effect, sign in ((b"friction", "-"), (b"restitution", "+")):
                [i] = [i for i in rows if table["effect"][i] == effect and table["stepper"][i].decode() == stepper]
                run = self.summary(1, "--scene", "CrashSk", "--stepper", stepper, "--frames", 2, "--no-output",
                                   "--effects", sign + effect.decode())
                self.assertEqual(table["hash_variant"][i].decode(), run["state_hash"], (stepper, effect))
        [joints] = [i for i in rows if table["effect"][i] == b"joints" and table["stepper"][i] == b"quick"]
        self.assertEqual((table["kind"][joints], table["same_bits"][joints]), (NOT_MEASURED, -1))
        self.assertIn(b"34 joints hold the bodies", table["reason"][joints])
        floor = table["kind"] == b"floor"
        self.assertTrue((table["drift_body_position_rms"][floor] > 0).all(), "another seed is seen in a crash")

    def test_the_report_shows_shares_and_errors_of_the_file(self):
        table = self.made(1, "study.h5", "--scene", "CrashSk", "--stepper", "sor", *FAST)
        result = self.report("study.h5", "--html", "page.html", "--csv", "table.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        for words in ("CrashSk, sor double, 14 x 1, 1 world", "Noise floor",
                      "left out: 39 geoms with mu > 0", "demanded: nothing calls for it; no bit changes",
                      "34 joints hold the bodies"):
            self.assertIn(words, result.stdout)
        self.assertNotIn("AND YET", result.stdout)
        [scene] = self.json(self.report("effects", "study.h5", "--json"))["scenes"]
        friction = next(row for row in scene["effects"] if row["effect"] == "friction")
        i = list(table["effect"]).index(b"friction")
        self.assertEqual(friction["share"]["median"], table["time_share"][i])
        self.assertEqual(friction["defect"]["body_position_m"]["rms"], table["defect_body_position_rms"][i])
        with open(self.path("table.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["effect"].encode() for row in rows], list(table["effect"]))
        self.assertEqual([row["reason"].encode() for row in rows], list(table["reason"]))

    @unittest.skipUnless(shutil.which("chromium"), "the page is looked at in Chromium, which is not installed")
    def test_the_page_draws_its_charts_in_a_browser(self):
        self.made(1, "study.h5", "--scene", "CrashSk", "2-Cars", "--stepper", "sor", *FAST)
        result = self.report("study.h5", "--quiet", "--html", "page.html")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.drawn("page.html")
        self.assertEqual(page.count("<canvas"), 3, "share, error, demanded")
        self.assertIn('<th class="" scope="col">CrashSk</th><th class="" scope="col">2-Cars</th>', page)
        self.assertIn('<td class="">friction</td>', page)
        self.assertNotIn("src=\"http", page)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith(("pbstudy: ", "pbreport: "))]
        self.assertEqual((result.stdout, len(lines)), ("", 1), result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_bad_input_is_refused_by_one_rank_before_any_work(self):
        before = set(os.listdir(self.folder))
        self.refused(self.study(2, "--scene", "CrashSq"), "CrashSq", "CrashSk")
        self.refused(self.study(2, "--effect", "fricton"), "fricton", "did you mean 'friction'?")
        self.refused(self.study(2, "--scene", "CrashSk", "--repeats", "0"), "--repeats")
        self.refused(self.study(2, "--scene", "CrashSk", "--output", "no/folder/x.h5"), "no/folder/x.h5")
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_reports_refuse_what_they_cannot_show(self):
        self.made(1, "study.h5", "--scene", "2-Cars", "--stepper", "sor", "--effect", "friction", *FAST)
        self.refused(self.report("study.h5", "--scene", "Fight"), "Fight", "2-Cars")
        self.refused(self.report("study", "study.h5"), "study of effects", "pbreport effects")
        self.refused(self.report("effects", "absent.h5"), "absent.h5")

    def test_help_names_every_option(self):
        result = self.study(1, "--help", "all")
        self.assertEqual(result.returncode, 0)
        for option in ("--scene", "--effect", "--stepper", "--repeats", "--floor-seeds"):
            self.assertIn(option, result.stdout)


if __name__ == "__main__":
    unittest.main()
