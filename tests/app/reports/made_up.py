"""Files that tests make up: runs with the columns that reports read."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

PHASES = ("collide", "islands", "rows", "solve", "integrate", "cross_space", "ship", "gather", "wait", "output")


def put(file, name, values):
    values = np.asarray(values)
    file[name] = values.astype("S") if values.dtype.kind == "U" else values


def write_run(path, ranks=1, worlds=2, committed=4, warmup=1, parameters=None, **columns):
    """A run of `committed` frames, the first `warmup` of which are not measured, and of one row that was not committed. Each phase of rank
    r in frame t takes t + r + 1 ms, and a frame 20 ms. `columns`: other datasets by their names, with __ for /."""
    frames = committed + 1
    settings = {"scene": "Fight", "stepper": "sor", "precision": "double", "decompose": "worlds", "steps_per_frame": 3, "frames": 3,
                "replicas": worlds, "build": "GNU", "simd": "none", "processors": 8, "num_spaces": 1} | (parameters or {})
    milliseconds = 1e-3 * (np.arange(frames)[:, None] + np.arange(ranks) + 1.0)
    found = {"ranks/host": ["a"] * ranks, "timings/frame/wall": np.full(frames, 0.02), "timings/frame/time": 0.03 * np.arange(frames),
             "timings/frame/measured": (np.arange(frames) >= warmup).astype("u1"),
             "observables/world/contacts": np.ones((frames, worlds), "i4"),
             "observables/world/islands": np.arange(frames * worlds, dtype="i4").reshape(frames, worlds)}
    found |= {f"timings/rank/{phase}": milliseconds for phase in (*PHASES, "messages", "bytes")}
    found |= {f"parameters/{name}": value for name, value in settings.items()}
    found |= {name.replace("__", "/"): values for name, values in columns.items()}
    with h5py.File(path, "w") as file:
        for name, values in found.items():
            put(file, name, values)
        texts = {"filetype": "pbmpi-run", "scene": settings["scene"], "created": "2026-01-01", "state_hash": "abc",
                 "pbmpi_version": "0.1.0"}
        file.attrs.update({name: np.bytes_(value) for name, value in texts.items()})
        file.attrs.update({"version": [1, 6], "frames_committed": committed, "record_every": 1, "complete": 1})
    return str(path)


class FilesTest(unittest.TestCase):
    """A test whose files lie in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = lambda name: str(pathlib.Path(folder.name) / name)

    def write(self, name, **others):
        """The path of a run, as write_run() makes it."""
        return write_run(self.path(name), **others)
