"""Opening the HDF5 files of pbmpi, and their attributes, texts and units."""

import os
from types import ModuleType
from typing import Any

import numpy as np

# First number of the layouts that are understood (io/SCHEMA.md), by filetype.
LAYOUTS = {"pbmpi-run": 1, "pbmpi-study": 1}


def needed(module: str, package: str) -> ModuleType:
    """A module that only a part of pbmpi needs. ImportError with what to install."""
    try:
        return __import__(module)
    except ImportError as error:
        raise ImportError(f"pbmpi: this needs {module}, which is not there; install it (Debian: {package})") from error


def open_file(path: Any) -> Any:
    """An h5py.File of pbmpi, open for reading. FileNotFoundError, or ValueError for what is no such file."""
    h5py = needed("h5py", "python3-h5py")
    path = os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(f"{path}: no such file")
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise ValueError(f"{path}: it is no HDF5 file, or is damaged ({error})") from error
    kind = value(file.attrs.get("filetype", ""))
    major = int(np.ravel(file.attrs.get("version", [0]))[0])
    if kind == "pbmpi-checkpoint":
        file.close()
        raise ValueError(f"{path}: it is a checkpoint, for `pbmpi --resume {path}`; read the file of the run")
    if kind not in LAYOUTS:
        file.close()
        raise ValueError(f"{path}: it is no file of pbmpi or pbstudy: its attribute filetype is {kind!r}")
    if major != LAYOUTS[kind]:
        file.close()
        raise ValueError(f"{path}: its layout has version {major}.x, and this pbmpi reads {LAYOUTS[kind]}.x; use a pbmpi of the "
                         "version that wrote it")
    return file


def value(stored: Any) -> Any:
    """A scalar or short array of the file as Python's own: text without padding, numbers, lists of these."""
    if isinstance(stored, np.ndarray):
        return [value(item) for item in stored.tolist()] if stored.shape else value(stored[()])
    if isinstance(stored, bytes):
        return stored.rstrip(b"\0").decode("utf-8", "replace").strip()
    return stored.item() if isinstance(stored, np.generic) else stored


def attributes_of(file: Any) -> dict[str, Any]:
    return {name: value(file.attrs[name]) for name in sorted(file.attrs)}


def parameters_of(file: Any) -> dict[str, Any]:
    group = file.get("parameters", {})
    return {name: value(group[name][()]) for name in sorted(group)}


def unit_of(dataset: Any) -> str:
    """Unit as in io/SCHEMA.md, e.g. "m s-1"; empty for a count or a text."""
    return value(dataset.attrs.get("unit", ""))


def texts(stored: np.ndarray) -> np.ndarray:
    """Rows of a column; texts as str."""
    if stored.dtype.kind != "S":
        return stored
    return np.char.decode(stored, "utf-8").astype(object).reshape(stored.shape)
