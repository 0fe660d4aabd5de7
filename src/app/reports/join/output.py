"""What HDF5 writes a file to."""
import io
import os

from reports.files import WriteError


class Output(io.RawIOBase):
    """The file `path`, empty until now. HDF5 never hears of a write that failed: it would try again when the file is closed, and crash as the library
    ends. The first failure is remembered, and nothing is written after it; what is behind the end reads as zeros."""

    def __init__(self, path):
        super().__init__()
        self._file = open(path, "r+b", buffering=0)  # pylint: disable=consider-using-with
        self._error, self._place, self._end = None, 0, 0

    def seek(self, offset, whence=os.SEEK_SET):
        self._place = offset + (self._end if whence == os.SEEK_END else 0)
        return self._place

    def tell(self):
        return self._place

    def readinto(self, buffer):
        found = os.pread(self._file.fileno(), len(buffer), self._place)
        buffer[:] = found.ljust(len(buffer), b"\0")
        return len(buffer)

    def write(self, data):
        rest = memoryview(data).cast("B")
        self._place += len(rest)
        self._end = max(self._end, self._place)
        try:
            while self._error is None and len(rest) > 0:
                rest = rest[os.pwrite(self._file.fileno(), rest, self._place - len(rest)):]
        except OSError as error:
            self._error = error
        return len(data)

    def truncate(self, size=None):
        self._end = size
        try:
            os.ftruncate(self._file.fileno(), size)
        except OSError as error:
            self._error = self._error or error
        return size

    def finish(self, name):
        """Closes the file. Raises WriteError, with the name that it was to get, if a write failed."""
        self._file.close()
        if self._error:
            raise WriteError(f"cannot write {name}: {self._error.strerror}")
