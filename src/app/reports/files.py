"""Reads the files of pbmpi and pbstudy, and writes what a report leaves behind."""
import contextlib
import dataclasses
import errno
import os
import pathlib
import signal
import stat
import tempfile
import time

import h5py
import numpy as np

from reports.words import short

RUN, STUDY = "pbmpi-run", "pbmpi-study"


class BadInput(Exception):
    """What is wrong, where, and what to do. Ends the program with exit code 2."""


class WriteError(Exception):
    """The system takes no more of an output, e.g. on a full disk. Ends the program with exit code 1."""


def require(holds, message):
    if not holds:
        raise BadInput(message)


def text_of(value):
    """An attribute or a parameter as text; several numbers with dots between them, as in a version."""
    if isinstance(value, np.ndarray):
        return ".".join(map(text_of, np.ravel(value).tolist()))
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else short(value)


def open_file(path, filetype):
    """The HDF5 file, open for reading, also while a run still writes it."""
    for refused, reason in ((not os.path.exists(path), "there is no such file"), (os.path.isdir(path), "it is a directory"),
                            (not os.path.isfile(path), "it is a pipe or a device")):
        require(not refused, f"{path}: cannot be read: {reason}; give the name of a file that pbmpi has written")
    try:
        file = h5py.File(path, "r", locking=False)
    except OSError as error:
        raise BadInput(f"{path}: cannot be opened as an HDF5 file ({error}); give a file that pbmpi has written") from None
    found = f'"{text_of(file.attrs["filetype"])}"' if "filetype" in file.attrs else "missing"
    name, writer = ("pbmpi run", "pbmpi") if filetype == RUN else (filetype, "pbstudy")
    require(found == f'"{filetype}"', f"{path}: not a {name} (its attribute filetype is {found}); give a file that {writer} has written")
    version = text_of(file.attrs.get("version", b"unknown"))
    require(version.split(".")[0] == "1", f"{path}: its layout has version {version}, this program reads version 1.x; "
                                          "use the pbmpi that wrote it")
    return file


def column_of(dataset):
    """A column as a list with one entry a row; rows of several numbers are lists."""
    values = dataset[()]
    return [text_of(value) for value in values] if values.dtype.kind in "SO" else values.tolist()


class Row:
    """A row of a table; its columns are attributes. `row.get(name, default)` for those that older files lack."""

    def __init__(self, columns, index):
        self._columns, self._index = columns, index

    def __getattr__(self, name):
        if name not in self._columns:
            raise BadInput(f"the file has no column '{name}', as files of older versions; use the pbreport of the version that wrote it, or run it again")
        return self._columns[name][self._index]

    def get(self, name, default=None):
        return getattr(self, name) if name in self._columns else default


@dataclasses.dataclass
class Study:
    """The file of a study: attributes and parameters as text, tables by name and column."""
    path: str
    attributes: dict
    parameters: dict
    tables: dict

    def rows(self, table="cases"):
        columns = self.tables.get(table, {})
        return [Row(columns, index) for index in range(len(next(iter(columns.values()), [])))]

    def texts(self):
        """[(name, text)] of all that says what the file was made from."""
        return [*self.attributes.items(), *self.parameters.items()]


def read_study(path, kind):
    """Raises BadInput for anything but a study of this kind. pbreport has checked the file's seal."""
    with open_file(path, STUDY) as file:
        found = text_of(file.attrs.get("study", b"accuracy"))  # the first version did not say it
        other = "study" if found == "accuracy" else found
        require(found == kind, f"{path}: a study of {found}, not of {kind}; try pbreport {other}")
        attributes = {name: text_of(value) for name, value in sorted(file.attrs.items())}
        parameters = {name: text_of(value[()]) for name, value in file.get("parameters", {}).items()}
        tables = {name: {column: column_of(values) for column, values in group.items()}
                  for name, group in file.items() if name != "parameters" and isinstance(group, h5py.Group)}
    return Study(path, attributes, parameters, tables)


def in_order_of(names, items, name_of, what="the study"):
    """The items named, in the order of `names`; all, where none are. Raises BadInput for a name that no item has."""
    if not names:
        return items
    known = ", ".join(dict.fromkeys(map(name_of, items)))
    for name in names:
        require(any(name_of(item) == name for item in items), f"--scene {name}: {what} has {known}")
    return [item for name in names for item in items if name_of(item) == name]


def own_output(path):
    """The descriptor, 1 or 2, if it is what this program prints to: /dev/stdout, or the file that a shell has opened for it; else None."""
    def same(number):
        try:
            return os.path.samestat(os.stat(path), os.fstat(number))
        except OSError:
            return False

    return next((number for number in (1, 2) if same(number)), None)


DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.ESTALE)  # not the fault of a path


def refusal_of(error, what):
    """What to raise for an OSError of writing."""
    return (WriteError if error.errno in DISK_ERRORS else BadInput)(f"{what}: {error.strerror}")


def open_stream(path):
    """A descriptor for writing to a device or a pipe. A pipe that nobody opens for reading would make this program wait for ever; its reader may
    start a little later."""
    for _ in range(100):
        with contextlib.suppress(OSError):
            descriptor = os.open(path, os.O_WRONLY | os.O_NONBLOCK)
            os.set_blocking(descriptor, True)
            return descriptor
        if not stat.S_ISFIFO(os.stat(path).st_mode):
            return os.open(path, os.O_WRONLY)
        time.sleep(0.05)
    raise BadInput(f"{path}: it cannot be written: nobody reads from this pipe")


def write_file(path, text):
    """Puts the text, or all parts of one, under the name `path` in one go, keeping the permissions of an old file, which must not be HDF5:
    that may be somebody's data. Devices, pipes and this program's own output are written to directly. Raises BadInput for a path that cannot be
    written to, WriteError where a write fails."""
    data = (part.encode("utf-8", "replace") for part in ([text] if isinstance(text, str) else text))
    try:
        require(not os.path.isdir(path) and not path.endswith("/"), f"{path}: it is a folder; name a file to write")
        require(not pathlib.Path(path).is_block_device(), f"{path}: it is a block device, whose content a file would overwrite; name a file to write")
        number = own_output(path)
        if number is not None or (os.path.exists(path) and not os.path.isfile(path)):
            with open(open_stream(path) if number is None else number, "wb", closefd=number is None) as stream:
                stream.writelines(data)
            return
        target, mode = os.path.realpath(path), None
        require(not os.path.islink(target), f"{path}: it cannot be written: it is a link that leads back to itself")
        if os.path.exists(target):
            require(not h5py.is_hdf5(target), f"{path}: it is an HDF5 file, which a text does not replace; name another file")
            require(os.access(target, os.W_OK), f"{path}: it cannot be written: Permission denied")
            mode = os.stat(target).st_mode & 0o7777
        replace(target, data, mode)
    except OSError as error:
        raise refusal_of(error, f"{path}: it cannot be written") from None


unfinished = set()  # names of files that are being written


def end_without_leftovers(number, _frame=None):
    """Ends this process as the signal does by default, and removes what it was writing."""
    for path in unfinished:
        with contextlib.suppress(OSError):
            os.unlink(path)
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)


def replace(target, data, mode):
    """Writes parts of bytes beside the target and renames, so that a kill leaves the old file or the new one."""
    if mode is None:
        mode = 0o666 & ~current_umask()
    folder, name = os.path.split(target)
    descriptor, temporary = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
    unfinished.add(temporary)
    try:
        with open(descriptor, "wb") as stream:
            stream.writelines(data)
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(temporary, mode)
        os.replace(temporary, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise
    finally:
        unfinished.discard(temporary)


def current_umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
