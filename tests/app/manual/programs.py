"""What the programs themselves say of their commands and options: the oracle of their manual pages and completions."""
import functools
import os
import re
import subprocess

BIN = os.environ["PBMPI_BIN"]
MANUAL = os.path.join(os.path.dirname(BIN), "manual")
PROGRAMS = ("pbmpi", "pbstudy", "pbreport")


@functools.lru_cache(maxsize=None)
def help_of(*command):
    """The text of --help, e.g. of "pbreport", "csv"."""
    return subprocess.run([os.path.join(BIN, command[0]), *command[1:], "--help"], check=True, capture_output=True, text=True,
                          timeout=60).stdout


def options_of(*command):
    """The long options, with their dashes."""
    return set(re.findall(r"^  (?:-\w \[ )?(--[\w-]+)", help_of(*command), re.MULTILINE))


def commands_of(program):
    """The commands, but for the one that is the program itself."""
    table = re.search(r"^(?:Studies|Commands) .*:\n((?:  \S.*\n)+)", help_of(program), re.MULTILINE)
    return [] if table is None else [line.split()[0] for line in table[1].splitlines() if line.split()[0] != "report"]


def all_commands():
    """("pbmpi",), ("pbstudy",), ("pbstudy", "accuracy") ..."""
    return [command for program in PROGRAMS
            for command in [(program,), *((program, word) for word in commands_of(program))]]

