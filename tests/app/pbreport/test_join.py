"""pbreport join: the file of a run that was stopped and resumed is that of a run that never was."""
import os
import signal
import sys
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "files"))
from harness import ProgramTest, SOURCE, rank_pids, wait_until  # noqa: E402
from same_files import content, differences  # noqa: E402
from small_scenes import SIGN  # noqa: E402

WARMUP = 3
# A checkpoint is written where a run is stopped; a run that goes on has none. Rebalances follow the clock, and some runs have more
# of them than the file has rows for.
OF_STOPPING = {"/events/" + name for name in ("frame", "kind", "detail", "step", "world", "joint", "name", "value")} | {
    "/events@num_checkpoint", "/events@num_dropped"}

# What each part says of its own frames, and a joined file leaves out.
OF_A_PART = "/world_results"


def events_of_worlds(path):
    with h5py.File(path) as file:
        rows = list(zip(*(file["events"][name][:] for name in ("frame", "kind", "step", "world", "joint", "name", "value"))))
    return [row for row in rows if row[1] not in (b"checkpoint", b"rebalance")]


def structure(path):
    """Every object with its type, its attributes' names and types, and the names under which it stands; but for the environment."""
    found = {}

    def visit(name, thing):
        if name.startswith("parameters/env_") or ("/" + name).startswith(OF_A_PART):
            return
        attributes = sorted((key, str(thing.attrs.get_id(key).dtype)) for key in thing.attrs)
        chunked = isinstance(thing, h5py.Dataset) and thing.chunks is not None
        found[name] = (type(thing).__name__, attributes, chunked)

    def names(group, path, into):
        for key, thing in group.items():
            if (path + key).startswith(OF_A_PART):
                continue
            into.append(path + key)
            if isinstance(thing, h5py.Group):
                names(thing, path + key + "/", into)

    with h5py.File(path) as file:
        file.visititems(visit)
        found["/"] = sorted(file.attrs)
        links = []
        names(file, "/", links)
        found["links"] = sorted(link for link in links if not link.startswith("/parameters/env_"))
    return found


def checksum(data):
    """As src/core/system/seal.h has it."""
    value = 0x9e3779b97f4a7c15
    for word in np.frombuffer(data + bytes(8 - len(data) % 8), "<u8").tolist() + [len(data)]:
        value = (value ^ word) * 0x100000001b3 % 2**64
        value ^= value >> 32
    return value


class Join(ProgramTest):
    def run_parts(self, scene, stops, frames, *args, ranks=(2, 3, 1), then=()):
        """whole.h5, and the parts of a run that is stopped after `stops` measured frames: their names."""
        args = ["--scene", scene, *args]
        self.summary(1, *args, *then, "--frames", frames, "--output", "whole.h5")
        parts = ["part0.h5"]
        self.summary(ranks[0], *args, *then, "--frames", stops[0], "--output", parts[0], "--checkpoint", "ck.h5")
        for i, until in enumerate([*stops[1:], frames]):
            parts.append(f"part{i + 1}.h5")
            self.summary(ranks[i + 1], "--resume", "ck.h5", *then, "--frames", until, "--output", parts[-1], "--checkpoint", "ck.h5")
        return parts

    def join(self, *args):
        result = self.report("join", *args, "--output", "all.h5")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def assert_like_whole(self, whole="whole.h5", joined="all.h5"):
        whole, joined = self.path(whole), self.path(joined)
        apart = differences(content(whole), content(joined))
        self.assertLessEqual({name for name in apart if not name.startswith(OF_A_PART)}, OF_STOPPING)
        self.assertEqual(events_of_worlds(whole), events_of_worlds(joined))
        one, other = structure(whole), structure(joined)
        self.assertIn("/parameters/joined_from", other["links"])
        self.assertNotIn("/parameters/resumed_from", other["links"])
        other["links"].remove("/parameters/joined_from")
        other.pop("parameters/joined_from")
        self.assertEqual(one, other)
        with h5py.File(whole) as a, h5py.File(joined) as b:
            for key in ("scene", "seed", "state_hash", "frames_committed", "complete", "record_every", "first_frame"):
                self.assertEqual(a.attrs[key], b.attrs[key])
            self.assertEqual(a["parameters/frames"][()], b["parameters/frames"][()])
            self.assertEqual(b["observables/energy/value"], b["observables/world/energy"], "one dataset under two names")
            self.assertGreater(b.attrs["checksum"], 0)
            self.assertGreater(b.attrs["end_checksum"], 0)
        summary = self.json(self.report(joined, "--json"))
        self.assertTrue(summary["complete"])
        self.assertEqual(summary["frames"]["before"], 0)

    def test_three_parts_on_other_ranks_are_the_run_that_was_never_stopped(self):
        parts = self.run_parts("100CrSk", (3, 5), 9, "--replicas", 3, then=["--record", "contacts"])
        text = self.join(parts[2], parts[0], parts[1])
        self.assertIn("part1.h5: frames 6 to 7, 2 of them taken; ranks is 3", text)
        self.assert_like_whole()
        with h5py.File(self.path("all.h5")) as file:
            self.assertEqual(file["timings/rank/solve"].shape, (12, 3))
            for part, rows in (("part0.h5", slice(0, 6)), ("part1.h5", slice(6, 8)), ("part2.h5", slice(8, 12))):
                with h5py.File(self.path(part)) as source:
                    ranks = source["timings/rank/useful"].shape[1]
                    np.testing.assert_array_equal(file["timings/rank/useful"][rows, :ranks], source["timings/rank/useful"][:])
                    self.assertFalse(file["timings/rank/useful"][rows, ranks:].any())
                    np.testing.assert_array_equal(file["timings/frame/wall"][rows], source["timings/frame/wall"][:])
            self.assertEqual(len(file["ranks/rank"]), 3)
            self.assertEqual(file["parameters/ranks"][()], 3)
            self.assertEqual(len(file["parameters/joined_from"].asstr()[()].splitlines()), 3)
        judged = self.run_command(["/usr/bin/python3", os.path.join(SOURCE, "tests/io/judge.py"), "run", "all.h5"])
        self.assertEqual(judged.returncode, 0, judged.stderr)

    def test_a_killed_run_and_what_went_on_from_its_last_checkpoint_overlap(self):
        parts = self.run_parts("CrashSk", (4,), 12, "--replicas", 2, "--feec", ranks=(1, 2))
        # What a killed run leaves that came to frame 8 + 3 and was saved last after 4 + 3.
        self.summary(2, "--scene", "CrashSk", "--replicas", 2, "--feec", "--frames", 8, "--output", "killed.h5")
        text = self.join("killed.h5", parts[1])
        self.assertIn("killed.h5: frames 0 to 10, 7 of them taken", text)
        self.assert_like_whole()
        with h5py.File(self.path("all.h5")) as file, h5py.File(self.path(parts[1])) as rest:
            np.testing.assert_array_equal(file["timings/frame/wall"][7:], rest["timings/frame/wall"][:])
        self.join("killed.h5", parts[0], parts[1])
        self.assert_like_whole()

    def test_a_run_that_was_killed_at_any_moment_is_joined_with_the_rest(self):
        args = ["--scene", "CrashSk", "--replicas", 8, "--record", "contacts"]
        process = self.start(2, *args, "--frames", 100000, "--output", "killed.h5", "--checkpoint", "ck.h5", "--checkpoint-every", 0.5)
        wait_until(lambda: os.path.exists(self.path("ck.h5")), "a checkpoint")
        time.sleep(0.8)
        for pid in rank_pids(process).values():
            os.kill(pid, signal.SIGKILL)
        process.wait()
        with h5py.File(self.path("killed.h5")) as file, h5py.File(self.path("ck.h5")) as saved:
            killed, saved = int(file.attrs["frames_committed"]), int(saved["parameters/frames_done"][()])
            self.assertGreater(len(file["timings/frame/wall"]), killed, "its datasets are longer than what was written")
        frames = max(killed, saved) + 5 - WARMUP
        self.summary(1, "--resume", "ck.h5", "--frames", frames, "--record", "contacts", "--output", "rest.h5")
        text = self.join("killed.h5", "rest.h5")
        self.assertIn(f"killed.h5: frames 0 to {killed - 1}, {saved} of them taken", text)
        self.summary(2, *args, "--frames", frames, "--output", "whole.h5")
        self.assert_like_whole()

    def test_joints_that_broke_in_frames_of_both_are_told_once(self):
        scene = self.write("sign.toml", SIGN)
        parts = self.run_parts(scene, (8,), 45, "--replicas", 3, ranks=(1, 2))
        self.summary(2, "--scene", scene, "--replicas", 3, "--frames", 30, "--output", "killed.h5")
        self.join("killed.h5", parts[1])
        self.assert_like_whole()
        broken = [row[0] for row in events_of_worlds(self.path("whole.h5"))]
        self.assertTrue(any(11 <= frame < 33 for frame in broken), "some broke in the frames of both")

    def test_an_interval_of_recording_must_go_on_where_it_stopped(self):
        parts = self.run_parts("CrashSk", (3,), 12, "--record-every", 3, ranks=(1, 1))
        self.join(*parts)
        self.assert_like_whole()
        parts = self.run_parts("CrashSk", (4,), 12, "--record-every", 3, ranks=(1, 1))
        self.refused("multiple", *parts)

    def test_the_parts_of_a_resumed_run_alone_begin_where_it_began(self):
        parts = self.run_parts("CrashSk", (3, 5), 9, ranks=(1, 1, 1))
        self.join(*parts[1:])
        with h5py.File(self.path("all.h5")) as file:
            self.assertEqual((file.attrs["first_frame"], file.attrs["frames_committed"]), (6, 6))
            self.assertEqual(file["parameters/resumed_from"].asstr()[()], "ck.h5")
        os.rename(self.path("all.h5"), self.path("rest.h5"))
        self.join("rest.h5", parts[0])
        self.assert_like_whole()
        with h5py.File(self.path("all.h5")) as file:
            self.assertEqual(len(file["parameters/joined_from"].asstr()[()].splitlines()), 4)

    def test_what_only_some_have_is_refused_or_left_out(self):
        args = ["--scene", "CrashSk", "--replicas", 2]
        self.summary(1, *args, "--frames", 9, "--output", "whole.h5")
        self.summary(1, *args, "--frames", 3, "--output", "a.h5", "--record", "contacts", "--checkpoint", "ck.h5")
        self.summary(1, "--resume", "ck.h5", "--frames", 9, "--output", "b.h5")
        self.refused("contacts/point", "a.h5", "b.h5")
        self.assertIn("left_out: /contacts/point", self.join("a.h5", "b.h5", "--common"))
        self.assert_like_whole()
        # The other way round the later part has more.
        self.summary(1, *args, "--frames", 3, "--output", "a.h5", "--checkpoint", "ck.h5")
        self.summary(1, "--resume", "ck.h5", "--frames", 9, "--record", "contacts", "--output", "b.h5")
        self.join("a.h5", "b.h5", "--common")
        self.assert_like_whole()

    def refused(self, words, *args):
        result = self.report("join", *args, "--output", "refused.h5")
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertIn(words, result.stderr)
        self.assertFalse([name for name in os.listdir(self.folder) if "refused" in name], "nothing is left behind")

    def test_refuses_gaps_foreign_files_and_frames_that_differ(self):
        parts = self.run_parts("CrashSk", (3, 5), 9, ranks=(1, 1, 1))
        self.refused("frames 6 to 7 are missing: part0.h5 ends before, part2.h5 begins behind", parts[0], parts[2])
        self.refused("two files or more", parts[0])
        self.refused("named twice", parts[0], parts[0])
        self.refused("cannot be opened", parts[0], self.write("text.h5", "text\n"))
        for words, args in (("seed is 1 in", ["--seed", 2]), ("iterations is", ["--iterations", 7]),
                            ("solver_seed is", ["--solver-seed", 9]), ("replicas is 1", ["--replicas", 2])):
            self.summary(1, "--scene", "CrashSk", "--frames", 9, "--output", "other.h5", *args)
            self.refused(words, parts[0], "other.h5")
        self.summary(1, "--scene", "Fight", "--frames", 9, "--output", "other.h5")
        self.refused("scene is CrashSk and Fight", parts[0], "other.h5")
        result = self.report("join", *parts, "--output", parts[0])
        self.assertEqual(result.returncode, 2)
        self.assertEqual(self.report("join", *parts).returncode, 2)

        # A frame of both with another last bit, whose row has the checksum that goes with it.
        with h5py.File(self.path("whole.h5"), "r+") as file:
            table, row = "observables.world.contacts", 7
            file["observables/world/energy"][row, 0] = np.nextafter(file["observables/world/energy"][row, 0], 1e9)
            columns = file["checksums"][table].attrs["columns"].decode().split()
            file["checksums"][table][row] = checksum(b"".join(file[name][row].tobytes() for name in columns))
        self.assertEqual(self.report("whole.h5").returncode, 0, "the checksum is right")
        self.refused("frame 7 is in whole.h5 and in part1.h5, and /observables/world/energy is not the same in both",
                     "whole.h5", parts[1])


if __name__ == "__main__":
    unittest.main()
