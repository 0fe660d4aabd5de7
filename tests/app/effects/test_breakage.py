"""The effect "breakable_joints": the same bits everywhere, what the file and the summary say, what is refused."""
import os
import re
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402
from small_scenes import SIGN  # noqa: E402

RUN = ("--scene", "sign.toml", "--frames", 40)


class Breakage(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("sign.toml", SIGN)

    def hash_of(self, ranks, *args):
        return self.summary(ranks, *RUN, "--no-output", *args)["state_hash"]

    def events(self, name):
        with h5py.File(self.path(name)) as file:
            count = file["events"].attrs["num_events"]
            return list(zip(file["events/frame"][:count].tolist(), file["events/kind"].asstr()[:count],
                            file["events/detail"].asstr()[:count]))

    def broken(self, name):
        return [event for event in self.events(name) if event[1] == "joint_broken"]

    def test_worlds_have_one_hash_and_the_same_events_for_1_to_4_ranks(self):
        for stepper in ("quick", "sor"):
            hashes, told = set(), set()
            for ranks in (1, 2, 3, 4):
                run = self.summary(ranks, *RUN, "--stepper", stepper, "--replicas", 5, "-o", "run.h5")
                hashes.add(run["state_hash"])
                told.add(str(self.broken("run.h5")))
                self.assertEqual(run["joints_broken"], len(self.broken("run.h5")))
            self.assertEqual((len(hashes), len(told)), (1, 1), stepper)
            worlds = {event[2].split(":")[0] for event in self.broken("run.h5")}
            self.assertEqual(len(worlds), 5, "the ball tears a sign down in every world")

    def test_one_world_is_the_same_whole_and_cut(self):
        for precision in ("double", "single"):
            sor = (*RUN, "--stepper", "sor", "--precision", precision)
            whole = self.summary(1, *sor, "--decompose", "worlds", "-o", "whole.h5")
            self.assertGreater(whole["joints_broken"], 0)
            for ranks in (1, 2, 3, 4):
                cut = self.summary(ranks, *sor, "--decompose", "spaces", "-o", "cut.h5")
                self.assertEqual(cut["state_hash"], whole["state_hash"], ranks)
                self.assertEqual(self.broken("cut.h5"), self.broken("whole.h5"))
                with h5py.File(self.path("cut.h5")) as a, h5py.File(self.path("whole.h5")) as b:
                    for column in ("islands", "rows", "max_island_rows", "joint_gap"):
                        name = "observables/world/" + column
                        self.assertEqual(a[name][:].tolist(), b[name][:].tolist(), column)

    def test_an_estimate_leaks_nothing_and_every_instruction_set_has_the_bits(self):
        for stepper in ("quick", "sor"):
            plain = self.hash_of(1, "--stepper", stepper, "--replicas", 2)
            self.assertEqual(self.hash_of(2, "--stepper", stepper, "--replicas", 2, "--feec"), plain, stepper)
        short = (*RUN[:2], "--stepper", "sor", "--steps-per-frame", 1, "--frames", 120, "--no-output")
        plain = self.summary(1, *short)
        self.assertGreater(plain["joints_broken"], 0)
        self.assertEqual(self.summary(1, *short, "--feec")["state_hash"], plain["state_hash"])
        hashes = set()
        for simd in ("auto", "off", "sse2", "avx2", "avx512"):
            result = self.pbmpi(1, *RUN, "--no-output", "--stepper", "sor", "--simd", simd, "--report", "json")
            if result.returncode == 2 and "lacks the instruction set" in result.stderr:
                continue  # not this machine's
            hashes.add(self.json(result)["state_hash"])
        self.assertEqual(len(hashes), 1)

    def test_file_and_summary_tell_what_broke_and_when(self):
        for stepper in ("quick", "direct", "sor"):
            text = self.pbmpi(1, *RUN, "--stepper", stepper, "-o", "run.h5").stdout
            broken = self.broken("run.h5")
            self.assertGreater(len(broken), 0, stepper)
            self.assertIn(f"joints_broken: {len(broken)}\n", text)
            for frame, _, detail in broken:
                step = int(detail.rsplit(" ", 1)[1])
                self.assertEqual(step // 3, frame)
                self.assertGreater(step, 20, "after the shot")
            self.assertNotIn("right link", str(broken), "it bears any load")
            reported = self.json(self.report("run.h5", "--json"))
            self.assertEqual(reported["joints_broken"], len(broken))

    def test_a_comparison_of_runs_tells_what_broke_in_one_of_them_only(self):
        self.write("strong.toml", SIGN.replace("break_force = 700", "break_force = 1e9"))
        for name in ("sign", "strong"):
            self.summary(1, "--scene", f"{name}.toml", "--frames", 40, "-o", f"{name}.h5")
        sign, strong = ([re.fullmatch(r"(.*) broke in step (\d+)", event[2]).groups() for event in self.broken(name)]
                        for name in ("sign.h5", "strong.h5"))
        found = self.json(self.report("diff", "sign.h5", "strong.h5", "--json"))["joints_broken"]
        for key, one, other in (("in_run_only", sign, strong), ("in_reference_only", strong, sign)):
            expected = [{"joint": joint, "step": int(step)} for joint, step in one if joint not in dict(other)]
            self.assertEqual(found[key], expected, key)
        self.assertIn("world 0: 'left link'", [one["joint"] for one in found["in_run_only"]], "it holds in the other")
        self.assertEqual(found["in_both"], len(set(dict(sign)) & set(dict(strong))))
        text = self.report("diff", "sign.h5", "strong.h5").stdout
        self.assertIn("joints_broken: in the run only: world 0: 'left link' in step ", text)
        self.assertNotIn(" only: ", self.report("diff", "sign.h5", "sign.h5").stdout)

    def test_a_field_of_interest_lets_go_of_what_broke_off(self):
        self.write("near.toml", SIGN + '[interest]\nfollows = "right"\nradius = 0.5\n')
        run = ("--scene", "near.toml", "--frames", 40, "--stepper")
        for stepper in ("quick", "sor"):
            self.summary(1, *run, stepper, "-o", "near.h5")
            self.assertIn("left link", str(self.broken("near.h5")))
            with h5py.File(self.path("near.h5")) as file:
                inside = file["observables/interest/bodies_inside"][:, 0]
            # The links join the sign's three bodies; what the left one held lies on the ground by then.
            self.assertEqual((inside[0], inside[-1]), (3, 2), stepper)
        hashes = {self.summary(ranks, *run, "sor", "--no-output", "--decompose", cut)["state_hash"]
                  for ranks, cut in ((1, "worlds"), (1, "spaces"), (2, "spaces"), (3, "spaces"))}
        self.assertEqual(len(hashes), 1)

    def test_nothing_breaks_or_is_told_where_the_effect_is_left_out_or_not_called_for(self):
        text = self.pbmpi(1, *RUN, "--effects", "-breakable_joints", "-o", "held.h5").stdout
        self.assertNotIn("joints_broken", text)
        self.assertEqual(self.broken("held.h5"), [])
        self.assertNotEqual(self.hash_of(1), self.hash_of(1, "--effects", "-breakable_joints"))
        run = ("--scene", "Fight", "--frames", 3, "--stepper", "sor", "--no-output", "--decompose")
        self.assertEqual(self.summary(2, *run, "spaces", "--effects", "+breakable_joints")["state_hash"],
                         self.summary(1, *run, "worlds")["state_hash"])

    def test_describe_says_how_many_joints_can_break(self):
        self.assertIn("3 joints with a strength", self.pbmpi(1, *RUN, "--describe").stdout)
        self.assertIn("4 joints with a strength", self.pbmpi(1, "--scene", "CrashWa", "--describe").stdout)
        self.assertNotIn("breakable", self.pbmpi(1, "--scene", "Environ", "--describe").stdout)

    def test_a_negative_strength_is_refused_at_its_place(self):
        for old, new, word in (("break_force = 800", "break_force = -800", "break_force"),
                               ("break_force = 700", "break_torque = -1", "break_torque"),
                               ("break_force = 700", "break_froce = 1", "break_force")):
            text = SIGN.replace(old, new)
            self.write("bad.toml", text)
            line = text[:text.index(new)].count("\n") + 1
            result = self.pbmpi(2, "--scene", "bad.toml")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(f"bad.toml:{line}:", result.stderr)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main()
