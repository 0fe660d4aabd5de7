#!/usr/bin/env python3
"""Errors of engines by motions known in closed form (motions.py, scenes/exact), and how they fall with the step.

Usage: docs/tables/exact.py [SCENE ...]: largest and rms error by engine and step, of all scenes or these."""
import functools
import math
import pathlib
import sys

if __name__ == "__main__":
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from tables import motions, programs  # noqa: E402

STEP_S, STEPS_PER_FRAME = 0.01, 5  # of each scene
PARTS = (1, 2, 4, 8, 16)  # of a step
ENGINES = {"sor": ("--stepper", "sor"), "sor, law ode": ("--stepper", "sor", "--law", "ode"),
           **{name: ("--stepper", name) for name in ("quick", "direct", "bullet", "mujoco")}}
ROUNDING_M = 1e-9  # errors below it have no order
# One process without a daemon: Open MPI then starts in a tenth of the time.
ALONE = ("env", "OMPI_MCA_ess_singleton_isolated=1", "OMPI_MCA_btl=self", "OMPI_MCA_pml=ob1")


def record(scene, parts, path, *options):
    """Writes the run of exact/SCENE, with its steps divided into `parts`, to `path`; frames stay 0.05 s."""
    programs.run([*ALONE, f"OMPI_MCA_orte_tmpdir_base={path.parent}", programs.BIN / "pbmpi", "--scene", f"exact/{scene}", *options,
                  "--dt", STEP_S / parts, "--steps-per-frame", STEPS_PER_FRAME * parts, "--output", path, "--no-xdmf", "--quiet"])


def errors(scene, *options, parts=PARTS):
    """(largest, rms) error [m] for each division of the step."""
    found = []
    with programs.Folder() as folder:
        for count in parts:
            path = folder / f"{count}.h5"
            record(scene, count, path, *options)
            found.append(motions.error(path, scene))
    return found


def order(coarse, fine, times_finer):
    """By which power of the step the error falls; NaN within rounding."""
    return math.log(coarse / fine, times_finer) if min(coarse, fine) > ROUNDING_M else math.nan


@functools.cache
def engines():
    """The names of ENGINES that the build has."""
    text = " ".join(programs.pbmpi("--help", "all").split())
    lacking = text.split("Steppers of other engines: ")[1].split("Options:")[0].partition("not in this build: ")[2]
    return [name for name in ENGINES if name not in lacking]


def cell(scene, name):
    largest = [error[0] for error in errors(scene, *ENGINES[name], parts=(1, 4, 16))]
    falls = order(*largest[1:], 4)
    return f"{programs.millimetres(largest[0])} ({'-' if math.isnan(falls) else f'{falls:.1f}'.replace('-0.0', '0.0')})"


def table():
    """Largest error [mm] at each engine's default and the scene's step, and in brackets the order below a quarter of it."""
    rows = [[f"`{scene}`", *(cell(scene, name) if name in engines() else "-" for name in ENGINES)] for scene in motions.MOTIONS]
    return programs.table(["error [mm] (order)", *(f"`{name}`" if name != "sor, law ode" else "`sor`, law ode" for name in ENGINES)], rows)


def main():
    for scene in sys.argv[1:] or motions.MOTIONS:
        for name in engines():
            found = errors(scene, *ENGINES[name])
            largest, rms = (" ".join(f"{1e3 * error:9.3g}" for error in kind) for kind in zip(*found))
            print(f"{scene:14} {name:13} largest [mm] {largest}   rms [mm] {rms}   order {order(found[2][0], found[4][0], 4):.2f}", flush=True)


if __name__ == "__main__":
    main()
