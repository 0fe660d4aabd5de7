#!/usr/bin/env python3
"""Writes the contact problems of runs as files of FCLIB (Frictional Contact Library), one an island of a step.

usage: fclib_export.py [--form local|global] [--most-contacts N] [--each N] [--each-hard N] --output DIR RUN.h5 ..."""
import argparse
import pathlib
import sys

import h5py
import numpy as np

from fclib_matrix import write_matrix
from recorded_steps import Steps


def write(path, problem, form, title):
    with h5py.File(path, "w") as file:
        main = file.create_group(f"fclib_{form}")
        main.create_dataset("spacedim", data=np.array([3], "i4"))
        if form == "local":
            W, q = problem.condensed()
            matrices, vectors = {"W": W}, {"q": q}
            solution = {"u": W @ problem.r + q, "r": problem.r}
        else:
            matrices, vectors, solution = whole(problem)
        for name, matrix in matrices.items():
            write_matrix(main.create_group(name), matrix)
        for name, values in {**vectors, "mu": problem.mu}.items():
            main.create_dataset(f"vectors/{name}", data=np.asarray(values, "f8"))
        what = {"title": title, "description": f"bodies {len(problem.bodies)}, contacts {len(problem.mu)}, rows of joints {len(problem.s)}",
                "math_info": "impulses [N s], velocities [m/s]; first the normal"}
        for name, text in what.items():
            main.create_dataset(f"info/{name}", data=np.bytes_(text + "\0"))
        for name, values in solution.items():
            file.create_dataset(f"solution/{name}", data=values)
        own = file.create_group("pbmpi")
        own.attrs.update(world=problem.world, step=problem.step, forward=problem.forward, recorded_gap=float(np.abs(solution["u"] - problem.u).max()))
        own.create_dataset("bodies", data=problem.bodies)


def whole(problem):
    """FCLIB's global form. A row with compliance has a velocity of its own, of mass 1 / compliance, beside those of bodies: what
    a multiplier changes of it is compliance times multiplier."""
    soft_c, soft_d = np.flatnonzero(problem.C > 0), np.flatnonzero(problem.D > 0)
    n, extra = len(problem.v), len(soft_c) + len(soft_d)
    M = np.zeros((n + extra, n + extra))
    for k, block in enumerate(problem.inverse_mass):
        M[6 * k:6 * k + 6, 6 * k:6 * k + 6] = np.linalg.inv(block)
    M[range(n, n + extra), range(n, n + extra)] = np.concatenate([1 / problem.C[soft_c], 1 / problem.D[soft_d]])
    H = np.vstack([problem.H, np.zeros((extra, len(problem.r)))])
    H[n + np.arange(len(soft_c)), soft_c] = 1
    f = M @ np.concatenate([problem.v_free, np.zeros(extra)])
    v = problem.velocities(problem.r)
    matrices, vectors = {"M": M, "H": H}, {"f": f, "w": problem.w}
    multipliers = np.zeros(0)
    if problem.G.shape[1]:
        matrices["G"] = np.vstack([problem.G, np.zeros((extra, len(problem.s)))])
        matrices["G"][n + len(soft_c) + np.arange(len(soft_d)), soft_d] = 1
        vectors["b"] = -problem.s
        before = problem.v_free + problem.times_inverse_mass((problem.H @ problem.r)[:, None])[:, 0]
        multipliers = np.linalg.solve(problem.joint_matrix(), problem.s - problem.G.T @ before)
    v = np.concatenate([v, (problem.C * problem.r)[soft_c], (problem.D * multipliers)[soft_d]])
    solution = {"v": v, "u": H.T @ v + problem.w, "r": problem.r}
    return matrices, vectors, {**solution, "l": multipliers} if len(multipliers) else solution


def evenly(things, most):
    return [things[i] for i in np.unique(np.linspace(0, len(things) - 1, min(most, len(things))).round().astype(int))] if things else []


def several(places, most):
    """(turn, place): places once more, for other islands of theirs, where there are few."""
    rounds = most // max(len(places), 1) + 1
    return [(i + k, place) for k in range(rounds) for i, place in enumerate(places)][:most]


def export(path, out, form, most_contacts, most):
    """Names of problems, evenly over the steps of a run, and why others were left out."""
    steps = Steps(path)
    places = [(frame, world) for frame in range(steps.frames) for world in steps.worlds_with_contacts(frame)]
    written, left_out = [], []
    for turn, (frame, world) in several(evenly(places, most), most):
        fitting = [island for island in steps.islands(frame, world) if len(island[1]) <= most_contacts]
        if not fitting:
            left_out.append(f"more than {most_contacts} contacts")
            continue
        # The largest, then the next, and so on: islands of all sizes.
        chosen = turn % len(fitting)
        name = f"{pathlib.Path(path).stem}-w{world}-s{frame}-i{chosen}.hdf5"
        if name in written:
            continue
        problem = steps.problem(frame, world, *fitting[chosen])
        if isinstance(problem, str):
            left_out.append(problem)
            continue
        write(out / name, problem, form, f"pbmpi {steps.file['parameters/scene'].asstr()[()]}, world {world}, step {frame}, island {chosen}")
        written.append(name)
    return written, left_out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--form", choices=("local", "global"), default="local")
    parser.add_argument("--most-contacts", type=int, default=100, help="larger islands are left out")
    parser.add_argument("--each", type=int, default=40, help="problems of a run at most")
    parser.add_argument("--each-hard", type=int, default=None, help="of a run whose file is named hard.*")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    lines = []
    for path in options.runs:
        hard = pathlib.Path(path).name.startswith("hard.") and options.each_hard is not None
        try:
            written, left_out = export(path, options.output, options.form, options.most_contacts, options.each_hard if hard else options.each)
        except ValueError as error:
            sys.exit(f"fclib_export.py: {error}")
        lines += [f"{pathlib.Path(path).stem},{len(written)},{reason}" for reason in left_out]
        print(f"{path}: {len(written)} problems" + "".join(f"; {left_out.count(r)} left out: {r}" for r in sorted(set(left_out))))
    (options.output / "left_out.csv").write_text("run,written,reason\n" + "\n".join(lines) + ("\n" if lines else ""))


if __name__ == "__main__":
    main()
