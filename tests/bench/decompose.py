#!/usr/bin/env python3
"""One world cut into spaces: runs each scene whole on one rank, cut on one rank and cut on two, in turn, and prints the
medians of the ratios of their frame rates, beside the bounds that root's section and the largest island set. "best" is the
ratio of the fastest runs: what is left of it on a machine that others use, too.

usage: decompose.py [ROUNDS] [SCENE,SCENE ...] [pbmpi options ...]
"""
import json
import os
import statistics
import subprocess
import sys

BIN = os.environ.get("PBMPI_BIN", os.path.join(os.path.dirname(__file__), "..", "..", "build", "release", "bin"))
SCENES = "CrashWa,Environ,Battle,Fight,Battle2"


def run(ranks, scene, decompose, options):
    command = ["mpirun", "-n", str(ranks), os.path.join(BIN, "pbmpi"), "--scene", scene, "--stepper", "sor",
               "--frames", "40", "--no-output", "--report", "json", "--decompose", decompose, *options]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measure(scene, rounds, options):
    one, two, bounds, serial, best = [], [], [], [], [0, 0, 0]
    for _ in range(rounds):
        whole, cut, parallel = (run(1, scene, "worlds", options), run(1, scene, "spaces", options),
                                run(2, scene, "spaces", options))
        if not whole["state_hash"] == cut["state_hash"] == parallel["state_hash"]:
            sys.exit(f"decompose.py: {scene}: the hashes differ")
        rates = [summary["frame_rate"]["harmonic_mean_hz"] for summary in (whole, cut, parallel)]
        best = [max(pair) for pair in zip(best, rates)]
        one.append(rates[1] / rates[0])
        two.append(rates[2] / rates[1])
        bounds.append(parallel["spaces"]["island_bound"])
        serial.append(parallel["spaces"]["serial_share"])
    bound = statistics.median(bounds)
    print(f"{scene:8s} two ranks against one {statistics.median(two):.3f} (min {min(two):.3f}, max {max(two):.3f}, "
          f"best {best[2] / best[1]:.3f}), bound {bound:.2f} (largest island, root's section {100 * statistics.median(serial):.1f} %), "
          f"{100 * statistics.median(two) / bound:.0f} % of it; one rank cut against whole {statistics.median(one):.3f} "
          f"(best {best[1] / best[0]:.3f}); "
          f"{whole['simd']}; hash {whole['state_hash']}", flush=True)


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    scenes = (sys.argv[2] if len(sys.argv) > 2 else SCENES).split(",")
    for scene in scenes:
        measure(scene, rounds, sys.argv[3:])


if __name__ == "__main__":
    main()
