"""Writes the programs' sources as few units, for tools to which what sources include is most of the work: `joined_sources.py BUILD`
reads compile_commands.json of BUILD, configured with each source on its own (preset alone), writes BUILD/joined with the units and
a compile_commands.json of theirs, and prints their paths.

A unit includes all sources of some folders. Names in their anonymous namespaces must differ: where a unit does not compile since
two sources have one name, rename, or give a folder a line of its own in UNITS."""
import json
import os
import shlex
import sys

# Folders whose sources, those of folders below them included, are a unit; the first that fits.
UNITS = (("src/geometry/hulls",), ("src/solver",), ("src/ode", "src/bullet", "src/mujoco", "src/engines", "src/api"),
         ("src/app/pbmpi",), ("src/app/pbreport",), ("src/app/pbstudy/accuracy",), ("src/app/pbstudy/effects",), ("src/app/pbstudy/stability",),
         ("src/app",), ("src",), ("scenes/parts",), ("scenes",), ("mpi/spaces/step",), ("mpi",),
         ("io/file",), ("io/hdf5",), ("io/repair",), ("io/run",), ("io/setup",), ("io/table",), ("io",))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def unit_of(path):
    """The index in UNITS of a source, or None for a generated one."""
    return next((i for i, folders in enumerate(UNITS) if any(path.startswith(folder + "/") for folder in folders)), None)


def flags_of(entry):
    """The words of a command between the compiler and its output; `-isystem FOLDER` is one."""
    words = iter(shlex.split(entry["command"]))
    next(words)
    for word in words:
        if word == "-o":
            return
        yield (word, next(words)) if word == "-isystem" else (word,)


def write_unit(entries, file):
    """The unit's entry for compile_commands.json: all flags of its sources, each once."""
    flags = dict.fromkeys(flag for entry in entries for flag in flags_of(entry))
    with open(file, "w", encoding="utf-8") as unit:
        unit.writelines(f'#include "{entry["file"]}"\n' for entry in entries)
    # A name of one source may shadow another's; gate headers warns of those within a source.
    command = ["clang++", *(word for flag in flags for word in flag), "-Wno-shadow", "-c", file]
    return {"directory": entries[0]["directory"], "file": file, "command": shlex.join(command)}


def main():
    build = os.path.abspath(sys.argv[1])
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = [entry for entry in json.load(file) if entry["file"].endswith(".cpp")]
    sources = [(unit_of(os.path.relpath(entry["file"], ROOT)), entry) for entry in entries]
    folder = os.path.join(build, "joined")
    os.makedirs(folder, exist_ok=True)
    units = []
    for index, folders in enumerate(UNITS):
        own = [entry for unit, entry in sources if unit == index]
        if own:
            units.append((len(own), write_unit(own, os.path.join(folder, folders[0].replace("/", "_") + ".cpp"))))
    if sum(size for size, _ in units) < 300:
        sys.exit(f"{build}: {sum(size for size, _ in units)} sources only; are they compiled one by one?")
    units.sort(key=lambda unit: -unit[0])  # the largest first, for a pool
    with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as file:
        json.dump([entry for _, entry in units], file, indent=1)
    print(*(entry["file"] for _, entry in units), sep="\n")


if __name__ == "__main__":
    main()
