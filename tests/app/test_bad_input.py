"""Every refusal: one clear message from one rank, exit code 2, no file left, no hang."""
import os
import subprocess
import unittest

from harness import BIN, PBMPI, PBREPORT, TIMEOUT_S, ProgramTest

PBSTUDY = os.path.join(BIN, "pbstudy")

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


class Refusals(ProgramTest):
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


class BadInput(Refusals):
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

    def test_a_word_alone_is_named(self):
        self.refused(2, ["CrashSk"], "'CrashSk'", "--scene CrashSk")
        for study in ("accuracy", "effects", "stability"):
            result = self.run_command([PBSTUDY, study, "CrashSk"])
            self.assertEqual(result.returncode, 2)
            self.assertIn("did you mean --scene CrashSk?", result.stderr)

    def test_a_slip_in_a_name_of_the_base_is_found(self):
        over = 'title = "x"\nbase = "CrashSk"\n[[actor]]\nname = "gruond"\nposition = [0, 0, 0]\n'
        self.refused(2, self.scene(over), "scene.toml:3:", "gruond", "'type'", "did you mean 'ground'")
        over = 'title = "x"\nbase = "hard/joints/bridge30"\n[[joint]]\nname = "jiont"\n'
        self.refused(2, self.scene(over), "scene.toml:3:", "jiont", "'kind'")

    def test_a_slip_in_a_key_that_is_needed_is_found(self):
        self.refused(2, self.scene(GOOD_SCENE.replace("size =", "sizes =")), "scene.toml:9:", "'size' is missing", "'sizes'")

    def test_an_option_that_the_stepper_lacks_is_named_alone(self):
        for option, value in (("--substeps", "4"), ("--tolerance", "1mm"), ("--threads", "2"), ("--precision", "single")):
            self.refused(2, ["--scene", "CrashSk", "--stepper", "quick", option, value], f"pbmpi: {option} is an option of --stepper sor")

    def test_an_estimate_without_iterations_takes_none(self):
        self.refused(2, ["--scene", "CrashSk", "--feec=direct iterations=3"], "--feec", "iterations", "direct")

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


class NumbersAndTimes(Refusals):
    """Numbers that no run reaches."""

    def test_frames_steps_and_worlds_beyond_any_run(self):
        self.refused(2, ["--scene", "CrashSk", "--frames", 2**31 - 1], "--frames", "at most")
        self.refused(2, ["--scene", "CrashSk", "--warmup", 2**31 - 1], "--warmup", "at most")
        self.refused(2, ["--scene", "CrashSk", "--steps-per-frame", 2**31 - 1], "--steps-per-frame", "at most")
        self.refused(2, ["--scene", "CrashSk", "--replicas", 2**31 - 1], "--replicas", "GiB", "fewer")
        self.refused(2, self.scene(GOOD_SCENE + "[run]\nframes = 2147483647\n"), "--frames", "at most")

    def test_contacts_of_a_pair_beyond_what_is_counted(self):
        self.refused(2, self.scene(GOOD_SCENE + "[contact]\nmax_per_pair = 2147483647\n"), "max_per_pair", "65535")

    def test_times_beyond_any_step(self):
        tank = '[[actor]]\nname = "tank"\ntype = "tank"\nposition = [20, 0, 0]\n'
        ball = ('[[actor]]\nname = "ball"\ntype = "projectile"\nshape = "sphere"\nradius = 0.1\ndensity = 4000\n'
                'position = [0, 9, 0]\nfired_by = "tank"\nmuzzle_speed = 40\nfirst_shot = 1e20\n')
        self.refused(2, self.scene(GOOD_SCENE + tank + ball), "scene.toml:22:", "1e+20 s", "earlier")
        event = '[[event]]\nbody = "box"\nat = 1e20\nvelocity = [1, 0, 0]\n'
        self.refused(2, self.scene(GOOD_SCENE + event), "scene.toml:13:", "1e+20 s", "earlier")
        car = '[[actor]]\nname = "car"\ntype = "car"\nposition = [20, 0, 0]\nsteering = [[0, 0], [TIME, 30]]\n'
        self.refused(2, self.scene(GOOD_SCENE + car.replace("TIME", "1e20")), "scene.toml:15:", "steering", "earlier")
        self.refused(2, self.scene(GOOD_SCENE + car.replace("TIME", "1e9")), "scene.toml:11:", "car", "4,000,000 events")

    def test_more_bodies_than_any_memory_holds(self):
        self.refused(2, self.scene(GOOD_SCENE + "copies = 2147483647\nspacing = [2, 0, 0]\n"), "scene.toml:11:", "a million")
        wall = '[[actor]]\nname = "wall"\ntype = "wall"\nposition = [9, 0, 0]\nlength = 1e9\nheight = 2\nblock = [0.1, 0.5, 0.5]\n'
        self.refused(2, self.scene(GOOD_SCENE + wall), "scene.toml:11:", "wall", "a million blocks")

    def test_numbers_beyond_what_a_solver_can_carry(self):
        """Their products are infinite: energies, momenta, inertias."""
        for key, line in (("mass = 10", 10), ("size = [1, 1, 1]", 9), ("position = [0, 0, 1]", 8)):
            name, value = key.split(" = ")
            for number in ("1e308", "1e31"):
                text = GOOD_SCENE.replace(key, f"{name} = {value.replace('1', number, 1).replace(number + '0', number)}")
                self.refused(2, self.scene(text), f"scene.toml:{line}:", name, "from -1e30 to 1e30")
        for key in ("velocity = [1e200, 0, 0]", "angular_velocity = [0, -1e200, 0]"):
            self.refused(2, self.scene(GOOD_SCENE + key + "\n"), "scene.toml:11:", key.split()[0], "from -1e30 to 1e30")
        self.refused(2, self.scene("gravity = [0, 0, -1e99]\n" + GOOD_SCENE), "scene.toml:1:", "gravity", "from -1e30 to 1e30")
        self.refused(2, self.scene(GOOD_SCENE.replace("mass = 10", "mass = 1e-300")), "scene.toml:10:", "mass", "at least 1e-30")
        dense = GOOD_SCENE.replace("mass = 10", "density = 1e30").replace("[1, 1, 1]", "[9, 9, 9]")
        self.refused(2, self.scene(dense), "scene.toml:5:", "box", "beyond 1e-30 to 1e30 kg")
        model = '<mujoco><worldbody><body><freejoint/><geom size="1" mass="1e200"/></body></worldbody></mujoco>\n'
        self.refused(2, ["--scene", self.write("m.xml", model)], "m.xml:1:", "1e200", "from -1e30 to 1e30")


class WhatIsRead(Refusals):
    """What is no file, or no text."""

    def test_pipes_devices_and_folders_are_no_input(self):
        os.mkfifo(self.path("pipe.toml"))
        os.symlink("/dev/zero", self.path("zero.toml"))
        os.mkdir(self.path("folder.toml"))
        for name, why in (("pipe.toml", "pipe or a device"), ("zero.toml", "pipe or a device"), ("folder.toml", "directory")):
            self.refused(2, ["--scene", name], name, why, "scene file")
            self.refused(2, ["--scene", "CrashSk", "--config", name], name, why, "name = value")
            self.refused(2, ["--resume", name], name, why, "pbmpi has written")
            result = self.report(name)
            self.assertEqual((result.returncode, why in result.stderr), (2, True), result.stderr)

    def test_a_line_of_a_config_file_is_named_with_its_file(self):
        for line, words in (("frames = abc", ["abc", "frames"]), ("frames", ["invalid line"]), ("framse = 3", ["--frames"])):
            self.write("my.cfg", line + "\n")
            self.refused(2, ["--scene", "CrashSk", "--config", "my.cfg"], "my.cfg: ", *words)

    def test_a_name_that_is_no_utf_8_does_not_end_a_run(self):
        with open(os.path.join(os.fsencode(self.folder), b"na\xffme.toml"), "w", encoding="utf-8") as file:
            file.write(GOOD_SCENE)
        scene = os.fsdecode(b"na\xffme.toml")
        summary = self.summary(2, "--scene", scene)
        self.assertEqual(summary["scene"], "na\N{REPLACEMENT CHARACTER}me")
        result = self.report(os.fsdecode(b"na\xffme.h5"), "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.json(result)["scene"], summary["scene"])


class Scenes(Refusals):
    def test_a_static_body_has_no_velocity(self):
        static = '[[actor]]\ntype = "box"\nname = "block"\nposition = [9, 0, 1]\nsize = [1, 1, 1]\nstatic = true\n'
        self.refused(2, self.scene(GOOD_SCENE + static + "velocity = [1, 0, 0]\n"), "scene.toml:17:", "velocity", "static")
        self.refused(2, self.scene(GOOD_SCENE + static + "variation = { velocity = [1, 0, 0] }\n"), "scene.toml:17:", "static")

    def test_small_bodies_overlap_by_less_than_large_ones(self):
        small = GOOD_SCENE.replace("size = [1, 1, 1]", "size = [0.01, 0.01, 0.01]").replace("[0, 0, 1]", "[0, 0, Z]")
        self.refused(2, self.scene(small.replace("Z", "0")), "overlaps", "5 mm")
        self.assertEqual(self.pbmpi(1, *self.scene(small.replace("Z", "0.0049")), "--describe").returncode, 0)

    def test_an_overlap_that_a_file_brings_about_is_reported_in_that_file(self):
        base = ('title = "over"\nbase = "hard/rest/column10"\n'
                '[[actor]]\nname = "NAME"\nspacing = [0, 0, 0.6]\n')
        for name in ("odd", "even"):
            self.refused(2, self.scene(base.replace("NAME", name)), "scene.toml:4:", "overlaps")

    def test_a_study_has_no_two_scenes_of_one_name(self):
        for folder in ("a", "b"):
            os.mkdir(self.path(folder))
            self.write(f"{folder}/x.toml", GOOD_SCENE)
        for study in ("accuracy", "effects", "stability"):
            result = self.run_command([PBSTUDY, study, "--scene", "a/x.toml", "b/x.toml"])
            self.assertEqual(result.returncode, 2, result.stderr)
            for words in ("b/x.toml", "a/x.toml", "rename"):
                self.assertIn(words, result.stderr)


class WhatIsSaid(ProgramTest):
    def test_a_full_standard_output_is_a_failure(self):
        self.assertEqual(self.pbmpi(1, "--scene", "CrashSk", "-q").returncode, 0)
        for command in ([PBMPI, "--scene", "CrashSk", "--no-output"], [PBMPI, "--list-scenes"], [PBMPI, "--help"],
                        [PBMPI, "--scene", "CrashSk", "--describe"], [PBMPI, "--scene", "CrashSk", "--report", "json", "--no-output"],
                        [PBREPORT, "CrashSk.h5"], [PBREPORT, "CrashSk.h5", "--json"], [PBSTUDY, "effects", "--help"]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                result = subprocess.run(command, cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True,
                                        timeout=TIMEOUT_S, check=False)
            self.assertEqual(result.returncode, 1, command)
            self.assertIn("standard output", result.stderr)

    def test_a_step_that_changes_the_length_of_a_frame_is_noted(self):
        described = ["--scene", "CrashSk", "--describe", "--dt", "0.001"]
        note = self.pbmpi(2, *described).stderr
        for words in ("note", "0.003 s", "0.03 s", "--steps-per-frame 30"):
            self.assertEqual(note.count(words), 1, note)
        self.assertEqual(self.pbmpi(2, *described, "--steps-per-frame", 30).stderr, "")
        self.assertEqual(self.pbmpi(2, *described, "--quiet").stderr, "")


class MoreRanksThanWorlds(ProgramTest):
    def test_works_and_names_the_idle_ranks(self):
        summary = self.summary(4, "--scene", "CrashSk", "--replicas", 2)
        self.assertEqual(summary["idle_ranks"], [2, 3])
        self.assertEqual(summary["ranks"], 4)
        self.assertTrue(os.path.exists(self.path("CrashSk.h5")))


if __name__ == "__main__":
    unittest.main()
