"""Runs that go on from a checkpoint: the same bits as if they had never been stopped, and what is refused."""
import os
import re
import shutil
import unittest

import h5py
import numpy as np

from harness import ODE_LAW, PBMPI, ProgramTest, SOURCE, seal
from small_scenes import SIGN, STACKS

WARMUP = 3
# A dataset of each kind whose rows do not depend on who owned what.
COLUMNS = ("particles/bodies/position/value", "particles/bodies/angular_velocity/value", "particles/bodies/position/step",
           "particles/bodies/position/time", "observables/world/energy", "observables/world/rows", "timings/frame/step",
           "timings/frame/measured")


class Resume(ProgramTest):
    def check(self, scene, before, frames, args=(), ranks=((1, 2), (2, 3), (3, 1)), **options):
        """Saves a run after `before` measured frames and goes on; `ranks`: of either part. Returns the hash of all."""
        args = ["--scene", scene, *args]
        whole = self.summary(1, *args, "--frames", frames, "--no-output")["state_hash"]
        for first_ranks, ranks_after in ranks:
            first = self.summary(first_ranks, *args, "--frames", before, "--no-output", "--checkpoint", "run.ck.h5")
            self.assertNotEqual(first["state_hash"], whole, "there is something left to do")
            rest = self.summary(ranks_after, "--resume", "run.ck.h5", "--frames", frames, *options.get("then", ()))
            self.assertEqual(rest["state_hash"], whole, (scene, first_ranks, ranks_after))
            self.assertEqual(rest["frames"], {"before": before + WARMUP, "warmup": 0, "measured": frames - before})
            self.assertEqual(rest["decomposition"], options.get("cut", rest["decomposition"]))
        return whole

    def test_worlds_have_the_hash_of_the_whole_run_with_any_number_of_ranks(self):
        for args in ([], ["--precision", "single"], ["--stepper", "quick"]):
            self.check("100CrSk", 4, 12, ["--replicas", 7, *args])

    def test_substeps_the_direct_stepper_estimates_and_other_effects_go_on_too(self):
        self.check("CrashSk", 3, 9, ["--substeps", 4, "--iterations", 5], [(1, 2)])
        self.check("CrashSk", 3, 9, [*ODE_LAW, "--iterations", 20], [(2, 1)])
        self.check("CrashSk", 3, 6, ["--stepper", "direct"], [(1, 1)])
        self.check("CrashSk", 3, 9, ["--feec"], [(1, 1)])
        self.check("CrashSk", 3, 9, ["--feec", "--steps-per-frame", 1], [(1, 2)])
        self.check("CrashWa", 3, 9, ["--effects=-friction", "--solver-seed", 7], [(2, 1)])

    def test_one_world_goes_on_in_one_piece_or_cut_into_spaces(self):
        self.check("Battle2", 6, 24, [], [(2, 3)], cut="spaces")
        self.check("Battle2", 6, 24, [], [(3, 1), (1, 1)], cut="worlds")
        self.check("Battle2", 6, 24, ["--decompose", "worlds"], [(1, 2)], then=["--decompose", "spaces"], cut="spaces")
        self.check("Fight", 20, 30, ["--precision", "single"], [(2, 3), (3, 2)], cut="spaces")

    def test_bodies_that_rest_sleep_and_wake_as_if_nothing_had_happened(self):
        scene = self.write("stacks.toml", STACKS)
        # In frame 12 bodies count how long they have rested, in 25 some sleep, and the ball wakes them later.
        for before in (9, 22):
            self.check(scene, before, 45, ["--replicas", 3], [(2, 3)])
            self.check(scene, before, 45, ["--stepper", "quick"], [(1, 1)])
            self.check(scene, before, 45, ["--decompose", "spaces"], [(2, 3), (3, 1)], cut="spaces")

    def test_joints_that_are_broken_stay_so(self):
        scene = self.write("sign.toml", SIGN)
        for args in (["--replicas", 3], ["--stepper", "quick"], ["--decompose", "spaces"]):
            self.check(scene, 25, 45, args, [(1, 2), (2, 1)] if "quick" not in args else [(1, 1)])
        first = self.summary(1, "--scene", scene, "--frames", 25, "--no-output")
        self.assertGreater(first["joints_broken"], 0, "some are broken when the run is saved")

    def test_a_run_saved_and_resumed_twice_has_the_hash_too(self):
        args = ["--scene", "100CrSk", "--replicas", 4]
        whole = self.summary(1, *args, "--frames", 12, "--output", "whole.h5")["state_hash"]
        self.summary(2, *args, "--frames", 3, "--output", "part.h5", "--checkpoint", "run.ck.h5")
        second = self.summary(3, "--resume", "run.ck.h5", "--frames", 7, "--checkpoint", "run.ck.h5")
        self.assertEqual(second["checkpoint"], "run.ck.h5 (after 10 frames)")
        third = self.summary(1, "--resume", "run.ck.h5", "--frames", 12)
        self.assertEqual(third["state_hash"], whole)
        self.assertEqual((second["output"], third["output"]), ("part.from6.h5", "part.from10.h5"))
        self.check_parts("whole.h5", ["part.h5", "part.from6.h5", "part.from10.h5"])

    def test_the_schema_names_all_that_a_checkpoint_holds(self):
        self.summary(1, "--scene", "CrashSk", "--frames", 1, "--no-output", "--checkpoint", "run.ck.h5")
        with open(os.path.join(SOURCE, "io", "SCHEMA.md"), encoding="utf-8") as text:
            part = text.read().split('# The file of a checkpoint (`filetype = "pbmpi-checkpoint"`')[1].split("\n# ")[0]
        listed = {path for row in re.findall(r"^\| `/.*", part, re.M)
                  for path in re.findall(r"`(/[^`]*)`", row.split("|")[1])}
        found = []
        with h5py.File(self.path("run.ck.h5")) as file:
            file.visititems(lambda name, item: found.append("/" + name) if isinstance(item, h5py.Dataset) else None)
            for name in file.attrs:
                self.assertIn(name, part)
        self.assertEqual(sorted(found), sorted(listed))

    def check_parts(self, whole, parts):
        """The rows of the parts, one after the other, are those of the whole."""
        with h5py.File(self.path(whole)) as file:
            expected = {name: file[name][:] for name in COLUMNS}
        files = [h5py.File(self.path(part)) for part in parts]
        for name in COLUMNS:
            rows = np.concatenate([file[name][:] for file in files])
            self.assertEqual(rows.tobytes(), expected[name].tobytes(), name)
        first = 0
        for part, file in zip(parts, files):
            self.assertEqual(int(file.attrs["first_frame"]), first, part)
            first += int(file.attrs["frames_committed"])
            file.close()
            summary = self.json(self.report(self.path(part), "--json"))
            self.assertEqual(summary["frames"]["before"], first - summary["frames"]["measured"]
                             - summary["frames"]["warmup"])

    def test_an_interval_of_recording_starts_anew_and_frames_keep_their_numbers(self):
        args = ["--scene", "CrashSk", "--record-every", 4]
        self.summary(1, *args, "--frames", 6, "--output", "part.h5", "--checkpoint", "run.ck.h5")
        self.summary(1, "--resume", "run.ck.h5", "--frames", 17, "--output", "rest.h5")
        with h5py.File(self.path("rest.h5")) as file:
            self.assertEqual(file["particles/bodies/position/step"][:].tolist(), [3 * (9 + 4), 3 * (9 + 8)])
            self.assertEqual(file["timings/frame/step"][0], 3 * 10)
            self.assertEqual(len(file["timings/frame/step"]), 11)
            self.assertEqual(file["parameters/resumed_from"].asstr()[()], "run.ck.h5")
        self.assertEqual(self.report(self.path("rest.h5")).returncode, 0)


class Refused(ProgramTest):
    def setUp(self):
        super().setUp()
        self.summary(1, "--scene", "CrashSk", "--frames", 2, "--output", "run.h5", "--checkpoint", "run.ck.h5")

    def check(self, words, *args, ranks=None):
        """Without ranks the program is started alone, which is quicker."""
        before = self.bytes_of("run.h5"), self.bytes_of("run.ck.h5")
        args = args if "--frames" in args else ("--frames", 9, *args)
        result = self.pbmpi(ranks, *args) if ranks else self.run_command([PBMPI, *map(str, args)])
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual((self.bytes_of("run.h5"), self.bytes_of("run.ck.h5")), before, "both files are as they were")

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def changed(self, change):
        """The name of a copy of the checkpoint that `change` has been at."""
        shutil.copy(self.path("run.ck.h5"), self.path("other.h5"))
        with h5py.File(self.path("other.h5"), "r+") as file:
            change(file)
        seal(self.path("other.h5"))
        return "other.h5"

    def test_what_is_no_checkpoint(self):
        self.check(["absent.h5", "no such file"], "--resume", "absent.h5", ranks=3)
        self.write("text.h5", "not HDF5")
        self.check(["text.h5", "HDF5"], "--resume", "text.h5")
        self.check(["run.h5", "not a pbmpi-checkpoint", '"pbmpi-run"'], "--resume", "run.h5")
        self.assertIn("not a pbmpi run", self.report(self.path("run.ck.h5")).stderr)

    def test_a_file_that_is_cut_off_or_damaged(self):
        whole = self.bytes_of("run.ck.h5")
        for share in (0.1, 0.5, 0.99):
            with open(self.path("cut.h5"), "wb") as file:
                file.write(whole[:int(share * len(whole))])
            self.check(["cut.h5"], "--resume", "cut.h5")

        def move_a_body(file):
            file["bodies/position"][3, 0] += 1e-12

        def lose_a_world(file):
            file["worlds/bodies"][0] -= 1

        def lose_a_column(file):
            del file["bodies/velocity"]
        self.check(["other.h5", "hash", "damaged"], "--resume", self.changed(move_a_body), ranks=2)
        self.check(["other.h5", "/worlds/bodies", "damaged"], "--resume", self.changed(lose_a_world))
        self.check(["other.h5", "/bodies/velocity"], "--resume", self.changed(lose_a_column))

    def test_another_layout_and_another_version_of_the_program(self):
        def newer_layout(file):
            file.attrs["version"] = np.array([2, 0], dtype="i8")

        def older_program(file):
            file.attrs["pbmpi_version"] = np.bytes_("0.0.7")
        self.check(["other.h5", "version 2.0", "1.x"], "--resume", self.changed(newer_layout))
        self.check(["other.h5", "pbmpi 0.0.7"], "--resume", self.changed(older_program))

    def test_another_build_of_the_same_version_is_only_warned_of(self):
        def other_compiler(file):
            file.attrs["build"] = np.bytes_("Clang 99")
        result = self.pbmpi(2, "--resume", self.changed(other_compiler), "--frames", 4, "--no-output")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("warning: other.h5 was written by another build"), 1, result.stderr)

    def test_options_that_would_make_it_another_run(self):
        for name, value, had in (("dt", "0.02", "0.01"), ("iterations", "5", "1"), ("law", "ode", "soft"), ("stepper", "quick", "sor"),
                                 ("replicas", "2", "1"), ("seed", "2", "1"), ("precision", "single", "double"),
                                 ("steps-per-frame", "1", "3"), ("effects", "-gravity", "none")):
            self.check([f"--{name} {value}", f"has {name} {had}", "leave the option out"], "--resume", "run.ck.h5",
                       f"--{name}={value}")
        self.check(["--scene CrashWa", "CrashSk"], "--resume", "run.ck.h5", "--scene", "CrashWa", ranks=2)

    def test_the_same_options_again_are_none_of_those(self):
        result = self.pbmpi(2, "--resume", "run.ck.h5", "--scene", "CrashSk", "--dt", 0.01, "--iterations", 1, "--frames",
                            4, "--simd", "sse2", "--no-output", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_files_that_would_be_lost_and_frames_that_are_done(self):
        self.check(["run.h5", "frames before"], "--resume", "run.ck.h5", "--output", self.path("run.h5"))
        self.check(["run.ck.h5", "checkpoint"], "--resume", "run.ck.h5", "--output", "run.ck.h5")
        self.check(["run.ck.h5", "written, too"], "--scene", "CrashSk", "--output", "run.ck.h5", "--checkpoint", "run.ck.h5")
        self.check(["all 5 frames", "above 2"], "--resume", "run.ck.h5", "--frames", 2, ranks=2)

    def test_impossible_times_and_a_place_that_cannot_be_written(self):
        for option in ("--checkpoint-every", "--max-time"):
            for value in ("0", "-1", "nan"):
                self.check([option, "above 0"], "--scene", "CrashSk", f"{option}={value}", "--no-output")
        self.check(["no directory", "nowhere"], "--scene", "CrashSk", "--checkpoint", "nowhere/ck.h5", "--no-output",
                   ranks=2)


if __name__ == "__main__":
    unittest.main()
