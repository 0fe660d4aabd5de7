"""What reports read of files of runs, and which they refuse."""
import pathlib
import sys
import unittest

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "src/app"))
import made_up  # noqa: E402
from reports import runs  # noqa: E402
from reports.files import BadInput  # noqa: E402
from reports.runs import Run  # noqa: E402


class Files(made_up.FilesTest):
    def refused(self, words, path):
        with self.assertRaises(BadInput) as caught:
            Run(path)
        self.assertIn(words, str(caught.exception))
        self.assertTrue(str(caught.exception).startswith(path))


class Reading(Files):
    def test_committed_rows_alone_are_read(self):
        run = Run(self.write("run.h5", ranks=2, worlds=3))
        self.assertEqual((run.num_frames, run.num_recorded, run.num_ranks, run.num_worlds, run.first_frame), (4, 4, 2, 3, 0))
        self.assertEqual(run.measured.tolist(), [False, True, True, True])
        self.assertEqual(run.frames("observables/world/islands").shape, (4, 3))
        self.assertEqual(run.frames("observables/world/islands", slice(1, None, 2))[:, 0].tolist(), [3, 9])
        np.testing.assert_allclose(run.of_ranks("solve"), 1e-3 * np.array([[2, 3], [3, 4], [4, 5]]))

    def test_a_frame_in_two_is_recorded(self):
        path = self.write("run.h5", particles__bodies__position__value=np.zeros((3, 5, 3)), particles__bodies__name=["x"] * 5)
        with h5py.File(path, "a") as file:
            file.attrs["record_every"] = 2
        run = Run(path)
        self.assertEqual(run.recorded("particles/bodies/position/value").shape, (2, 5, 3))
        self.assertEqual(run.column("particles/bodies/name"), ["x"] * 5)

    def test_settings_are_texts(self):
        run = Run(self.write("run.h5", parameters={"dt": 1e-4, "seed": 7, "effects": ""}))
        self.assertEqual([run.parameter(name) for name in ("dt", "seed", "effects", "absent")], ["1e-04", "7", "", ""])
        self.assertEqual((run.number("dt"), run.number("absent", 3), run.attributes["version"]), (1e-4, 3, "1.6"))
        with self.assertRaisesRegex(BadInput, "no number 'effects'"):
            run.number("effects")

    def test_a_run_that_was_cut_off_has_no_hash(self):
        path = self.write("run.h5")
        with h5py.File(path, "a") as file:
            file.attrs.update({"state_hash": np.bytes_(" " * 16), "complete": 0})
        run = Run(path)
        self.assertEqual((run.state_hash, run.complete), ("none (the run was cut off)", False))

    def test_what_is_no_sound_run_is_refused(self):
        self.refused("there is no such file", self.path("absent.h5"))
        self.refused("it is a directory", self.path(""))
        pathlib.Path(self.path("text.h5")).write_text("no run", encoding="utf-8")
        self.refused("cannot be opened as an HDF5 file", self.path("text.h5"))
        with h5py.File(self.path("study.h5"), "w") as file:
            file.attrs["filetype"] = np.bytes_("pbmpi-study")
        self.refused('not a pbmpi run (its attribute filetype is "pbmpi-study")', self.path("study.h5"))
        for name, change, words in (
                ("new.h5", lambda file: file.attrs.modify("version", [2, 0]), "its layout has version 2.0, this program reads version 1.x"),
                ("bare.h5", lambda file: file.attrs.pop("frames_committed"), "attribute frames_committed"),
                ("every.h5", lambda file: file.attrs.modify("record_every", 0), "impossible root attributes"),
                ("short.h5", lambda file: file.attrs.modify("frames_committed", 9), "has 5 rows, not 9"),
                ("part.h5", lambda file: file.pop("ranks"), "/ranks/host is missing")):
            with h5py.File(self.write(name), "a") as file:
                change(file)
            self.refused(words, self.path(name))


class Settings(Files):
    def test_parameters_matter_for_results_samples_estimates_or_nothing(self):
        for name, matters in (("iterations", runs.RESULTS), ("seed", runs.SEED), ("estimate_iterations", runs.ESTIMATE), ("feec", runs.ESTIMATE),
                              ("ranks", runs.NOTHING), ("env_OMP_NUM_THREADS", runs.NOTHING)):
            self.assertEqual(runs.matters_for(name), matters, name)

    def test_differences_have_words(self):
        one = Run(self.write("a.h5", parameters={"iterations": 20, "scene_text": "x\ny", "ranks": 1}))
        other = Run(self.write("b.h5", parameters={"iterations": 10, "scene_text": "x\nz", "ranks": 2, "dt": 0.5}))
        found = [runs.difference_text(each, one, other) for each in runs.differences(one, other, runs.RESULTS)]
        self.assertEqual(found, [f"dt is (none) in {one.path} and 0.5 in {other.path}",
                                 f"iterations is 20 in {one.path} and 10 in {other.path}",
                                 f"scene_text is not the same in {one.path} and {other.path}"])


if __name__ == "__main__":
    unittest.main()
