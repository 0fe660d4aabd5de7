"""Fails if a source file includes or calls what its folder may not, or a folder holds more files than a part should.

Usage: layering.py PROJECT_ROOT. The arrows are those of the architecture: a folder names the folders that it stands on,
and sees what these see; the outside libraries only some may touch. What a state of sor depends on calls no function of the
C library that has other code for other CPUs.
"""

import pathlib
import re
import sys

# Folder under the root -> the folders that it stands on. A folder without an entry belongs to none of the layers.
STANDS_ON = {
    "src/core": [],
    "src/core/system": ["src/core"],
    "src/model": ["src/core"],
    "src/geometry": ["src/model"],
    "src/geometry/hulls": ["src/geometry"],
    "src/effects": ["src/geometry"],
    "src/stepping": ["src/effects"],
    "src/stepping/engine": ["src/stepping"],
    "src/stability": ["src/stepping"],
    "src/stability/cases": ["src/stability", "src/analysis"],
    "src/synthetic": ["src/stepping"],
    "src/analysis": ["src/model"],
    "src/estimate": ["src/stepping"],
    "jobs/paper/pbvalue/code": [],
    "jobs/paper/pbvalue/timing": ["jobs/paper/pbvalue/code"],
    "jobs/paper/pbvalue/tool": ["jobs/paper/pbvalue/timing", "src/core"],
    "src/ode/objects": ["src/effects"],
    "src/ode/collide": ["src/ode/objects", "src/stepping/engine", "src/geometry/hulls"],
    "src/ode/effects": ["src/ode/collide"],
    "src/ode": ["src/ode/effects"],
    "src/bullet/objects": ["src/effects"],
    "src/bullet/collide": ["src/bullet/objects", "src/stepping/engine"],
    "src/bullet": ["src/bullet/collide"],
    "src/mujoco/tree": ["src/effects"],
    "src/mujoco": ["src/mujoco/tree", "src/stepping/engine"],
    "src/solver/lanes": ["src/core"],
    "src/solver/layout": ["src/solver/lanes", "src/effects"],
    "src/solver/joints": ["src/solver/layout"],
    "src/solver/contacts": ["src/solver/layout"],
    "src/solver/collide": ["src/solver/layout"],
    "src/solver/newton": ["src/model"],
    "src/solver/pack": ["src/solver/joints", "src/solver/contacts", "src/solver/collide", "src/solver/newton", "src/stepping", "src/geometry/hulls"],
    "src/solver/parts": ["src/solver/pack"],
    "src/solver/worlds": ["src/solver/parts", "src/core/system"],
    "src/solver/spaces": ["src/solver/parts"],
    "scenes/parts": ["src/effects"],
    "scenes/meshes": ["scenes/parts", "src/geometry/hulls"],
    "scenes/format": ["scenes/meshes", "src/stability/cases"],
    "scenes/xml": ["src/core"],
    "scenes/links": ["scenes/meshes", "scenes/xml"],
    "scenes/mjcf/settings": ["scenes/links"],
    "scenes/mjcf": ["scenes/mjcf/settings"],
    "scenes/urdf": ["scenes/links"],
    "scenes/actors": ["scenes/format", "scenes/mjcf", "scenes/urdf"],
    "scenes": ["scenes/actors", "src/core/system"],
    "mpi/comm": ["src/core/system"],
    "mpi/balance": ["src/core"],
    "mpi/frame": ["mpi/comm", "src/stepping"],
    "mpi/worlds": ["mpi/frame", "mpi/balance"],
    "mpi/spaces/plan": ["src/model", "mpi/balance"],
    "mpi/spaces/step": ["mpi/spaces/plan", "mpi/comm", "src/stepping"],
    "mpi/spaces": ["mpi/spaces/step", "mpi/frame", "src/stability"],
    "io/file": ["src/core/system"],
    "io/hdf5": ["io/file"],
    "io/table": ["io/hdf5"],
    "io/setup": ["io/hdf5", "src/stepping"],
    "io/run": ["io/setup", "io/table"],
    "io/repair": ["io/run"],
    "src/engines": ["src/ode", "src/bullet", "src/mujoco", "src/solver/worlds", "src/solver/spaces", "scenes", "mpi/comm"],
    "src/api/include/pbmpi": [],
    "src/api": ["src/api/include/pbmpi", "src/engines", "src/analysis", "mpi/frame", "mpi/balance"],
    "src/api/python": ["src/api/include/pbmpi"],
    "src/app/manual": ["src/core"],
    "src/app/common": ["src/app/manual", "mpi/worlds", "mpi/spaces", "src/estimate", "src/engines"],
    "src/app/summary": ["src/app/common", "src/analysis"],
    "src/app/pbmpi/options": ["src/app/common"],
    "src/app/pbmpi": ["src/app/pbmpi/options", "src/app/summary", "io/run"],
    "src/app/pbreport": ["src/app/summary", "io/repair", "io/table"],
    "src/app/pbstudy/study": ["src/app/common", "src/analysis", "io/table"],
    "src/app/pbstudy/accuracy": ["src/app/pbstudy/study"],
    "src/app/pbstudy/calibrate": ["src/app/pbstudy/study", "mpi/frame", "src/synthetic"],
    "src/app/pbstudy/effects": ["src/app/pbstudy/study"],
    "src/app/pbstudy/stability": ["src/app/pbstudy/study"],
    "src/app/pbstudy": ["src/app/pbstudy/accuracy", "src/app/pbstudy/calibrate", "src/app/pbstudy/effects",
                        "src/app/pbstudy/stability"],
}

# A folder is one part of the program; one with more files than these is more than one.
MOST_FILES = 25

# Outside headers (a pattern) -> folders that may include them, and how many files of a folder at most.
OUTSIDE = [
    (r"ode/ode\.h|drawstuff/.*|ode/(collision|common|contact|mass|misc|objects|odeinit)\.h",
     {"src/ode": None, "src/ode/objects": None, "src/ode/collide": None, "src/ode/effects": None}),
    (r"bt\w+\.h|(BulletCollision|BulletDynamics|LinearMath)/.*",
     {"src/bullet": None, "src/bullet/objects": None, "src/bullet/collide": None}),
    (r"mujoco/(mj\w+|mujoco)\.h", {folder: None for folder in STANDS_ON if folder.startswith("src/mujoco")}),
    (r"mpi\.h", {"mpi/comm": 1, "io/hdf5": 1}),
    (r"hdf5.*\.h|H5.*\.h", {"io/hdf5": None, "io/table": None, "io/setup": None, "io/run": None}),
    (r"pugixml\.hpp", {"scenes/xml": 1}),
    (r"pybind11/.*|Python\.h", {"src/api/python": None}),
    (r"boost/.*", {folder: None for folder in STANDS_ON if folder.startswith("src/app/")}),
]

# Functions that differ in their last bits from CPU to CPU, and the folders below which a state may depend on them.
CPU_CALL = re.compile(r"\bstd::(a?(?:sin|cos|tan)h?|atan2|hypot|exp2?|expm1|log(?:2|10|1p)?|pow|cbrt|fma)\(")
STEPPED = ("src/core", "src/model", "src/geometry", "src/effects", "src/stepping", "src/solver", "src/estimate", "scenes", "mpi")

SUFFIXES = {".c", ".h", ".hpp", ".cpp", ".cc", ".inc"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


def seen_from(folder):
    """The folders whose headers a folder may include: itself, what it stands on, and what these see."""
    seen = {folder}
    for below in STANDS_ON[folder]:
        seen |= seen_from(below)
    return seen


def folder_of(path):
    """The folder of STANDS_ON that a path relative to the root lies in, or None."""
    folder = path.parent.as_posix()
    return folder if folder in STANDS_ON else None


def target_of(root, source, include):
    """The project file that an include means, relative to the root, or None for an outside header."""
    for base in (source.parent, root / "src", root, root / "src/api/include"):
        candidate = (base / include).resolve()
        if candidate.is_file() and candidate.is_relative_to(root):
            return candidate.relative_to(root)
    return None


def check_inside(folder, target):
    owner = folder_of(target)
    if owner is None:
        return f"{target} belongs to no folder that a library may include"
    if owner not in seen_from(folder):
        return f"{folder} may not include {owner}"
    return None


def check_outside(folder, include):
    for pattern, allowed in OUTSIDE:
        if re.fullmatch(pattern, include) and folder not in allowed:
            return f"only {', '.join(allowed)} may include it"
    return None


def check_calls(folder, text):
    if any(folder == top or folder.startswith(top + "/") for top in STEPPED):
        for name in CPU_CALL.findall(text):
            yield f"std::{name}() has other bits on other CPUs; core/elementary.h has its own, or do without"


def check_counts(users):
    """Outside headers that only so many files of a folder may include."""
    for (pattern, folder), files in sorted(users.items()):
        limit = dict(OUTSIDE)[pattern].get(folder)
        if limit is not None and len(files) > limit:
            yield f"{', '.join(sorted(files))}: {len(files)} files of {folder} include {pattern}; at most {limit} may"


def check_sizes(root, tops):
    """Folders below these that hold too many files, pictures apart."""
    for top in (*tops, "tests"):
        for folder in sorted(path for path in (root / top).rglob("*") if path.is_dir()):
            num_files = sum(1 for path in folder.iterdir() if path.is_file() and path.suffix not in (".png", ".pyc"))
            if num_files > MOST_FILES:
                yield f"{folder.relative_to(root)}: {num_files} files; at most {MOST_FILES} make one part"


def find_violations(root):
    """One line for each thing forbidden below `root`, and the number of files looked at."""
    root = pathlib.Path(root).resolve()
    violations, users, num_files = [], {}, 0
    tops = sorted({folder.split("/")[0] for folder in STANDS_ON})
    for top in tops:
        for source in sorted((root / top).rglob("*")):
            path = source.relative_to(root)
            folder = folder_of(path)
            if source.suffix not in SUFFIXES or not source.is_file():
                continue
            num_files += 1
            if folder is None:
                violations.append(f"{path}: it lies in no folder of the architecture")
                continue
            text = source.read_text(encoding="utf-8")
            violations.extend(f"{path}: {reason}" for reason in check_calls(folder, text))
            for include in INCLUDE.findall(text):
                target = target_of(root, source, include)
                reason = check_inside(folder, target) if target else check_outside(folder, include)
                if reason:
                    violations.append(f"{path}: #include {include}: {reason}")
                for pattern, _ in OUTSIDE:
                    if target is None and re.fullmatch(pattern, include):
                        users.setdefault((pattern, folder), set()).add(str(path))
    violations.extend(check_counts(users))
    violations.extend(check_sizes(root, tops))
    return violations, num_files


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    violations, num_files = find_violations(sys.argv[1])
    for line in violations:
        print(line, file=sys.stderr)
    if num_files == 0:
        sys.exit(f"{sys.argv[1]}: no source file found")
    print(f"{num_files} files, {len(violations)} forbidden includes or calls")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
