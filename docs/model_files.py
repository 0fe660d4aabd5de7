#!/usr/bin/env python3
"""Counts which models of other programs pbmpi reads, and why it refuses the others: the tables of scenes/MODELS.md.

Usage: model_files.py FOLDER... (each with MJCF and URDF files at any depth; files with flexible bodies are left out). Prints a table in Markdown, a
row for each reason; a file counts for the first that pbmpi names. Needs pbmpi on the path or in PBMPI_BIN.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

# What a row says, and what pbmpi's message says then; the first that fits counts.
REASONS = [
    ("have nothing that moves", r"no body of the model moves|the world has no body"),
    ("are parts of other files", r"neither MJCF .* nor URDF|there is no <(worldbody|link)>"),
    ("have tendons that pull or limit, or servos on them", r"tendon"),
    ("move in a medium", r"a medium has no equal"),
    ("have damping, springs, friction, armature or limits on ball or free joints", r"of a joint of type (ball|free)"),
    ("have bodies with moments of inertia that no body has", r"moment of inertia above the sum"),
    ("have joints that follow others", r"mimic|follows another"),
    ("have shapes or meshes of other kinds, or bodies whose mass is not given", r"geoms of type|mesh|hfield|no mass|mass of a geom|'size'"),
    ("have actuators of other kinds", r"actuator|servo|it has a bias|dampratio"),
    ("name files that are elsewhere", r"in the folder of|in no folder around|no such file"),
    ("have something else", r""),
]


def models(folders):
    """Texts that begin as MJCF or URDF do, without flexible bodies."""
    for folder in folders:
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.suffix.lower() in (".xml", ".urdf", ".mjcf") and path.is_file():
                text = path.read_text(encoding="utf-8", errors="replace")
                if re.search(r"<(mujoco|robot)\b", text) and not re.search(r"<(flex|flexcomp|composite)\b", text):
                    yield path


def refusal(path):
    """The last line of what pbmpi says; nothing for a model that it reads."""
    program = os.path.join(os.environ.get("PBMPI_BIN", ""), "pbmpi")
    done = subprocess.run([program, "--scene", str(path), "--describe"], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["?"])[-1]


def counted(refusals):
    """[(count, what)], those that run first."""
    rows = [(sum(not one for one in refusals), "run")]
    left = [one for one in refusals if one]
    for what, pattern in REASONS:
        fitting = [one for one in left if re.search(pattern, one)]
        left = [one for one in left if one not in fitting]
        rows.append((len(fitting), what))
    return [row for row in rows if row[0] > 0]


def main(folders):
    paths = list(models(folders))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        refusals = list(pool.map(refusal, paths))
    print(f"| files, of {len(paths)} | |\n|---|---|")
    for count, what in counted(refusals):
        print(f"| {count} | {what} |")
    for path, why in zip(paths, refusals):
        if why:
            print(f"{path}: {why}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
