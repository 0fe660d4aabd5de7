"""Writes the study's file, with a seal, as pbstudy writes its own (io/SCHEMA.md)."""
import os

import h5py
import numpy as np

from reports import files
from reports.files import require, text_of


def stored(values):
    """The array that HDF5 files have of a column's values: int64, float64, or texts of fixed length."""
    if isinstance(values, list) and all(isinstance(value, str) for value in values):
        return fixed_text(values)
    values = np.asarray(values)
    return values.astype(np.float64 if values.dtype.kind == "f" else np.int64)


def fixed_text(texts):
    """Texts of fixed length in UTF-8, padded with NUL, as all files of pbmpi have them."""
    encoded = [text.encode("utf-8", "replace") for text in texts]
    return np.array(encoded, dtype=h5py.string_dtype("utf-8", max([1, *map(len, encoded)])))


def image_of(filetype, version, attributes, parameters, tables):
    """The bytes of an HDF5 file (io/SCHEMA.md). `version`: (major, minor) of its layout; `attributes`: texts by name; `parameters`: texts or
    numbers."""
    with h5py.File("in memory", "w", driver="core", backing_store=False) as file:
        for name, text in {"filetype": filetype, **attributes}.items():
            value = fixed_text([text])
            file.attrs.create(name, value[0], dtype=value.dtype)
        file.attrs["version"] = np.array(version, dtype=np.int64)
        for name, value in parameters.items():
            one = stored([value])
            file.create_dataset(f"parameters/{name}", data=one[0], dtype=one.dtype)
        for table, columns in tables.items():
            for column in columns:
                dataset = file.create_dataset(f"{table}/{column.name}", data=stored(column.values))
                if column.unit:
                    dataset.attrs["unit"] = np.bytes_(column.unit)  # in ASCII, as H5MD's module of units requires
        file.flush()
        return file.id.get_file_image()


def require_replaceable(path, filetype):
    """An HDF5 file replaces only one of its own type: any other file may be somebody's data."""
    target = os.path.realpath(path)
    require(not path.endswith("/") and files.own_output(path) is None, f"cannot create {path}: it is not a regular file; give another name")
    if not os.path.exists(target):
        folder = os.path.dirname(target)
        require(os.path.isdir(folder), f"cannot create {path}: there is no directory {folder}; make it first or give another name")
        require(os.access(folder, os.W_OK), f"cannot create {path}: Permission denied; "
                                            "give the name of a file in a directory you can write to")
        return
    require(not os.path.isdir(target), f"cannot create {path}: it is a directory; give the name of a file")
    require(os.path.isfile(target), f"cannot create {path}: it is not a regular file; give another name")
    require(os.access(target, os.W_OK), f"cannot create {path}: Permission denied; give another name or make it writable")
    if os.path.getsize(target) > 0:
        require(h5py.is_hdf5(target), f"cannot create {path}: it is there, and no HDF5 file; give another name, or remove it first")
        found = filetype_of(target)
        what = f"is of type {found}" if found else "has no readable attribute filetype"
        require(found == filetype, f"cannot create {path}: an HDF5 file is there that {what}, which one of type {filetype} would replace; "
                                   "give another name, or remove it first")


def filetype_of(path):
    """Empty for a file that cannot be read, or has none."""
    try:
        with h5py.File(path, "r", locking=False) as file:
            return text_of(file.attrs.get("filetype", b""))
    except (OSError, RuntimeError, KeyError):  # of which h5py raises one or the other where a file is damaged
        return ""


def seal_of(data):
    """What follows the bytes of a file that is written whole, so that later changes are noticed (src/core/system/seal.h)."""
    value, words = 0x9e3779b97f4a7c15, np.frombuffer(data + bytes(-len(data) % 8), "<u8").tolist()
    if len(data) % 8 == 0:
        words.append(0)
    for word in (*words, len(data)):
        value = (value ^ word) * 0x100000001b3 % 2 ** 64
        value ^= value >> 32
    return b"PBMPISUM" + len(data).to_bytes(8, "little") + value.to_bytes(8, "little")


def write_tables(path, filetype, *content):
    """`content`: as image_of() takes it. The file gets its name once it is complete."""
    require_replaceable(path, filetype)  # once more: it may have been made meanwhile
    target = os.path.realpath(path)
    mode = os.stat(target).st_mode & 0o7777 if os.path.exists(target) else None
    try:
        image = image_of(filetype, *content)
        files.replace(target, [image, seal_of(image)], mode)
    except OSError as error:
        raise files.refusal_of(error, f"{path}: it cannot be written") from None
