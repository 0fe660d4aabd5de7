#!/usr/bin/env python3
"""Two ranks against one on a scene: runs them in turn, prints the median of the ratios of their frame rates.

usage: ranks.py [SCENE] [ROUNDS] [pbmpi options ...]
"""
import json
import os
import statistics
import subprocess
import sys

BIN = os.environ.get("PBMPI_BIN", os.path.join(os.path.dirname(__file__), "..", "..", "build", "release", "bin"))


def frame_rate(ranks, scene, options):
    """(harmonic-mean frame rate [Hz], state hash) of one run."""
    command = ["mpirun", "-n", str(ranks), os.path.join(BIN, "pbmpi"), "--scene", scene, "--frames", "20", "--no-output",
               "--report", "json", *options]
    summary = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return summary["frame_rate"]["harmonic_mean_hz"], summary["state_hash"]


def main():
    scene = sys.argv[1] if len(sys.argv) > 1 else "100CrSk"
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 7
    ratios = []
    for _ in range(rounds):
        one, hash_of_one = frame_rate(1, scene, sys.argv[3:])
        two, hash_of_two = frame_rate(2, scene, sys.argv[3:])
        if hash_of_one != hash_of_two:
            sys.exit(f"ranks.py: the hashes differ: {hash_of_one}, {hash_of_two}")
        ratios.append(two / one)
    print(f"{scene} {' '.join(sys.argv[3:])}: two ranks against one: median {statistics.median(ratios):.3f} "
          f"(min {min(ratios):.3f}, max {max(ratios):.3f}) of {rounds}  hash {hash_of_one}")


if __name__ == "__main__":
    main()
