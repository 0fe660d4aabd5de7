"""Tables of numbers and texts with units, as JSON and CSV have them."""
from typing import NamedTuple

import numpy as np


class Values(NamedTuple):
    """A column: for each row a number or a text. `values`: a list, or an array of numbers."""
    name: str
    unit: str
    values: object

    def listed(self):
        return self.values.tolist() if isinstance(self.values, np.ndarray) else self.values


def columns_of(rows, *fields):
    """Columns from rows of any kind. `fields`: (name, unit, callable(row))."""
    return [Values(name, unit, [value(row) for row in rows]) for name, unit, value in fields]


def json_of(tables):
    """`tables`: columns by name; in the order of the alphabet."""
    return {name: {column.name: column.listed() for column in tables[name]} for name in sorted(tables)}


def csv_of(columns):
    """For document.csv(), with units in the names: "time [s]"."""
    return {f"{column.name} [{column.unit}]" if column.unit else column.name: column.listed() for column in columns}
