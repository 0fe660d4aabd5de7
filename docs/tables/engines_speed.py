"""Tables with a clock: Bullet, MuJoCo and ODE beside `sor` on one core, from tests/bench/engines."""
import functools
import json
import sys

from tables import programs

FOLDER = programs.SOURCE / "tests/bench/engines"
sys.path.insert(0, str(FOLDER))

import engines  # noqa: E402


@functools.cache
def measured():
    """One measurement for both tables: minutes."""
    with programs.Folder() as folder:
        path = folder / "rows.json"
        programs.run([engines.PYTHON, FOLDER / "engines.py", "--json", path])
        return json.loads(path.read_text(encoding="utf-8"))


def speed():
    return engines.speed_table(measured())


def equal_gap():
    return engines.gap_table(measured())
