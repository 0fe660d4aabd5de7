"""What a field of interest saves and costs: `tests/bench/interest.py [REPEATS]`, after jobs/build.sh.

Environ, of which what is within 10 m of the car gets all iterations, by `pbstudy effects`: the same frames with the
effect and without, in turn. Nothing else should run on the machine.
"""
import json
import os
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = os.environ.get("PBMPI_BIN", os.path.join(SOURCE, "build/release/bin"))
SCENE = 'title = "Environ, round the car"\nbase = "Environ"\n[interest]\nfollows = "car"\nradius = {}\n'


def study(folder, radius_m, repeats):
    path = os.path.join(folder, f"Environ{radius_m}.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(SCENE.format(radius_m))
    out = path + ".h5"
    subprocess.run([os.path.join(BIN, "pbstudy"), "effects", "--scene", path, "--effect", "field_of_interest",
                    "--precision", "double", "single", "--repeats", str(repeats), "--floor-seeds", "2", "--quiet",
                    "-o", out], check=True)
    report = subprocess.run([os.path.join(BIN, "pbreport"), out, "--json"], check=True, capture_output=True, text=True)
    return json.loads(report.stdout)["scenes"]


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    with tempfile.TemporaryDirectory(prefix="pbmpi-bench-") as folder:
        for radius_m in (10, 1):
            print(f"Environ, all iterations within {radius_m} m of the car, elsewhere 4: time of a step with x that without")
            for one in study(folder, radius_m, repeats):
                effect = one["effects"][0]
                with_s, without_s = (effect["time_s"][side] for side in ("with", "without"))
                defect = effect["defect"]["body_position_m"]
                print(f"  {one['stepper']:10}  {with_s['median'] / without_s['median']:.2f}   "
                      f"({1e6 * with_s['median']:.0f} us; share {effect['share']['median']:.1%} "
                      f"[{effect['share']['p10']:.1%}, {effect['share']['p90']:.1%}])   defect rms "
                      f"{1e3 * defect['rms']:.2f} mm, noise floor {1e3 * one['noise_floor']['defect_m']:.2f} mm")


if __name__ == "__main__":
    main()
