"""Worlds that are stepped together."""

import copy
import operator
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from . import _pbmpi
from ._text import parameter_texts, settings_text

# Arguments of a batch that are no options of a step.
MADE_FROM = ("scene", "worlds", "seed", "parameters", "scene_text")
STATE_ARRAYS = ("position", "orientation", "velocity", "angular_velocity")


class Batch(_pbmpi.Batch):
    """Many worlds of one scene, stepped together.

    scene: name of a scene that pbmpi brings ("CrashSk"; `pbmpi --list-scenes`), or path of a file: .toml
    (scenes/FORMAT.md), .xml (MJCF) or .urdf.
    worlds: how many, of all ranks together; None: as the scene has it.
    seed: 0 to 2**64 - 1, from which each world draws what varies.
    parameters: what each world has otherwise than the scene, one dict a world ({"car.speed": 12.5, "world.gravity":
    [0, 0, -1.62]}; None: nothing), or a dict of columns with a value a world ({"car.speed": [12.5, 13]}). Keys are
    "ACTOR.KEY", "JOINT.KEY" or "world.KEY" of a scene file.
    communicator: an mpi4py communicator over whose ranks the worlds are dealt out in blocks; None: one process, no MPI.
    Batches are then made, and hash() is called, by all its ranks in the same order.
    scene_text: text of a scene file instead of one that is read; `scene` then only names it.
    settings: options of a step by pbmpi's names with "_" for "-": dt [s], stepper, precision, substeps, iterations,
    threads, effects ({"friction": False} or "-friction"), ... What is not named is as pbmpi has it by default.

    position, orientation, velocity and angular_velocity are numpy arrays [worlds][bodies][k] of this rank's worlds, in
    the order of world_ids and body_names. They are read-only views of the batch's own arrays, without a copy, and keep
    the batch alive. The steppers hold worlds side by side in vector lanes; the one copy that puts them in order is made when
    a property is read for the first time after step(), reset(), load() or set_state(), for all four arrays. A view that was
    taken before stays at the same memory: it shows the older state until then, and the newer one from then on. Where
    an older state is to be kept, copy it: batch.position.copy().

    A world's bits depend on scene, seed, parameters, settings and step alone: not on other worlds, ranks or threads.
    Several Python threads may use a batch: calls wait for each other, those that take long without the interpreter's lock.
    A batch without communicator can be copied (copy.deepcopy) and pickled: scene, settings, and what save() gives.

    ValueError for bad input, with what, where and what to do; RuntimeError for a run that fails; TypeError for arguments of
    another type; ImportError for a communicator without mpi4py.
    """

    def __init__(self, scene: str, worlds: Optional[int] = None, *, seed: int = 1, parameters: Any = None,
                 communicator: Any = None, scene_text: Optional[str] = None, **settings: Any) -> None:
        num_worlds = 0 if worlds is None else operator.index(worlds)
        if worlds is not None and num_worlds < 1:
            raise ValueError(f"worlds={worlds}: there must be at least 1")
        # Parameters, too: a copy begins with the bodies that these gave the worlds.
        self._arguments: dict[str, Any] = {"scene": str(scene), "worlds": worlds, "seed": _seed(seed),
                                           "parameters": copy.deepcopy(parameters), "scene_text": scene_text, **settings}
        self._has_ranks = communicator is not None
        super().__init__(str(scene), scene_text or "", num_worlds, _seed(seed), settings_text(settings),
                         parameter_texts(parameters, num_worlds), _handle(communicator))

    @property
    def seed(self) -> int:
        """With which the batch was made."""
        return self._arguments["seed"]

    @property
    def settings(self) -> dict[str, Any]:
        """Options of a step as they were given; others are as pbmpi has them by default."""
        return {name: value for name, value in self._arguments.items() if name not in MADE_FROM}

    def reset(self, mask: Any = None, seed: Optional[int] = None, parameters: Any = None) -> None:
        """Begins worlds anew at step 0, bit for bit as a new batch; the others go on.

        mask: [worlds] bools, which of this rank's worlds; None: all.
        seed: from which they draw now; None: that with which the batch was made.
        parameters: what each of this rank's worlds has otherwise than the scene from now on, as of Batch; entries of worlds
        outside of the mask are passed over. None: what it had.
        ValueError and TypeError as of Batch; nothing is then changed.
        """
        self._reset(mask, self.seed if seed is None else _seed(seed), parameter_texts(parameters, self.num_local_worlds))

    def state(self) -> dict[str, np.ndarray]:
        """position, orientation, velocity and angular_velocity as copies: set_state(**state) puts them back."""
        return {name: getattr(self, name).copy() for name in STATE_ARRAYS}

    def observables(self) -> dict[str, np.ndarray]:
        """All that observable() knows, by name: [worlds], or [worlds][3] of vectors, after the last step."""
        return {name: self.observable(name) for name in self.observable_names}

    def __repr__(self) -> str:
        scene = self._arguments["scene"]
        worlds = f"worlds={self.num_worlds}"
        if self._has_ranks:
            worlds += f" ({self.num_local_worlds} of this rank)"
        settings = "".join(f", {name}={value!r}" for name, value in self.settings.items())
        return f"<pbmpi.Batch {scene!r} {worlds} bodies={self.num_bodies} dt={self.dt:g} seed={self.seed}{settings}>"

    def __reduce__(self) -> tuple:
        if self._has_ranks:
            raise TypeError("a batch with a communicator cannot be pickled or copied: each rank has a part of it. "
                            "Store what save() gives, rank by rank")
        return _restored, (type(self), self._arguments, self.save())


def _restored(kind: type, arguments: Mapping[str, Any], saved: bytes) -> Batch:
    batch = kind(**arguments)
    batch.load(saved)
    return batch


def _seed(seed: Any) -> int:
    number = operator.index(seed)
    if not 0 <= number < 2**64:
        raise ValueError(f"seed={seed}: it must be 0 to 2**64 - 1")
    return number


def _handle(communicator: Any) -> Optional[int]:
    """The Fortran handle of an mpi4py communicator."""
    if communicator is None:
        return None
    try:
        from mpi4py import MPI
    except ImportError as error:
        raise ImportError("communicator: it takes mpi4py, which is not there; install it (Debian: python3-mpi4py), or leave "
                          "the communicator out") from error
    if not isinstance(communicator, MPI.Comm):
        raise TypeError(f"communicator: it is a {type(communicator).__name__}; it must be one of mpi4py, e.g. MPI.COMM_WORLD")
    if communicator == MPI.COMM_NULL:
        raise ValueError("communicator: it is MPI.COMM_NULL, to which this rank does not belong; make a batch on its ranks only")
    return communicator.py2f()
