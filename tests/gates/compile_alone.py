"""Does every source compile for itself? `compile_alone.py BUILD` parses each source of BUILD's compile_commands.json, which was
configured without precompiled headers and with each source on its own (preset alone): one that leans on what another source
or the precompiled headers include fails."""
import concurrent.futures
import json
import os
import shlex
import subprocess
import sys


def parse(entry):
    """The compiler's messages; none if the source is right."""
    command = shlex.split(entry["command"])
    at = command.index("-o")
    done = subprocess.run([*command[:at], *command[at + 2:], "-fsyntax-only"], cwd=entry["directory"], stderr=subprocess.PIPE, text=True,
                          check=False)
    return done.stderr if done.returncode else ""


def main():
    with open(os.path.join(sys.argv[1], "compile_commands.json"), encoding="utf-8") as file:
        entries = [entry for entry in json.load(file) if entry["file"].endswith(".cpp") and os.path.exists(entry["file"])]
    if len(entries) < 300:
        sys.exit(f"{sys.argv[1]}: {len(entries)} sources only; are they compiled one by one?")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        messages = [text for text in pool.map(parse, entries) if text]
    print("".join(messages), end="", file=sys.stderr)
    print(f"{len(entries)} sources, {len(messages)} that do not compile alone")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()
