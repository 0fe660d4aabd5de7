"""Files of pbmpi and pbstudy."""

import os
from collections.abc import Sequence
from typing import Any, Optional, Union

from ._files import attributes_of, open_file, parameters_of, value
from ._parts import Part
from ._run import Run
from ._tables import whole_table

Path = Union[str, os.PathLike]


def read(path: Union[Path, Sequence[Path]], table: Optional[str] = None) -> Any:
    """A file of pbmpi as a Run, or a table of pbstudy as a pandas.DataFrame.

    path: the file; of a run that was saved and resumed all its files, in any order.
    table: of another file than a run's, which of its tables, e.g. "differences" of `pbstudy stability`; None: "cases". attrs
    of the table have "units" by column, "filetype", "attributes", "parameters" and "tables", all that there are.

    FileNotFoundError; ValueError for a file of another kind or layout, or files that are not of one run; ImportError without
    h5py or pandas.
    """
    paths = [os.fspath(path)] if isinstance(path, (str, os.PathLike)) else [os.fspath(one) for one in path]
    if not paths:
        raise ValueError("read: no file is named")
    for place, one in enumerate(paths):
        if any(os.path.exists(one) and os.path.exists(other) and os.path.samefile(one, other) for other in paths[:place]):
            raise ValueError(f"{one}: it is named twice; name each file once")
    files: list[Any] = []
    try:
        for one in paths:
            files.append(open_file(one))
        kinds = [value(file.attrs["filetype"]) for file in files]
        if all(kind == "pbmpi-run" for kind in kinds):
            if table is not None:
                raise ValueError(f"{paths[0]}: it is a run; table= is for other files, read(path).table({table!r}) for this")
            return Run([Part(one, file) for one, file in zip(paths, files)])
        if len(files) > 1:
            other = next(place for place, kind in enumerate(kinds) if kind != "pbmpi-run")
            raise ValueError(f"{paths[other]}: it is a {kinds[other]}; only files of one run are read together")
    except BaseException:
        for file in files:
            file.close()
        raise
    with files[0] as file:
        return _table_of(paths[0], file, kinds[0], table)


def _table_of(path: str, file: Any, kind: str, name: Optional[str]) -> Any:
    tables = [group for group in file if group != "parameters"]
    name = name or "cases"
    if name not in tables:
        raise ValueError(f"{path}: it has no table {name!r}; it has {', '.join(tables)}")
    table = whole_table(file[name], "row")
    table.attrs.update(filetype=kind, attributes=attributes_of(file), parameters=parameters_of(file), tables=tables)
    return table
