"""Every refusal: one clear message from one rank, exit code 2, no file left, no hang."""
import os
import unittest

from harness import ProgramTest

GOOD_SCENE = """\
title = "a box"
[[actor]]
type = "ground"
name = "ground"
[[actor]]
type = "box"
name = "box"
position = [0, 0, 1]
size = [1, 1, 1]
mass = 10
"""


class BadInput(ProgramTest):
    def refused(self, ranks, args, *words, code=2):
        """Runs, and checks exit code, that one line of stderr says all `words`, and that no file appeared."""
        before = set(os.listdir(self.folder))
        result = self.pbmpi(ranks, *args)
        self.assertEqual(result.returncode, code, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
        self.assertEqual(len(lines), 1, f"one message from one rank, got: {result.stderr}")
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual(result.stdout, "")
        self.assertEqual(set(os.listdir(self.folder)), before, "nothing may be left behind")

    def scene(self, text):
        return ["--scene", self.write("scene.toml", text)]

    def test_unknown_scene_names_the_nearest(self):
        self.refused(3, ["--scene", "100CrSq"], "100CrSq", "100CrSk")

    def test_a_seed_below_zero_or_an_empty_name_is_no_default(self):
        self.refused(2, ["--scene", "CrashSk", "--seed", "-1"], "--seed", "-1", "number")
        self.refused(2, ["--scene", "CrashSk", "--seed", "1e3"], "--seed", "number")
        self.refused(2, ["--scene", "CrashSk", "-o", ""], "--output", "empty")

    def test_an_integer_that_no_double_equals_is_a_number(self):
        huge = str(2**53 + 1)
        self.refused(2, self.scene(GOOD_SCENE.replace("mass = 10", f"mass = -{huge}")), "scene.toml:10:", "mass", "above 0")
        self.assertEqual(self.pbmpi(1, *self.scene(GOOD_SCENE.replace("mass = 10", f"mass = {huge}")), "--describe").returncode, 0)

    def test_missing_scene(self):
        self.refused(2, [], "--scene", "--list-scenes")

    def test_missing_scene_file(self):
        self.refused(2, ["--scene", "absent.toml"], "absent.toml")

    def test_malformed_toml_has_line_and_column(self):
        self.refused(3, self.scene('title = "x"\n[[actor]\n'), "scene.toml:2:")

    def test_unknown_key_has_line_and_the_nearest_key(self):
        self.refused(2, self.scene(GOOD_SCENE + "densty = 600\n"), "scene.toml:11:", "densty", "density")

    def test_nan_mass(self):
        self.refused(2, self.scene(GOOD_SCENE.replace("mass = 10", "mass = nan")), "scene.toml:10:", "mass")

    def test_joint_between_a_body_and_itself(self):
        joint = '[[joint]]\nkind = "ball"\nname = "loop"\nbodies = ["box", "box"]\nanchor = [0, 0, 1]\n'
        self.refused(2, self.scene(GOOD_SCENE + joint), "scene.toml:1", "loop", "itself")

    def test_overlapping_actors(self):
        self.refused(2, self.scene(GOOD_SCENE.replace("[0, 0, 1]", "[0, 0, 0.4]")), "scene.toml:", "overlaps", "10 cm")

    def test_unknown_space(self):
        self.refused(2, self.scene(GOOD_SCENE + 'space = "yard"\n'), "scene.toml:11:", "yard")

    def test_wall_of_zero_blocks(self):
        wall = '[[actor]]\nname = "wall"\ntype = "wall"\nposition = [9, 0, 0]\nlength = 2\nheight = 0\nblock = [1, 0.5, 0.5]\n'
        self.refused(2, self.scene(GOOD_SCENE + wall), "scene.toml:16:", "height")

    def test_projectile_before_step_0(self):
        tank = '[[actor]]\nname = "tank"\ntype = "tank"\nposition = [20, 0, 0]\n'
        ball = ('[[actor]]\nname = "ball"\ntype = "projectile"\nshape = "sphere"\nradius = 0.1\ndensity = 4000\n'
                'position = [0, 9, 0]\nfired_by = "tank"\nmuzzle_speed = 40\nfirst_shot = -0.1\n')
        self.refused(2, self.scene(GOOD_SCENE + tank + ball), "scene.toml:24:", "first_shot")

    def test_joint_limit_with_low_above_high(self):
        joint = ('[[joint]]\nkind = "hinge"\nname = "hinge"\nbodies = ["box", "world"]\nanchor = [0, 0, 1]\n'
                 'axis = [0, 0, 1]\nlimits = [30, -30]\n')
        self.refused(2, self.scene(GOOD_SCENE + joint), "scene.toml:17:", "low limit", "high")

    def test_negative_dt(self):
        self.refused(2, ["--scene", "CrashSk", "--dt", "-0.01"], "--dt", "above 0")

    def test_nan_dt(self):
        self.refused(2, ["--scene", "CrashSk", "--dt", "nan"], "--dt", "finite")

    def test_zero_frames(self):
        self.refused(2, ["--scene", "CrashSk", "--frames", "0"], "--frames", "at least 1")

    def test_unknown_option_names_the_nearest(self):
        self.refused(2, ["--scene", "CrashSk", "--iteration", "3"], "--iteration", "--iterations")

    def test_unknown_stepper_lists_the_known(self):
        self.refused(2, ["--scene", "CrashSk", "--stepper", "fast"], "fast", "quick", "direct")

    def test_output_into_a_missing_folder(self):
        self.refused(3, ["--scene", "CrashSk", "--output", "absent/run.h5"], "absent/run.h5")

    def test_output_that_is_a_folder(self):
        os.mkdir(self.path("folder"))
        self.refused(2, ["--scene", "CrashSk", "--output", "folder"], "folder")

    def test_missing_config_file(self):
        self.refused(2, ["--config", "absent.cfg"], "absent.cfg")

    def test_two_contradicting_options(self):
        self.refused(2, ["--scene", "CrashSk", "--no-output", "--output", "x.h5"], "--output", "--no-output")


class MoreRanksThanWorlds(ProgramTest):
    def test_works_and_names_the_idle_ranks(self):
        summary = self.summary(4, "--scene", "CrashSk", "--replicas", 2)
        self.assertEqual(summary["idle_ranks"], [2, 3])
        self.assertEqual(summary["ranks"], 4)
        self.assertTrue(os.path.exists(self.path("CrashSk.h5")))


if __name__ == "__main__":
    unittest.main()
