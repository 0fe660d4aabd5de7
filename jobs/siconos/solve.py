#!/usr/bin/env python3
"""Residuals of contact problems by Siconos' measure: of the impulses in the files, and of Siconos' own solution.

usage: solve.py --output NAME DIR ...        DIR: of fclib_export.py; the last one's problems are solved by Siconos, too

Writes NAME.csv (a line a problem), NAME.json and NAME.md."""
import argparse
import csv
import json
import pathlib
import time

import h5py
import numpy as np

from fclib_matrix import read_matrix

BAR = 1e-8


def project(x, mu):
    """Rows of x [nc][3] onto the cones |tangent| <= mu normal."""
    normal, across = x[:, 0], np.linalg.norm(x[:, 1:], axis=1)
    push = np.maximum((normal + mu * across) / (1 + mu**2), 0)
    scale = np.divide(mu * push, across, out=np.zeros_like(across), where=across > 0)
    onto = np.column_stack([push, scale[:, None] * x[:, 1:]])
    return np.where(((across <= mu * normal) & (normal >= 0))[:, None], x, onto)


def natural_map(W, q, mu, r, convex=False):
    """|r - P(r - (u + mu |u_t| n))| over the largest of |q|, |u|, |r|; u = W r + q. convex: without the term mu |u_t|, as of
    the law in which what slides lifts off."""
    u = W @ r + q
    R, U = r.reshape(-1, 3), u.reshape(-1, 3).copy()
    if not convex:
        U[:, 0] += mu * np.linalg.norm(U[:, 1:], axis=1)
    left, size = np.linalg.norm(R - project(R - U, mu)), max(np.linalg.norm(q), np.linalg.norm(u), np.linalg.norm(r))
    return left / size if size > np.finfo(float).eps else left  # as Siconos: what is no more than rounding is not divided by


class Problem:
    def __init__(self, path):
        with h5py.File(path) as file:
            main = file["fclib_local"]
            self.W = read_matrix(main["W"])
            self.q, self.mu = main["vectors/q"][:], main["vectors/mu"][:]
            self.r = file["solution/r"][:]
            self.forward, self.recorded_gap = file["pbmpi"].attrs["forward"], file["pbmpi"].attrs["recorded_gap"]

    def force(self, sn):
        """As Siconos wants it, which keeps no copy of what it is given."""
        self.kept = (self.W.copy(order="F"), self.q.copy(), self.mu.copy())
        return sn.FrictionContactProblem(3, len(self.mu), *self.kept)


def error_of(sn, problem, force, r):
    options = sn.SolverOptions(sn.SICONOS_FRICTION_3D_NSGS)
    return float(sn.fc3d_compute_error(force, r.copy(), np.zeros_like(r), BAR, options, float(np.linalg.norm(problem.q)))[1])


def solved(sn, problem, force, tolerance, sweeps):
    """Siconos' solution of least error, by Gauss-Seidel and, where that stays above the bar, by a Newton method from there."""
    best, found, method = np.zeros_like(problem.q), np.inf, "none"
    for name, most in (("NSGS", sweeps), ("NSN_AC", 200)):
        options = sn.SolverOptions(getattr(sn, f"SICONOS_FRICTION_3D_{name}"))
        options.dparam[sn.SICONOS_DPARAM_TOL], options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = tolerance, most
        r, u = best.copy(), np.zeros_like(problem.q)
        try:
            sn.fc3d_driver(force, r, u, options)
        except RuntimeError:
            continue
        if not np.isfinite(r).all():
            continue
        error = error_of(sn, problem, force, r)
        if error < found:
            best, found, method = r, error, name
        if found < BAR / 10:
            break
    return best, found, method


def judged(sn, path, solves, tolerance, sweeps):
    problem = Problem(path)
    force = problem.force(sn)
    row = {"kind": path.parent.name, "run": path.stem.rsplit("-w", 1)[0], "problem": path.stem, "contacts": len(problem.mu),
           "residual": error_of(sn, problem, force, problem.r), "residual_numpy": natural_map(problem.W, problem.q, problem.mu, problem.r),
           "residual_convex": natural_map(problem.W, problem.q, problem.mu, problem.r, True),
           "forward": float(problem.forward), "recorded_gap": float(problem.recorded_gap)}
    if solves:
        start = time.perf_counter()
        r, row["siconos"], row["method"] = solved(sn, problem, force, tolerance, sweeps)
        row["seconds"] = time.perf_counter() - start
        row["velocities_apart"] = float(np.abs(problem.W @ (r - problem.r)).max())
        row["impulses_apart"] = float(np.abs(r - problem.r).max())
    return row


def group(run):
    return "hard/" + run.split(".")[1] if run.startswith("hard.") else run


def number(value):
    return "" if value is None or not np.isfinite(value) else f"{value:.1e}"


def table(rows):
    """Lines of Markdown: residuals, a line a scene or group of hard cases."""
    kinds = list(dict.fromkeys(row["kind"] for row in rows))
    last = kinds[-1]
    groups = list(dict.fromkeys(group(row["run"]) for row in rows if row["kind"] == last))
    groups = [g for g in groups if not g.startswith("hard/")] + sorted(g for g in groups if g.startswith("hard/"))
    heads = ["", "problems", "contacts, median and most"] + [f"{kind.replace('_', ' ')}, median" for kind in kinds] + [
        f"{last}, most", f"{last} below 1e-8 [%]", "Siconos, median", "Siconos below 1e-8 [%]", "apart, median [m/s]"]
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    for name in groups + ["all"]:
        of = {kind: [row for row in rows if row["kind"] == kind and name in (group(row["run"]), "all")] for kind in kinds}
        mine = of[last]
        column = lambda key: np.array([row[key] for row in mine])
        cells = [name, str(len(mine)), f"{np.median(column('contacts')):.0f}, {column('contacts').max()}"]
        cells += [number(np.median([row["residual"] for row in of[kind]])) if of[kind] else "-" for kind in kinds]
        cells += [number(column("residual").max()), f"{100 * np.mean(column('residual') < BAR):.1f}", number(np.median(column("siconos"))),
                  f"{100 * np.mean(column('siconos') < BAR):.1f}", number(np.median(column("velocities_apart")))]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def worst(rows):
    """Lines: runs of which a reference is above the bar."""
    last = rows[-1]["kind"]
    runs = {}
    for row in rows:
        if row["kind"] == last:
            runs.setdefault(row["run"], []).append(row)
    lines = ["| run | above 1e-8 | of | largest | Siconos, largest | Siconos above 1e-8 |", "|" + " --- |" * 6]
    for run, mine in sorted(runs.items()):
        above = [row for row in mine if not row["residual"] < BAR]
        if above:
            lines.append(f"| {run.replace('.', '/') if run.startswith('hard.') else run} | {len(above)} | {len(mine)} | "
                         f"{number(max(row['residual'] for row in above))} | {number(max(row['siconos'] for row in mine))} | "
                         f"{sum(not row['siconos'] < BAR for row in mine)} |")
    return lines


def statements(facts):
    """A line of Markdown for each count over the problems of the last folder."""
    what = (("reference_below_bar", "reference below 1e-8"), ("siconos_below_bar", "Siconos below 1e-8"), ("both_above_bar", "both above it"),
            ("convex_below_bar", "reference below 1e-8 by the convexified law"),
            ("several_solutions", "both below 1e-8, with velocities more than 1 mm/s apart"),
            ("forward_known", "v_free to 1e-9 from the state before"))
    return [f"| of {facts['problems']} problems of {facts['runs']} runs | | [%] |", "| --- | --- | --- |"] + [
        f"| {text} | {facts[name]} | {100 * facts[name] / facts['problems']:.1f} |" for name, text in what] + [
            f"| median distance of v_free from that of the state before | {facts['forward_median']:.1e} | |",
            f"| largest distance of numpy's residual from Siconos' | {facts['numpy_apart']:.1e} | |"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--output", required=True)
    parser.add_argument("--tolerance", type=float, default=1e-10, help="at which Siconos stops")
    parser.add_argument("--sweeps", type=int, default=5000, help="of Siconos' Gauss-Seidel at most")
    options = parser.parse_args()
    import siconos.numerics as sn
    rows = []
    for folder in options.folders:
        for path in sorted(folder.glob("*.hdf5")):
            rows.append(judged(sn, path, folder == options.folders[-1], options.tolerance, options.sweeps))
    names = list(dict.fromkeys(name for row in rows for name in row))
    with open(options.output + ".csv", "w", newline="") as file:
        writer = csv.DictWriter(file, names, restval="")
        writer.writeheader()
        writer.writerows(rows)
    mine = [row for row in rows if row["kind"] == options.folders[-1].name]
    count = lambda holds: int(sum(holds))
    facts = {"problems": len(mine), "runs": len({row["run"] for row in mine}),
             "reference_below_bar": count(row["residual"] < BAR for row in mine), "siconos_below_bar": count(row["siconos"] < BAR for row in mine),
             "both_above_bar": count(not row["residual"] < BAR and not row["siconos"] < BAR for row in mine),
             "convex_below_bar": count(row["residual_convex"] < BAR for row in mine),
             # Other velocities, and both solve the problem: it has several solutions.
             "several_solutions": count(max(row["residual"], row["siconos"]) < BAR and row["velocities_apart"] > 1e-3 for row in mine),
             "numpy_apart": max(abs(row["residual"] - row["residual_numpy"]) for row in rows),
             "forward_median": float(np.nanmedian([row["forward"] for row in mine])),
             "forward_known": count(row["forward"] < 1e-9 for row in mine)}
    pathlib.Path(options.output + ".json").write_text(json.dumps({"facts": facts, "problems": rows}, indent=1, default=float))
    text = table(rows) + [""] + statements(facts) + [""] + worst(rows)
    pathlib.Path(options.output + ".md").write_text("\n".join(text) + "\n")
    print("\n".join(text))


if __name__ == "__main__":
    main()
