"""Rows that lie in one or several files, read as they are asked for."""

from typing import Any, Iterator, NamedTuple, Optional

import numpy as np


class Piece(NamedTuple):
    """Rows [begin, begin + length) of an h5py dataset."""

    dataset: Any
    begin: int
    length: int


class Rows:
    """An array whose first dimension is frames, read from its files as it is indexed, as numpy arrays are.

    rows[10], rows[-1, 3], rows[::10], rows[:, bodies] and rows[rows_wanted] read what they need; rows[:] or
    numpy.asarray(rows) all. `shape`, `dtype`, and `units` as in io/SCHEMA.md ("m s-1"). IndexError as of numpy.
    """

    def __init__(self, name: str, pieces: list[Piece], units: str) -> None:
        tails = {piece.dataset.shape[1:] for piece in pieces}
        if len(tails) != 1:
            raise ValueError(f"{name}: rows are {' and '.join(map(str, sorted(tails)))} long in the files that are joined; read "
                             "the files one by one")
        self.name = name
        self.units = units
        self.dtype: np.dtype = pieces[0].dataset.dtype
        self._pieces = pieces
        self.shape: tuple[int, ...] = (sum(piece.length for piece in pieces), *tails.pop())

    @property
    def ndim(self) -> int:
        return len(self.shape)

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator[np.ndarray]:
        return (self[row] for row in range(len(self)))

    def __repr__(self) -> str:
        return f"<pbmpi rows of {self.name} {self.shape} {self.dtype}{' ' if self.units else ''}{self.units}>"

    def __array__(self, dtype: Optional[np.dtype] = None) -> np.ndarray:
        return self[:] if dtype is None else self[:].astype(dtype)

    def __getitem__(self, key: Any) -> np.ndarray:
        first, *rest = self._expanded(key)
        simple = all(isinstance(item, (int, np.integer)) or isinstance(item, slice) and (item.step or 1) > 0 for item in rest)
        part = tuple(rest) if simple else ()
        if isinstance(first, (int, np.integer)):
            rows = self._row(int(first), part)
            return rows if simple else rows[tuple(rest)]
        if isinstance(first, slice):
            rows, place = self._slice(first, part), slice(None)
        else:
            rows = self._chosen(np.asarray(first), part)
            place = np.arange(len(rows))  # a list of rows goes pair by pair with a list behind it
        return rows if simple else rows[(place, *rest)]

    def _expanded(self, key: Any) -> tuple:
        """The key without an ellipsis."""
        key = key if isinstance(key, tuple) else (key,)
        at = [place for place, item in enumerate(key) if item is Ellipsis]
        indexed = sum(item is not None and item is not Ellipsis for item in key)  # None adds a dimension
        if at:
            key = key[:at[0]] + (slice(None),) * (self.ndim - indexed) + key[at[0] + 1:]
        if indexed > self.ndim:
            raise IndexError(f"{self.name}: it has {self.ndim} dimensions, and {indexed} were indexed")
        return key or (slice(None),)

    def _row(self, row: int, rest: tuple) -> np.ndarray:
        place = row + len(self) if row < 0 else row
        if not 0 <= place < len(self):
            raise IndexError(f"{self.name}: there is no row {row}; it has {len(self)}")
        for piece in self._pieces:
            if place < piece.length:
                return piece.dataset[(piece.begin + place, *rest)]
            place -= piece.length
        raise AssertionError("the pieces make up all rows")

    def _slice(self, wanted: slice, rest: tuple) -> np.ndarray:
        rows = range(*wanted.indices(len(self)))
        if rows.step < 0:
            return self._stepped(rows[::-1], rest)[::-1]
        return self._stepped(rows, rest)

    def _stepped(self, rows: range, rest: tuple) -> np.ndarray:
        """Rows of a range that goes up."""
        parts, before = [], 0
        for piece in self._pieces:
            first = max(rows.start, before + (rows.start - before) % rows.step)
            stop = min(rows.stop, before + piece.length)
            if first < stop:
                shift = piece.begin - before
                parts.append(piece.dataset[(slice(first + shift, stop + shift, rows.step), *rest)])
            before += piece.length
        if not parts:
            return self._pieces[0].dataset[(slice(0, 0), *rest)]
        return parts[0] if len(parts) == 1 else np.concatenate(parts)

    def _chosen(self, rows: np.ndarray, rest: tuple) -> np.ndarray:
        """Rows by their numbers, or by a bool each."""
        if rows.dtype.kind == "b":
            if rows.shape != (len(self),):
                raise IndexError(f"{self.name}: a mask of shape {rows.shape} does not choose from {len(self)} rows")
            rows = np.flatnonzero(rows)
        if rows.size == 0:
            return self._slice(slice(0, 0), rest)
        return np.stack([self._row(int(row), rest) for row in rows])
