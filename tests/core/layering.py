"""Fails if a source file includes what its folder may not see.

Usage: layering.py PROJECT_ROOT. The arrows are those of the architecture: a folder names the folders of
pbmpi that it may include (itself always), and the outside libraries that only some may touch.
"""

import pathlib
import re
import sys

# Folder under the root -> folders whose headers it may include.
ARROWS = {
    "src/core": [],
    "src/model": ["src/core"],
    "src/ode": ["src/core", "src/model"],
    "src/solver": ["src/core", "src/model"],
    "src/estimate": ["src/core", "src/model", "src/solver"],
    "src/analysis": ["src/core", "src/model"],
    "scenes": ["src/core", "src/model"],
    "mpi": ["src/core", "src/model"],
    "io": ["src/core", "src/model"],
    "src/app": ["src/core", "src/model", "src/ode", "src/solver", "src/estimate", "src/analysis",
                "scenes", "mpi", "io"],
}

# Outside headers (a pattern) -> folders that may include them, and how many files of a folder at most.
OUTSIDE = [
    (r"ode/ode\.h|drawstuff/.*|ode/(collision|common|contact|mass|misc|objects|odeinit)\.h", {"src/ode": None}),
    (r"mpi\.h", {"mpi": None, "io": 1}),
    (r"hdf5.*\.h|H5.*\.h", {"io": None}),
    (r"boost/.*", {"src/app": None}),
]

SUFFIXES = {".h", ".hpp", ".cpp", ".cc", ".inc"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


def folder_of(path):
    """The folder of ARROWS that a path relative to the root lies in, or None."""
    name = path.as_posix()
    matches = [folder for folder in ARROWS if name.startswith(folder + "/")]
    return max(matches, key=len) if matches else None


def target_of(root, source, include):
    """The project file that an include means, relative to the root, or None for an outside header."""
    for base in (source.parent, root / "src", root):
        candidate = (base / include).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root)
    return None


def check_inside(folder, target):
    owner = folder_of(target)
    if owner is None:
        return f"{target} belongs to no folder that a library may include"
    if owner != folder and owner not in ARROWS[folder]:
        return f"{folder} may not include {owner}"
    return None


def check_outside(folder, include):
    for pattern, allowed in OUTSIDE:
        if re.fullmatch(pattern, include) and folder not in allowed:
            return f"only {', '.join(allowed)} may include it"
    return None


def check_counts(users):
    """Outside headers that only so many files of a folder may include."""
    for (pattern, folder), files in sorted(users.items()):
        limit = dict(OUTSIDE)[pattern].get(folder)
        if limit is not None and len(files) > limit:
            yield f"{', '.join(sorted(files))}: {len(files)} files of {folder} include {pattern}; at most {limit} may"


def find_violations(root):
    """One line for each forbidden include below `root`, and the number of files looked at."""
    root = pathlib.Path(root).resolve()
    violations, users, num_files = [], {}, 0
    for top in sorted({folder.split("/")[0] for folder in ARROWS}):
        for source in sorted((root / top).rglob("*")):
            path = source.relative_to(root)
            folder = folder_of(path)
            if source.suffix not in SUFFIXES or not source.is_file():
                continue
            num_files += 1
            if folder is None:
                violations.append(f"{path}: it lies in no folder of the architecture")
                continue
            for include in INCLUDE.findall(source.read_text(encoding="utf-8")):
                target = target_of(root, source, include)
                reason = check_inside(folder, target) if target else check_outside(folder, include)
                if reason:
                    violations.append(f"{path}: #include {include}: {reason}")
                for pattern, _ in OUTSIDE:
                    if target is None and re.fullmatch(pattern, include):
                        users.setdefault((pattern, folder), set()).add(str(path))
    violations.extend(check_counts(users))
    return violations, num_files


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    violations, num_files = find_violations(sys.argv[1])
    for line in violations:
        print(line, file=sys.stderr)
    if num_files == 0:
        sys.exit(f"{sys.argv[1]}: no source file found")
    print(f"{num_files} files, {len(violations)} forbidden includes")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
