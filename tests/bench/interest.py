"""What a field of interest saves and costs: `tests/bench/interest.py [REPEATS]`, after jobs/build.sh.

Environ, of which what is within 10 m of the car, or of the tank, gets all iterations, by `pbstudy effects`: the same
frames with the effect and without, in turn. By quick: sor has one iteration a substep, of which nothing can be saved.
Nothing else should run on the machine.
"""
import json
import os
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = os.environ.get("PBMPI_BIN", os.path.join(SOURCE, "build/release/bin"))
RADIUS_M = 10


def study(folder, actor, repeats):
    path = os.path.join(folder, f"{actor}.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'title = "Environ, round the {actor}"\nbase = "Environ"\n[interest]\nfollows = "{actor}"\n'
                   f'radius = {RADIUS_M}\n')
    out = path + ".h5"
    subprocess.run([os.path.join(BIN, "pbstudy"), "effects", "--scene", path, "--effect", "field_of_interest",
                    "--stepper", "quick", "--repeats", str(repeats), "--floor-seeds", "2", "--quiet",
                    "-o", out], check=True)
    report = subprocess.run([os.path.join(BIN, "pbreport"), out, "--json"], check=True, capture_output=True, text=True)
    return json.loads(report.stdout)["scenes"]


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    with tempfile.TemporaryDirectory(prefix="pbmpi-bench-") as folder:
        for actor in ("car", "tank"):
            print(f"Environ, all iterations within {RADIUS_M} m of the {actor}, elsewhere 4: time of a step against that "
                  "without, median [p10, p90]")
            for one in study(folder, actor, repeats):
                effect = one["effects"][0]
                ratio = {name: 1 / (1 - share) for name, share in effect["share"].items()}
                defect = effect["defect"]["body_position_m"]
                print(f"  {one['stepper']:10}  x {ratio['median']:.2f} [{ratio['p10']:.2f}, {ratio['p90']:.2f}]   defect rms "
                      f"{1e3 * defect['rms']:.1f} mm, noise floor {1e3 * one['noise_floor']['defect_m']:.1f} mm")


if __name__ == "__main__":
    main()
