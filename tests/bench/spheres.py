"""What friction costs falling spheres: `tests/bench/spheres.py [REPEATS]`, after jobs/build.sh.

64 worlds of 64 spheres that fall on the ground and on each other. By `pbstudy effects`: rough, with friction left out,
and smooth, with friction demanded though nothing calls for it. Nothing else should run on the machine.
"""
import json
import os
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = os.environ.get("PBMPI_BIN", os.path.join(SOURCE, "build/release/bin"))
SIDE = 4  # spheres, in each of three directions


def scene(mu):
    """Spheres of 0.3 m, a little out of line, and in each world a little elsewhere."""
    text = (f'title = "falling spheres, mu = {mu}"\n[run]\nreplicas = 64\nwarmup = 20\nframes = 20\n'
            f'[[actor]]\nname = "ground"\ntype = "ground"\nmaterial = {{ mu = {mu} }}\n')
    for i in range(SIDE ** 3):
        x, y, z = i % SIDE, i // SIDE % SIDE, i // SIDE ** 2
        shift = 0.02 * (i * 7 % 5)
        text += (f'[[actor]]\nname = "s{i}"\ntype = "sphere"\nradius = 0.3\nmass = 1\nmaterial = {{ mu = {mu} }}\n'
                 f'position = [{0.61 * x + shift:.2f}, {0.61 * y - shift:.2f}, {0.35 + 0.62 * z:.2f}]\n'
                 f'variation = {{ position = [0.01, 0.01, 0] }}\n')
    return text


def study(folder, mu, repeats):
    """{stepper: row of friction} of the scene."""
    path = os.path.join(folder, f"spheres{mu}.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene(mu))
    out = path + ".h5"
    subprocess.run([os.path.join(BIN, "pbstudy"), "effects", "--scene", path, "--effect", "friction", "--precision",
                    "double", "single", "--repeats", str(repeats), "--floor-seeds", "1", "--quiet", "-o", out], check=True)
    report = subprocess.run([os.path.join(BIN, "pbreport"), out, "--json"], check=True, capture_output=True, text=True)
    return {one["stepper"]: one for one in json.loads(report.stdout)["scenes"]}


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory(prefix="pbmpi-bench-") as folder:
        rough, smooth = study(folder, 0.5, repeats), study(folder, 0, repeats)
    print("falling spheres, 64 worlds of 64: friction's share of a step, median [p10, p90], and the speed without it")
    for stepper, one in rough.items():
        left_out, demanded = one["effects"][0], smooth[stepper]["effects"][0]
        share, idle = left_out["share"], demanded["share"]
        bits = "no bit changes" if demanded["same_bits"] else "THE RESULT CHANGES"
        print(f"  {stepper:10}  rough: {share['median']:6.1%} [{share['p10']:.1%}, {share['p90']:.1%}], speed without x "
              f"{1 / (1 - share['median']):.2f}   smooth, demanded: {idle['median']:6.1%} [{idle['p10']:.1%}, "
              f"{idle['p90']:.1%}], speed without x {1 / (1 - idle['median']):.2f}; {bits}")


if __name__ == "__main__":
    main()
