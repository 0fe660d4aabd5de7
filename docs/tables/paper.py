"""Tables of the paper's statements: verdicts of `jobs/paper.sh`, by what they rest on."""
import functools
import json
import os

from tables import programs

# The folder of a call that is there already, for a writer who has just made it: with value prediction it takes half an hour.
FOLDER = "PBMPI_PAPER"


@functools.cache
def statements(*options):
    """Every statement, as `jobs/paper/paper.py paper --json` has them, of a call of the script with these options."""
    given = os.environ.get(FOLDER)
    if given and "--without-clock" not in options:
        return json.loads(programs.paper("paper", given, "--json"))["statements"]
    with programs.Folder() as folder:
        programs.run([programs.SOURCE / "jobs/paper.sh", *options, folder])
        return json.loads((folder / "paper.json").read_text(encoding="utf-8"))["statements"]


def table_of(basis, found):
    rows = [[one["section"], one["finding"], *(one[key] or "-" for key in ("statement", "paper", "rule", "ours", "remark"))]
            for one in found if one["rests_on"] == basis]
    return programs.table(["section", "verdict", "the paper", "its value", "confirmed if", "ours", "remark"], rows)


def counts():
    """What comes out the same on every machine."""
    return table_of("counts", statements("--without-clock"))


def clock():
    return table_of("clock", statements("--prediction"))


def instructions():
    return table_of("instructions", statements("--prediction"))


def prediction():
    return table_of("prediction", statements("--prediction"))


def nothing():
    """What nothing here can decide, with the reason."""
    rows = [[one["section"], one["statement"], one["paper"], one["remark"]] for one in statements("--without-clock")
            if one["rests_on"] == "nothing"]
    return programs.table(["section", "the paper", "its value", "why not"], rows)
