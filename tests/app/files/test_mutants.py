"""Hundreds of slightly wrong files: none ends a reader by a signal, in MPI_ABORT or bad_alloc, or in a wrong result.

usage: test_mutants.py [--mutants N]: N scenes, a third of that of each other kind, and a tenth of files that reports in Python read, which
take half a second each; without it 200, and a twentieth. A mutant depends on its number alone, and a failure names it. What once failed
stands in the folder mutants beside this file, one file a case, and is tried each time."""
import glob
import os
import random
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import AT_ONCE, BIN, PBMPI, PBREPORT, SOURCE, ProgramTest, alone, number_argument, seal  # noqa: E402

PBSTUDY = os.path.join(BIN, "pbstudy")
LIMIT_S = 60  # a hang: each of these takes a fraction of a second
PYTHON_SHARE = 10 if "--mutants" in sys.argv else 20  # of files that reports in Python read
MUTANTS = number_argument("--mutants", 200)
CORPUS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "mutants")
NASTY = [b"0", b"-1", b"1e300", b"-1e-300", b"nan", b"inf", b"-inf", b"2147483647", b"-2147483648", b"9007199254740993",
         b"9223372036854775807", b"18446744073709551616", b"1e9999", b"0x7fffffff", b'""', b'"\xc3\xa9"', b'"\\u0000"', b"true",
         b"[]", b"[0]", b"[[0, 1], [0, 2]]", b"{}", b"1979-05-27", b"'x'", b"", b"1_000", b"0.1.2", b"-0.0", b"1e-9", b"100000"]
CONFIG = (b"frames = 4\nwarmup = 1\niterations = 3\nsubsteps = 2\nlaw = soft\nstepper = sor\nseed = 7\nbudget = 3ms\n"
          b"decompose = worlds\neffects = +drag\nprecision = single\nsteps-per-frame = 2\ndt = 0.005\nrecord-every = 2\n")
# Tables of parameters, by what their names end in.
TABLES = {"csv": b'car.speed,ground.material.mu,human1.height,car.position\n5,0.3,,"[0, 0, 1]"\n10,0.3,1.6,\n10,0.9,1.7,"[1, 2, 1.5]"\n',
          "toml": b"[[world]]\ncar.speed = 5\nhuman1.height = 1.6\n[[world]]\ncar.position = [1, 2, 1.5]\nground.material.mu = 0.3\n"}
BAD_ENDS = re.compile("MPI_ABORT|bad_alloc|what\\(\\)|std::|Segmentation|runtime error|AddressSanitizer")


def mutated_text(draw, text):
    """One to three changes of lines, values or bytes."""
    for _ in range(draw.randint(1, 3)):
        kind = draw.randrange(7)
        lines = text.split(b"\n")
        at = draw.randrange(len(lines))
        values = list(re.finditer(rb"[-+]?[0-9][0-9.e+-]*|\"[^\"\n]*\"", text))
        if kind <= 2 and values:
            value = draw.choice(values)
            text = text[:value.start()] + draw.choice(NASTY) + text[value.end():]
        elif kind == 3:
            del lines[at]
            text = b"\n".join(lines)
        elif kind == 4:
            lines.insert(draw.randrange(len(lines)), lines[at])
            text = b"\n".join(lines)
        elif kind == 5:
            place = draw.randrange(len(text) + 1)
            text = text[:place] + draw.randbytes(draw.randint(1, 4)) + text[place:]
        else:
            place = draw.randrange(len(text) + 1)
            text = text[:place] + text[place + draw.randint(1, 40):]
        if not text:
            return b"\n"
    return text


def mutated_bytes(draw, data):
    """A flipped bit, another number, zeros, or less of the file; mostly where it describes itself."""
    data = bytearray(data)
    at = draw.randrange(min(len(data), 60_000) if draw.random() < 0.7 else len(data))
    kind = draw.randrange(6)
    if kind <= 2:
        data[at] ^= 1 << draw.randrange(8)
    elif kind == 3:
        number = draw.choice([0, 1, 2**31 - 1, 2**32 - 1, 2**40, 2**63, 2**64 - 1, draw.getrandbits(64)])
        data[at:at + 8] = number.to_bytes(8, "little")[:len(data) - at]
    elif kind == 4:
        length = min(draw.choice([1, 8, 64, 512, 4096]), len(data) - at)
        data[at:at + length] = bytes(length)
    else:
        del data[at:]
    return bytes(data)


class Mutants(ProgramTest):
    def setUp(self):
        super().setUp()
        self.alone = {**alone(self.folder), **AT_ONCE}
        self.scenes = self.texts(f"{SOURCE}/scenes/*.toml", f"{SOURCE}/scenes/hard/*/*.toml")
        self.models = self.texts(f"{SOURCE}/scenes/models/*.xml", f"{SOURCE}/scenes/models/*.urdf")

    def texts(self, *patterns):
        texts = []
        for path in sorted(path for pattern in patterns for path in glob.glob(pattern)):
            with open(path, "rb") as file:
                texts.append(file.read())
        return texts

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def save(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)

    def ends_well(self, command, what):
        """The result, whose exit code is one of the program's own, with a message if it is not 0."""
        result = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=LIMIT_S, check=False,
                                env=self.alone)
        errors = result.stderr.decode(errors="replace")
        self.assertIn(result.returncode, (0, 2), f"{what}: {command}: {errors}")
        self.assertIsNone(BAD_ENDS.search(errors), f"{what}: {errors}")
        if result.returncode == 2:
            program = os.path.basename(command[0])
            self.assertTrue(errors.startswith(program + ": "), f"{what}: {errors}")
        return result

    def try_scene(self, text, what):
        self.save("mutant.toml", text)
        self.try_worlds(["--scene", "mutant.toml"], what)

    def try_worlds(self, args, what):
        described = self.ends_well([PBMPI, *args, "--describe"], what)
        bodies = re.search(rb"worlds: (\d+), bodies: (\d+)", described.stdout)
        if described.returncode != 0 or int(bodies[2]) > 2000:
            return
        # The run may fail over numbers that are not finite (exit code 1), and must say so.
        one_world = [] if "--parameters" in args else ["--replicas", "1"]
        result = self.run_command([PBMPI, *args, *one_world, "--iterations", "2", "--warmup", "0", "--frames", "1",
                                   "--steps-per-frame", "2", "--no-output"], errors="replace", env=self.alone)
        self.assertIn(result.returncode, (0, 1, 2), f"{what}: {result.stderr}")
        self.assertIsNone(BAD_ENDS.search(result.stderr), f"{what}: {result.stderr}")
        self.assertTrue(result.returncode == 0 or "pbmpi: " in result.stderr, what)

    def test_scenes(self):
        for number in range(MUTANTS):
            draw = random.Random(f"scene {number}")
            self.try_scene(mutated_text(draw, draw.choice(self.scenes)), f"scene {number}")

    def test_models(self):
        for number in range(MUTANTS // 3):
            draw = random.Random(f"model {number}")
            self.try_scene(mutated_text(draw, draw.choice(self.models)), f"model {number}")

    def test_scenes_that_once_failed(self):
        paths = sorted(path for end in ("toml", "xml", "urdf") for path in glob.glob(os.path.join(CORPUS, f"*.{end}")))
        self.assertGreater(len(paths), 5)
        for path in paths:
            with open(path, "rb") as file:
                self.try_scene(file.read(), os.path.basename(path))

    def test_tables_of_parameters(self):
        for number in range(MUTANTS // 3):
            draw = random.Random(f"table {number}")
            end = draw.choice(sorted(TABLES))
            self.save(f"table.{end}", mutated_text(draw, TABLES[end]))
            self.try_worlds(["--scene", "CrashSk", "--parameters", f"table.{end}"], f"table {number}")

    def try_config(self, text, what):
        self.save("mutant.cfg", text)
        self.ends_well([PBMPI, "--scene", "CrashSk", "--describe", "--config", "mutant.cfg"], what)

    def test_configs(self):
        for number in range(MUTANTS // 3):
            self.try_config(mutated_text(random.Random(f"config {number}"), CONFIG), f"config {number}")

    def test_configs_that_once_failed(self):
        for path in sorted(glob.glob(os.path.join(CORPUS, "*.cfg"))):
            with open(path, "rb") as file:
                self.try_config(file.read(), os.path.basename(path))

    def try_files(self, name, command, sealed, share=3):
        """`command` is refused over a mutant of the file `name`, or says what it says over the file itself. With `sealed`
        half of the mutants have a checksum that fits: of those it is only asked that they end well. One mutant
        for every `share` of the scenes."""
        reference = self.ends_well(command, "the file itself")
        self.assertEqual(reference.returncode, 0, reference.stderr)
        whole = self.read(name)
        refused = 0
        for number in range(MUTANTS // share):
            draw = random.Random(f"{name} {number}")
            what = f"{name} {number}"
            forged = sealed and number % 2 == 1
            self.save(name, mutated_bytes(draw, whole[:-24] if forged else whole))
            if forged:
                seal(self.path(name))
            result = self.ends_well(command, what)
            refused += result.returncode == 2
            if result.returncode == 0 and not forged:
                self.assertEqual(result.stdout, reference.stdout, what)
        self.assertGreater(refused, MUTANTS // (7 * share))
        self.save(name, whole)

    def test_files_of_runs(self):
        self.assertEqual(self.pbmpi(2, "--scene", "CrashSk", "--replicas", 2, "--decompose", "worlds", "--feec",
                                    "--record", "residuals", "--output", "run.h5", "--quiet").returncode, 0)
        self.try_files("run.h5", [PBREPORT, "run.h5", "--json"], False)

    def test_files_of_runs_that_are_handed_on(self):
        args = ["--scene", "CrashSk", "--record", "contacts", "--quiet"]
        for more in (["--frames", 3, "--output", "run.h5", "--checkpoint", "run.ck.h5"],
                     ["--frames", 3, "--solver-seed", 2, "--output", "other.h5"]):
            self.assertEqual(self.pbmpi(1, *args, *more).returncode, 0)
        self.assertEqual(self.pbmpi(1, "--resume", "run.ck.h5", "--frames", 5, "--record", "contacts", "--output", "rest.h5",
                                    "--quiet").returncode, 0)
        for command in (["csv", "run.h5"], ["csv", "run.h5", "--table", "contacts"], ["csv", "run.h5", "--table", "events"],
                        ["ensemble", "run.h5", "other.h5", "--json"], ["join", "run.h5", "rest.h5", "-o", "all.h5"]):
            self.try_files("run.h5", [PBREPORT, *command], False, PYTHON_SHARE)

    def test_files_of_studies(self):
        result = self.run_command([PBSTUDY, "effects", "--scene", "2-Cars", "--effect", "gravity", "friction", "--repeats", "1",
                                   "--frames", "1", "--warmup", "0", "--floor-seeds", "1", "-o", "study.h5", "-q"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.try_files("study.h5", [PBREPORT, "study.h5", "--json"], True)

    def test_checkpoints(self):
        self.assertEqual(self.pbmpi(1, "--scene", "CrashSk", "--frames", 2, "--no-output", "--checkpoint", "run.ck.h5",
                                    "--quiet").returncode, 0)
        shutil.copy(self.path("run.ck.h5"), self.path("whole.ck.h5"))
        self.try_files("run.ck.h5", [PBMPI, "--resume", "run.ck.h5", "--frames", "4", "--describe"], True)


if __name__ == "__main__":
    unittest.main()
