"""Times how long a scene file of 10,000 bodies takes to load and describe, five times.

Usage: load.py [PBMPI], with PBMPI the program (default: build/release/bin/pbmpi).
"""
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))

from many_bodies import many_bodies  # noqa: E402

NUM_BODIES = 10_000


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build" / "release" / "bin" / "pbmpi")
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "many.toml"
        scene.write_text(many_bodies(NUM_BODIES), encoding="utf-8")
        for _ in range(5):
            start = time.perf_counter()
            subprocess.run([program, "--scene", scene, "--describe"], check=True, stdout=subprocess.DEVNULL)
            print(f"{NUM_BODIES} bodies loaded and described in {time.perf_counter() - start:.2f} s")


if __name__ == "__main__":
    main()
