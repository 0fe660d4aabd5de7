#!/usr/bin/env python3
"""Makes a short film of a scene, as an animated WebP: docs/animation.py [SCENE FILE], by default Battle2 and docs/images/Battle2.webp.

Runs the scene, makes its page, and renders each frame (jobs/stills.sh, so Chromium is needed, and Pillow); it plays at half speed. PBMPI_BIN: another folder of
the programs.
"""
import argparse
import pathlib
import sys

from PIL import Image

from tables import programs

# Where to look from: position and target of the camera, x,y,z each [m].
CAMERAS = {"Battle2": "9,-15,9,0.5,0,0.3"}
SIZE = (600, 300)
FRAMES = 48
SLOWER = 2  # than the scene
LARGEST_BYTES = 2_000_000


def stills(scene, folder):
    """The pictures of a run, in order."""
    run, page = folder / "run.h5", folder / "run.html"
    programs.pbmpi("--scene", scene, "--frames", FRAMES, "--quiet", "--no-xdmf", "--output", run)
    programs.pbreport(run, "--quiet", "--html", page)
    camera = ["--camera", CAMERAS[scene]] if scene in CAMERAS else []
    size = "x".join(map(str, SIZE))
    names = programs.run([programs.SOURCE / "jobs/stills.sh", "--bare", "--size", size, *camera, page, folder, *range(FRAMES + 1)])
    return [Image.open(name).convert("RGB") for name in names.split()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default="Battle2")
    parser.add_argument("file", nargs="?", type=pathlib.Path, default=programs.SOURCE / "docs/images/Battle2.webp")
    arguments = parser.parse_args()
    with programs.Folder() as folder:
        first, *others = stills(arguments.scene, folder)
    pause = [int(1000 * SLOWER / 30)] * len(others) + [900]
    first.save(arguments.file, save_all=True, append_images=others, duration=pause, loop=0, quality=70, method=6)
    size = arguments.file.stat().st_size
    print(f"{arguments.file}: {size / 1000:.0f} kB")
    return int(size > LARGEST_BYTES)


if __name__ == "__main__":
    sys.exit(main())
