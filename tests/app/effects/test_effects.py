"""Effects that a user demands or leaves out: what is printed, recorded and refused."""
import json
import os
import re
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import PBREPORT, SCENES, SOURCE, ProgramTest  # noqa: E402

PLAN = ("--scene", "CrashSk", "--frames", 2)
BALLS = 6
FALLING = 'title = "balls that are thrown down ever faster, every second one in a space of its own"\nspaces = ["even", "odd"]\n' + "".join(f"""
[[actor]]
name = "ball{i}"
type = "sphere"
radius = 0.1
density = 1000
position = [{i}, 0, 2]
velocity = [0, 0, {-2.0 * i}]
space = "{"even" if i % 2 == 0 else "odd"}"
""" for i in range(BALLS))


def passes(description):
    """What --describe prints of the plan: the count of each pass, or None where its reason begins with none."""
    plan = description.split("step plan:\n")[1].split("decomposition:")[0]
    lines = re.findall(r"^  (\w+) +\w+ +[^:]+: (\d+ )?", plan, re.MULTILINE)
    return {name: int(count) if count else None for name, count in lines}


def names(summary):
    return [effect["name"] for effect in summary["effects"]]


class Effects(ProgramTest):
    descriptions = {}

    def described(self, scene):
        """What --describe prints of a scene that pbmpi brings."""
        if scene not in self.descriptions:
            self.descriptions[scene] = self.pbmpi(1, "--scene", scene, "--describe").stdout
        return self.descriptions[scene]

    def test_the_file_says_how_many_bodies_were_fast_enough_to_look_ahead_for(self):
        self.write("falling.toml", FALLING)
        run = ("--scene", "falling.toml", "--dt", 0.01, "--steps-per-frame", 1, "--frames", 200, "--warmup", 0)
        for stepper, ranks, cut in (("sor", 1, "worlds"), ("sor", 2, "spaces"), ("quick", 1, "worlds"), ("direct", 1, "worlds")):
            with self.subTest(stepper=stepper, ranks=ranks, cut=cut):
                self.summary(ranks, *run, "--stepper", stepper, "--decompose", cut, "-o", f"{stepper}{ranks}.h5")
                with h5py.File(self.path(f"{stepper}{ranks}.h5")) as file:
                    speed = np.linalg.norm(file["particles/bodies/velocity/value"][:], axis=2)
                    counted = file["observables/world/fast_bodies"][:, 0]
                at_start = np.vstack([2.0 * np.arange(BALLS), speed[:-1]])  # of each frame's one step
                self.assertEqual(list(counted), list((at_start * 0.01 > 0.1).sum(axis=1)))
                self.assertEqual((counted.min(), counted.max() > 2), (0, True), "all are slow at first, several fast later")

    def test_demanding_an_unneeded_effect_is_recorded_and_changes_no_bit(self):
        for stepper in ("quick", "sor"):
            run = (*PLAN, "--stepper", stepper)
            plain = self.summary(1, *run, "--no-output")
            forced = self.summary(2, *run, "--effects", "+restitution,+steering", "-o", "forced.h5")
            self.assertNotIn("restitution", names(plain))
            self.assertIn("restitution", names(forced))
            self.assertEqual(plain["effects_chosen"], "")
            self.assertEqual(forced["effects_chosen"], "+restitution,+steering")
            self.assertEqual(plain["state_hash"], forced["state_hash"])
            with h5py.File(self.path("forced.h5")) as file:
                self.assertEqual(file["parameters/effects"][()].decode(), "+restitution,+steering")
            report = self.run_command([PBREPORT, "forced.h5", "--json"])
            self.assertEqual(report.returncode, 0, report.stderr)
            self.assertEqual(json.loads(report.stdout)["effects"], forced["effects"])

    def test_demanding_every_unneeded_effect_changes_no_bit_of_a_world_cut_into_spaces(self):
        for scene, among in (("Fight", ("breakable_joints", "field_of_interest", "suspension")),
                             ("CrashWa", ("field_of_interest", "steering"))):
            run = ("--scene", scene, "--frames", 3, "--stepper", "sor", "--decompose", "spaces", "--no-output")
            plain = self.summary(2, *run)
            # Nothing but the demand calls for sleeping: it is no idle pass, but what rests would sleep.
            unneeded = [name for name in self.registry() if name not in names(plain) and name != "sleeping"]
            self.assertLessEqual(set(among), set(unneeded), scene)
            forced = self.summary(2, *run, "--effects", ",".join("+" + name for name in unneeded))
            self.assertEqual([name for name in unneeded if name not in names(forced)], [], scene)
            self.assertEqual(plain["state_hash"], forced["state_hash"], scene)

    def registry(self):
        """The names of all effects, as the refusal of a word near to none of them gives them."""
        refusal = self.pbmpi(1, "--scene", "CrashSk", "--effects", "+zzzzzzzz").stderr
        return re.findall(r"'(\w+)'", refusal.split("known: ")[1])

    def test_leaving_fast_bodies_out_of_a_scene_that_calls_for_it_changes_the_result(self):
        for stepper in ("quick", "sor"):
            run = ("--scene", "CrashWa", "--stepper", stepper, "--no-output")
            plain = self.summary(1, *run)
            self.assertIn("fast_bodies", names(plain))
            self.assertNotEqual(plain["state_hash"],
                                self.summary(1, *run, "--effects", "-fast_bodies")["state_hash"])

    def test_leaving_gravity_out_leaves_it_out_of_the_plan_the_motion_and_the_text(self):
        plain = self.summary(1, *PLAN, "--no-output")
        floating = self.summary(1, *PLAN, "--no-output", "--effects", "-gravity")
        self.assertIn("gravity", names(plain))
        self.assertNotIn("gravity", names(floating))
        self.assertNotEqual(plain["state_hash"], floating["state_hash"])
        text = self.pbmpi(1, *PLAN, "--no-output", "--effects", "-gravity").stdout
        self.assertIn("effects_chosen: -gravity\n", text)

    def test_describe_gives_a_reason_for_each_pass(self):
        text = self.pbmpi(1, "--scene", "CrashWa", "--describe", "--effects", "+steering").stdout
        for words in ("195 geoms with mu > 0", "99 launches", "3 collision spaces", "effects chosen: +steering",
                      "demanded; nothing calls for it"):
            self.assertIn(words, text)

    def test_the_plans_in_the_documents_are_what_describe_says(self):
        with open(os.path.join(SOURCE, "docs", "tables", "pages", "plans.md"), encoding="utf-8") as file:
            rows = [[cell.strip() for cell in line.strip().strip("|").split("|")]
                    for line in file.read().split("<!-- figures: plans -->")[1].split("<!-- end figures -->")[0].splitlines()
                    if line.startswith("|") and not line.startswith("| ---")]
        self.assertGreaterEqual(len(rows), 12)
        for column, scene in enumerate(rows[0][1:], 1):
            told = {row[0].split("`")[1]: row[column] for row in rows[1:] if row[column]}
            counts = passes(self.described(scene))
            self.assertEqual({name: str(count or "yes") for name, count in counts.items()}, told, scene)
        self.assertEqual([row[0] for row in rows if not any(row[1:])], [], "every effect has a scene that calls for it")

    def test_the_nine_plans_are_nine_and_each_pass_of_each_has_something_to_do(self):
        plans = {}
        for scene in SCENES:
            counts = passes(self.described(scene))
            self.assertGreaterEqual(len(counts), 8, counts)
            self.assertEqual([name for name, count in counts.items() if not count], [], scene)
            plans.setdefault(tuple(counts.items()), []).append(scene)
        self.assertEqual(len(plans), len(SCENES), sorted(plans.values()))

    def test_a_plan_counts_what_is_in_all_worlds_also_where_they_differ(self):
        scene = os.path.join(SOURCE, "tests", "scenes", "Unequal.toml")  # 4 worlds of 48 boxes, 12 of one
        text = self.pbmpi(1, "--scene", scene, "--describe").stdout
        for reason in ("220 geoms, in 16 worlds\n", "204 bodies under 9.81 m/s^2, in 16 worlds\n"):
            self.assertIn(reason, text)
        told = [tuple(line.split(": ", 1)[1] for line in text.splitlines() if re.match(r"  \w+ +\w+ ", line))]
        ran = self.summary(2, "--scene", scene, "--frames", 1, "-o", "unequal.h5")
        told.append(tuple(effect["reason"] for effect in ran["effects"]))
        report = self.json(self.report("unequal.h5", "--json"))
        told.append(tuple(effect["reason"] for effect in report["effects"]))
        self.assertEqual(len(set(told)), 1, told)

    def test_leaving_cross_space_out_makes_one_space(self):
        text = self.pbmpi(1, "--scene", "CrashWa", "--describe", "--effects", "-cross_space").stdout
        self.assertNotIn("\n  cross_space ", text)
        self.assertIn("spaces: 1\n", text)

    def test_a_scene_file_chooses_and_the_command_line_goes_before_it(self):
        self.write("mine.toml", 'title = "t"\nbase = "CrashSk"\n[effects]\nfriction = false\nsteering = true\n')
        run = ("--scene", "mine.toml", "--frames", 1, "--no-output")
        chosen = self.summary(1, *run)
        self.assertNotIn("friction", names(chosen))
        self.assertIn("steering", names(chosen))
        self.assertIn("friction", names(self.summary(1, *run, "--effects", "+friction")))

    def test_what_cannot_be_is_refused_with_2_and_nothing_is_written(self):
        for effects, words in (("+fricton", "did you mean 'friction'?"), ("friction", "write +name"),
                               ("+friction,-friction", "twice"), ("-joints", "34 joints hold the bodies"),
                               ("+friction,-collision", "which it needs")):
            result = self.pbmpi(2, *PLAN, "--effects", effects)
            self.assertEqual(result.returncode, 2, effects)
            lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertIn(words, lines[0])
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
