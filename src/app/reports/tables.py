"""Tables of numbers and texts with units: what JSON, CSV and HDF5 have of a report."""
from typing import NamedTuple


class Values(NamedTuple):
    """A column: an int, a float or a text for each row."""
    name: str
    unit: str
    values: list


def columns_of(rows, *fields):
    """Columns from rows of any kind. `fields`: (name, unit, callable(row))."""
    return [Values(name, unit, [value(row) for row in rows]) for name, unit, value in fields]


def json_of(tables):
    """`tables`: columns by name; in the order of the alphabet, as HDF5 lists them."""
    return {name: {column.name: column.values for column in tables[name]} for name in sorted(tables)}


def csv_of(columns):
    """For document.csv(), with units in the names: "time [s]"."""
    return {f"{column.name} [{column.unit}]" if column.unit else column.name: column.values for column in columns}
