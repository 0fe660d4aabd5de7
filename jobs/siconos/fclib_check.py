#!/usr/bin/env python3
"""Reads files of problems with the real libfclib, in a process of its own (h5py has another HDF5), and compares all numbers.

usage: fclib_check.py FILE.hdf5 ...                   exit code 77: there is no libfclib"""
import ctypes
import ctypes.util
import json
import subprocess
import sys

INT, DOUBLE = ctypes.POINTER(ctypes.c_int), ctypes.POINTER(ctypes.c_double)


class Matrix(ctypes.Structure):
    _fields_ = [("nzmax", ctypes.c_int), ("m", ctypes.c_int), ("n", ctypes.c_int), ("p", INT), ("i", INT), ("x", DOUBLE), ("nz", ctypes.c_int),
                ("info", ctypes.c_void_p)]

    def dense(self):
        rows = [[0.0] * self.n for _ in range(self.m)]
        for column in range(self.n):
            for k in range(self.p[column], self.p[column + 1]):
                rows[self.i[k]][column] += self.x[k]
        return rows


MATRIX = ctypes.POINTER(Matrix)


class Local(ctypes.Structure):
    _fields_ = [("W", MATRIX), ("V", MATRIX), ("R", MATRIX), ("mu", DOUBLE), ("q", DOUBLE), ("s", DOUBLE), ("spacedim", ctypes.c_int),
                ("info", ctypes.c_void_p)]


class Global(ctypes.Structure):
    _fields_ = [("M", MATRIX), ("H", MATRIX), ("G", MATRIX), ("mu", DOUBLE), ("f", DOUBLE), ("b", DOUBLE), ("w", DOUBLE),
                ("spacedim", ctypes.c_int), ("info", ctypes.c_void_p)]


class Solution(ctypes.Structure):
    _fields_ = [("v", DOUBLE), ("u", DOUBLE), ("r", DOUBLE), ("l", DOUBLE)]


def library():
    name = ctypes.util.find_library("fclib")
    for candidate in filter(None, (name, "libfclib.so.0")):
        try:
            return ctypes.CDLL(candidate)
        except OSError:
            pass
    return None


def read(path, form):
    """What libfclib makes of a file, as lists."""
    fclib = library()
    if fclib is None:
        return None
    kind = Local if form == "local" else Global
    reader = getattr(fclib, f"fclib_read_{form}")
    reader.restype, reader.argtypes = ctypes.POINTER(kind), [ctypes.c_char_p]
    problem = reader(path.encode()).contents
    found = {name: getattr(problem, name).contents.dense() for name, what in kind._fields_ if what is MATRIX and getattr(problem, name)}
    sizes = {"mu": "H", "w": "H", "f": "M", "b": "G"} if form == "global" else {"mu": "W", "q": "W", "s": "R"}
    for name, of in sizes.items():
        if of in found:
            size = len(found[of][0]) // (problem.spacedim if name == "mu" else 1)
            found[name] = getattr(problem, name)[:size]
    fclib.fclib_read_solution.restype, fclib.fclib_read_solution.argtypes = ctypes.POINTER(Solution), [ctypes.c_char_p]
    solution = fclib.fclib_read_solution(path.encode()).contents
    rows = 3 * len(found["mu"])
    found["solution_u"] = solution.u[:rows]
    if form == "local":
        found["solution_r"] = solution.r[:rows]
        fclib.fclib_merit_local.restype = ctypes.c_double
        found["merit"] = fclib.fclib_merit_local(ctypes.byref(problem), 0, ctypes.byref(solution))
    return found


def differences(path):
    """Largest difference of any number, or None without libfclib; and libfclib's merit function of a local solution."""
    import h5py
    import numpy as np

    from fclib_matrix import read_matrix
    with h5py.File(path) as file:
        form = "local" if "fclib_local" in file else "global"
        main = file[f"fclib_{form}"]
        mine = {name: read_matrix(group) for name, group in main.items() if isinstance(group, h5py.Group) and "nzmax" in group}
        mine.update({name: values[:] for name, values in main["vectors"].items()})
        mine.update({f"solution_{name}": values[:] for name, values in file["solution"].items() if name in "ur"})
    done = subprocess.run([sys.executable, __file__, "--read", path, form], capture_output=True, text=True)
    if done.returncode == 77:
        return None, None
    if done.returncode != 0:
        raise RuntimeError(f"libfclib cannot read {path}: {done.stderr}")
    found = json.loads(done.stdout)
    merit = found.pop("merit", None)
    return max(float(np.abs(np.array(values) - mine[name]).max(initial=0)) for name, values in found.items()), merit


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--read":
        found = read(*sys.argv[2:])
        if found is None:
            sys.exit(77)
        print(json.dumps(found))
        return
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for path in sys.argv[1:]:
        apart, merit = differences(path)
        if apart is None:
            print("no libfclib")
            sys.exit(77)
        print(f"{path}: differs by {apart:g}" + ("" if merit is None else f", merit {merit:.3g}"))


if __name__ == "__main__":
    main()
