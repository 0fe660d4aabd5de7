"""Models in MJCF and URDF, alone and in scenes: runs, refusals, files and checkpoints."""
import os
import shutil
import unittest

import h5py

from harness import BIN, SOURCE, ProgramTest

PBSTUDY = os.path.join(BIN, "pbstudy")
MODELS = os.path.join(SOURCE, "scenes", "models")
# Where Debian's or a user's MuJoCo keeps its own humanoid, if it is there at all.
MUJOCOS_HUMANOID = os.environ.get("PBMPI_MUJOCO_HUMANOID", "/usr/share/mujoco/model/humanoid/humanoid.xml")


def model(name):
    return os.path.join(MODELS, name)


class Models(ProgramTest):
    def take(self, *names):
        for name in names:
            shutil.copy(model(name), self.path(name))

    def positions(self, name):
        """Of the bodies by name, in the first and the last frame."""
        with h5py.File(self.path(name)) as file:
            names = file["particles/bodies/name"].asstr()[:]
            values = file["particles/bodies/position/value"]
            last = file.attrs["frames_committed"] - 1
            return {body: (values[0][i], values[last][i]) for i, body in enumerate(names)}

    def test_each_runs_for_ten_seconds(self):
        for name in ("humanoid.xml", "quadruped.xml", "arm.urdf"):
            summary = self.summary(1, "--scene", model(name), "--quiet", "--output", "run.h5")
            seconds = summary["dt"] * summary["steps_per_frame"] * summary["frames"]["measured"]
            self.assertGreaterEqual(seconds, 8.9, name)
            self.assertEqual(summary["invariants"]["nonfinite_bodies"], 0, name)
            self.assertLess(summary["invariants"]["max_joint_gap_m"], 0.01, name)
            self.assertLess(summary["invariants"]["max_penetration_m"], 0.03, name)
            with h5py.File(self.path("run.h5")) as file:
                with open(model(name), encoding="utf-8") as text:
                    self.assertEqual(file["parameters/scene_text"].asstr()[()], text.read())

    def test_a_quadruped_stands_and_a_humanoid_falls(self):
        self.summary(1, "--scene", model("quadruped.xml"), "--quiet", "--output", "run.h5")
        self.assertGreater(self.positions("run.h5")["quadruped.trunk"][1][2], 0.3)
        self.summary(1, "--scene", model("humanoid.xml"), "--quiet", "--output", "run.h5")
        self.assertLess(self.positions("run.h5")["humanoid.chest"][1][2], 0.4)

    def test_the_same_bits_on_one_and_on_two_ranks(self):
        args = ("--scene", model("humanoid.xml"), "--replicas", 3, "--frames", 4, "--quiet", "--no-output")
        self.assertEqual(self.summary(1, *args)["state_hash"], self.summary(2, *args)["state_hash"])

    def test_a_run_goes_on_without_its_files(self):
        self.take("yard.toml", "arm.urdf")
        whole = self.summary(1, "--scene", "yard.toml", "--frames", 8, "--no-output", "--quiet")
        self.summary(2, "--scene", "yard.toml", "--frames", 4, "--quiet", "--checkpoint", "run.ck.h5")
        for name in ("yard.toml", "arm.urdf"):
            os.remove(self.path(name))
        rest = self.summary(1, "--resume", "run.ck.h5", "--frames", 8, "--no-output", "--quiet")
        self.assertEqual(rest["state_hash"], whole["state_hash"])
        again = self.report("yard.h5", "--json")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_copies_stand_on_the_ground_of_a_scene(self):
        self.take("quadruped.xml")
        scene = self.write("herd.toml", 'title = "a herd"\n[[actor]]\nname = "dog"\ntype = "model"\nfile = "quadruped.xml"\n'
                                        'position = [0, 0, 0.1]\ncopies = 3\nspacing = [0, 2, 0]\n[run]\nframes = 60\ndt = 0.005\n')
        self.summary(1, "--scene", scene, "--quiet", "--output", "run.h5")
        at = self.positions("run.h5")
        for copy in (1, 2, 3):
            self.assertGreater(at[f"dog.{copy}.trunk"][1][2], 0.4)
            self.assertAlmostEqual(at[f"dog.{copy}.trunk"][1][1], 2 * (copy - 1), delta=0.1)

    def test_notes_are_told_unless_quiet(self):
        args = (1, "--scene", model("humanoid.xml"), "--frames", 1, "--warmup", 0, "--no-output")
        self.assertIn("pbmpi: note: " + model("humanoid.xml") + ":", self.pbmpi(*args).stderr)
        self.assertNotIn("note", self.pbmpi(*args, "--quiet").stderr)
        described = self.pbmpi(1, "--scene", model("humanoid.xml"), "--describe")
        self.assertIn("note: " + model("humanoid.xml") + ":", described.stdout)

    def refused(self, args, *words):
        result = self.pbmpi(2, *args)
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_a_run_of_attached_and_replicated_models_goes_on_without_their_files(self):
        os.mkdir(self.path("parts"))
        self.write("parts/leg.xml", "<mujoco model='leg'><worldbody><body name='b' pos='0 0 1'><joint name='h' axis='0 1 0'/>"
                                    "<geom size='.1' pos='.3 0 0'/></body></worldbody></mujoco>")
        main = self.write("row.xml", "<mujoco><asset><model file='parts/leg.xml'/></asset><worldbody>"
                                     "<replicate count='3' offset='0 1 0'><attach model='leg' body='b' prefix='leg/'/></replicate>"
                                     "</worldbody></mujoco>")
        whole = self.summary(1, "--scene", main, "--frames", 4, "--no-output", "--quiet")
        self.summary(1, "--scene", main, "--frames", 2, "--quiet", "--output", "run.h5", "--checkpoint", "run.ck.h5")
        self.assertEqual(list(self.positions("run.h5")), ["row.leg/b0", "row.leg/b1", "row.leg/b2"])
        os.remove(self.path("parts/leg.xml"))
        rest = self.summary(2, "--resume", "run.ck.h5", "--frames", 4, "--no-output", "--quiet")
        self.assertEqual(rest["state_hash"], whole["state_hash"])
        self.refused(["--scene", main], "parts/leg.xml", "MJCF")
        endless = "<mujoco><worldbody><replicate count='1000000000'><body/></replicate></worldbody></mujoco>"
        self.refused(["--scene", self.write("endless.xml", endless)], "endless.xml:1:", "replicate", "1000000 elements")

    def test_refusals_end_with_code_2_and_one_message(self):
        self.refused(["--scene", self.write("a.xml", "<mujoco>\n<worldbody>")], "a.xml:2:", "malformed XML")
        self.refused(["--scene", self.write("a.urdf", "<robot name='r'><link nam='a'/></robot>")], "a.urdf:1:", "name")
        self.refused(["--scene", "absent.urdf"], "absent.urdf")
        scene = 'title = "t"\n[[actor]]\nname = "a"\ntype = "model"\nfile = "absent.xml"\n'
        self.refused(["--scene", self.write("a.toml", scene)], "a.toml", "absent.xml", "MJCF")
        with open(self.path("bytes.xml"), "wb") as file:
            file.write(bytes(range(256)))
        self.refused(["--scene", "bytes.xml"], "bytes.xml")

    def test_a_study_takes_a_model(self):
        result = self.run_command([PBSTUDY, "effects", "--scene", model("quadruped.xml"), "--effect", "friction", "--repeats", "1",
                                   "--frames", "1", "--warmup", "0", "--floor-seeds", "1", "-o", "study.h5"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("pbstudy: note: ", result.stderr)

    @unittest.skipUnless(os.path.exists(MUJOCOS_HUMANOID), "no humanoid of MuJoCo's (PBMPI_MUJOCO_HUMANOID names it)")
    def test_mujocos_humanoid_runs(self):
        shutil.copy(MUJOCOS_HUMANOID, self.path("humanoid.xml"))
        scene = self.write("its.toml", 'title = "MuJoCo\'s"\n[[actor]]\nname = "humanoid"\ntype = "model"\nfile = "humanoid.xml"\n'
                                       'leave_out = ["tendon"]\n[run]\ndt = 0.005\nframes = 300\n')
        summary = self.summary(1, "--scene", scene, "--quiet", "--no-output")
        self.assertEqual(summary["invariants"]["nonfinite_bodies"], 0)
        # Its joints open by 36 mm as it falls, since bodies of 2 % of the mass stand between its hinges.
        self.assertLess(summary["invariants"]["max_joint_gap_m"], 0.05)


if __name__ == "__main__":
    unittest.main()
