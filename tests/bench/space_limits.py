#!/usr/bin/env python3
"""What root's section of a step costs for each body, space, pair of spaces, and contact across spaces: steps scenes made
for the purpose on two ranks, fits, and prints how much of each fills half a step of the paper's budget.

usage: space_limits.py
"""
import os
import subprocess
import tempfile

import h5py
import numpy

BIN = os.environ.get("PBMPI_BIN", os.path.join(os.path.dirname(__file__), "..", "..", "build", "release", "bin"))
STEPS = 3
RUNS = 5
HALF_STEP_S = 0.1 / 30 / STEPS / 2  # half of a step that meets the budget of 10 % of 1/30 s

HEAD = """title = "boxes in spaces"
spaces = [{spaces}]
[[actor]]
name = "ground"
type = "ground"
"""
BOX = """[[actor]]
name = "b{name}"
type = "box"
size = [0.5, 0.5, 0.5]
mass = 1
position = [{x}, {y}, {z}]
space = "s{space}"
"""


def scene(spaces):
    """Boxes at rest; `spaces`: the positions of the boxes of each."""
    text = HEAD.format(spaces=", ".join(f'"s{i}"' for i in range(len(spaces))))
    for space, boxes in enumerate(spaces):
        for i, (x, y, z) in enumerate(boxes):
            text += BOX.format(name=f"{space}_{i}", x=x, y=y, z=z, space=space)
    return text


def root_section(folder, spaces):
    """Seconds of root in cross_space and gather, a step; the least of some runs, since noise only adds."""
    path = os.path.join(folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene(spaces))
    output = os.path.join(folder, "run.h5")
    times = []
    for _ in range(RUNS):  # of two frames each, after which spaces would change their owner
        subprocess.run(["mpirun", "-n", "2", os.path.join(BIN, "pbmpi"), "--scene", path, "--stepper", "sor", "--decompose",
                        "spaces", "--warmup", "0", "--frames", "2", "--substeps", "1", "--output", output, "--quiet"],
                       check=True)
        with h5py.File(output) as run:
            rank = run["timings/rank"]
            times.append((rank["cross_space"][1, 0] + rank["gather"][1, 0]) / STEPS)
    return min(times)


def row(count, y=0.0, x=0.0, z=0.25):
    return [(x + 2.0 * i, y, z) for i in range(count)]


def main():
    with tempfile.TemporaryDirectory() as folder:
        apart = [(spaces, boxes) for spaces in (2, 16, 64, 256) for boxes in (2, 8, 16)]
        times = [root_section(folder, [row(boxes, y=3.0 * i) for i in range(spaces)]) for spaces, boxes in apart]
        # Half of the bodies are another rank's. Weighted, so that small cases count as much as large ones.
        terms = numpy.array([[1, s * b / 2, s, s * (s - 1) / 2] for s, b in apart])
        weight = 1 / numpy.array(times)
        fixed, body, space, pair = numpy.linalg.lstsq(terms * weight[:, None], numpy.array(times) * weight, rcond=None)[0]
        between = root_section(folder, [row(400), row(400, x=1.0)])
        on_top = root_section(folder, [row(400), row(400, z=0.74)])
    candidate = (between - fixed - 400 * body - 2 * space - pair) / 800
    touching = (on_top - between) / 400
    print(f"a step {1e6 * fixed:.1f} us, a body of another rank {1e9 * body:.0f} ns, a space {1e9 * space:.0f} ns, a pair of "
          f"spaces {1e9 * pair:.1f} ns, a body in another space's box {1e9 * candidate:.0f} ns, a pair of bodies that touch "
          f"across spaces {1e9 * touching:.0f} ns")
    print(f"half a step of {2e3 * HALF_STEP_S:.2f} ms is filled by {HALF_STEP_S / body:.0f} bodies of other ranks, by "
          f"{(2 * HALF_STEP_S / pair) ** 0.5:.0f} spaces, by {HALF_STEP_S / candidate:.0f} bodies in boxes of other spaces, or "
          f"by {HALF_STEP_S / touching:.0f} pairs that touch across spaces")


if __name__ == "__main__":
    main()
