"""Tables of contact problems that Siconos solves again: `jobs/siconos.sh`."""
import functools
import json
import os
import pathlib
import sys

from tables import programs

# OUTDIR of a call that is there already: it takes half an hour.
RESULTS = "PBMPI_SICONOS_RESULTS"


def solve():
    """The module that writes the tables: it needs h5py, which other tables do not."""
    folder = str(programs.SOURCE / "jobs/siconos")
    if folder not in sys.path:
        sys.path.append(folder)
    import solve as module
    return module


@functools.cache
def results():
    with programs.Folder() as folder:
        given = os.environ.get(RESULTS)
        path = pathlib.Path(given) if given else folder
        if not given:
            programs.run([programs.SOURCE / "jobs/siconos.sh", path])
        return json.loads((path / "siconos.json").read_text(encoding="utf-8"))


def residuals():
    """By scene and group of hard cases."""
    return solve().table(results()["problems"])


def counts():
    """Over all problems of the reference."""
    return solve().statements(results()["facts"])


def above():
    """Runs with references above the bar."""
    return solve().worst(results()["problems"])
