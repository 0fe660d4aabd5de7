"""Groups of a pbmpi file as pandas tables."""

import math
from typing import Any, Iterable, Optional

import numpy as np

from ._files import needed, texts, unit_of

# What the components of a row are called, by their number.
COMPONENTS = {2: ("1", "2"), 3: ("x", "y", "z"), 4: ("w", "x", "y", "z"), 9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")}


def columns_of(group: Any) -> dict[str, Any]:
    """The datasets of a group by name, without its groups."""
    return {name: item for name, item in group.items() if hasattr(item, "shape")}


def table_of(columns: Iterable[tuple[str, np.ndarray, str]], index_names: list[str], first_frame: Optional[int] = None) -> Any:
    """A pandas.DataFrame of (name, values, units), with a level of the index for each of the first dimensions of the values; what
    is behind these becomes columns of its own (position_x, ...). The first level counts from `first_frame`.

    attrs["units"] has the units by column. ValueError for columns of different lengths.
    """
    pandas = needed("pandas", "python3-pandas")
    num_levels, data, units, sizes = len(index_names), {}, {}, None
    for name, values, unit in columns:
        sizes = values.shape[:num_levels] if sizes is None else sizes
        if values.shape[:num_levels] != sizes:
            raise ValueError(f"{name}: it is {values.shape} long, and columns before it {sizes}: they make no table; read each for "
                             "itself")
        rest = values.shape[num_levels:]
        number = math.prod(rest)
        flat = texts(values.reshape(math.prod(sizes), number))
        endings = [f"_{ending}" for ending in COMPONENTS.get(number, range(number))] if rest else [""]
        for place, ending in enumerate(endings):
            data[name + ending], units[name + ending] = flat[:, place], unit
    sizes = sizes or (0,) * num_levels
    levels = [range(size) for size in sizes]
    if first_frame is not None:
        levels[0] = range(first_frame, first_frame + sizes[0])
    if num_levels == 1:
        index = pandas.Index(levels[0], name=index_names[0])
    else:
        index = pandas.MultiIndex.from_product(levels, names=index_names)
    table = pandas.DataFrame(data, index=index)
    table.attrs["units"] = units
    return table


def whole_table(group: Any, index_name: str) -> Any:
    """All rows of a group with a row an item."""
    return table_of(((name, item[:], unit_of(item)) for name, item in columns_of(group).items()), [index_name])


def joined(tables: list[Any]) -> Any:
    """Tables with the same columns, one after the other."""
    pandas = needed("pandas", "python3-pandas")
    table = pandas.concat(tables) if len(tables) > 1 else tables[0]
    table.attrs["units"] = {name: unit for one in tables for name, unit in one.attrs["units"].items()}
    return table
