"""What the programs themselves say of their commands and options: the oracle of their manual pages and completions."""
import functools
import os
import re
import subprocess

BIN = os.environ["PBMPI_BIN"]
PROGRAMS = ("pbmpi", "pbstudy", "pbreport")
# MPI starts without a daemon.
ENVIRONMENT = {**os.environ, "OMPI_MCA_ess_singleton_isolated": "1", "PATH": os.pathsep.join((BIN, os.environ["PATH"]))}


@functools.lru_cache(maxsize=None)
def run(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=ENVIRONMENT)


def help_of(*command):
    """The text of --help all, e.g. of "pbreport", "csv"."""
    result = run(*command, "--help", "all")
    result.check_returncode()
    return result.stdout


def options_in(text):
    """The long options, with their dashes."""
    return set(re.findall(r"^  (?:-\w, )?(--[\w-]+)", text, re.MULTILINE))


def options_of(*command):
    return options_in(help_of(*command))


def commands_of(program):
    """The commands, but for the one that is the program itself."""
    table = re.search(r"^(?:Studies|Commands) .*:\n((?:  \S.*\n)+)", help_of(program), re.MULTILINE)
    return [] if table is None else [line.split()[0] for line in table[1].splitlines() if line.split()[0] != "report"]


def all_commands():
    """("pbmpi",), ("pbstudy",), ("pbstudy", "accuracy") ..."""
    return [command for program in PROGRAMS
            for command in [(program,), *((program, word) for word in commands_of(program))]]
