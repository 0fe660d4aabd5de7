"""The nine scenes, and those of effects, have the bits that golden_hashes.txt lists, with every instruction set of the
machine, and on a CPU that has none above SSE2. What changes them is a change of results: then the list is written anew
(PBMPI_WRITE_GOLDEN_HASHES=1 in the environment), and the commit says why.

Nothing that a state depends on is left to a library that has other code for other CPUs, to the kind of CPU, or to the
compiler: with PBMPI_EMULATOR, a command that runs the programs of PBMPI_BIN, those of a cross build by clang++ are compared
(tests/gates.sh arm64)."""
import concurrent.futures
import itertools
import json
import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import EFFECT_SCENES, PBMPI, SCENES, ProgramTest  # noqa: E402

LIST = os.path.join(os.path.dirname(os.path.abspath(__file__)), "golden_hashes.txt")
EMULATOR = os.environ.get("PBMPI_EMULATOR", "").split()
# 5,000 boxes that are awake take an emulated CPU minutes.
TRIED = tuple(scene for scene in SCENES + EFFECT_SCENES if not (EMULATOR and scene == "Warehouse"))
RUNS_AT_ONCE = 4  # a run waits for most of its time until MPI is up
HEAD = "# State hash of each scene after its frames under sor: scene, precision, hash. Written by test_golden.py.\n"


def golden():
    with open(LIST, encoding="utf-8") as file:
        rows = [line.split() for line in file if not line.startswith("#")]
    return {(scene, precision): state_hash for scene, precision, state_hash in rows}


class GoldenHashes(ProgramTest):
    def hash_of(self, scene, precision, simd, before=EMULATOR):
        """`before`: what runs the program. None if its CPU lacks the instruction set."""
        result = self.run_command([*before, PBMPI, "--scene", scene, "--stepper", "sor", "--precision", precision,
                                   "--simd", simd, "--no-output", "--report", "json"])
        if result.returncode == 2 and "lacks the instruction set" in result.stderr:
            return None
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["state_hash"]

    def test_every_scene_has_its_hash_with_every_instruction_set(self):
        cases = list(itertools.product(TRIED, ("double", "single"), ("off", "sse2", "avx2", "avx512")))
        with concurrent.futures.ThreadPoolExecutor(RUNS_AT_ONCE) as pool:
            hashes = dict(zip(cases, pool.map(lambda case: self.hash_of(*case), cases)))
        found = {(scene, precision): hashes[scene, precision, "off"] for scene, precision, _ in cases}
        for scene, precision, simd in cases:
            self.assertIn(hashes[scene, precision, simd], (None, found[scene, precision]), (scene, precision, simd))
        if os.environ.get("PBMPI_WRITE_GOLDEN_HASHES"):
            with open(LIST, "w", encoding="utf-8") as file:
                file.write(HEAD)
                file.writelines(f"{scene} {precision} {found[scene, precision]}\n" for scene, precision in found)
        expected = {case: state_hash for case, state_hash in golden().items() if case[0] in TRIED}
        self.assertEqual(found.keys(), expected.keys())
        for case, state_hash in found.items():
            self.assertEqual(state_hash, expected[case], case)

    # QEMU's CPUs pick other code in the C library, too: without AVX and FMA, and with both.
    @unittest.skipIf(EMULATOR, "the CPU is another one already")
    @unittest.skipUnless(shutil.which("qemu-x86_64-static"), "needs Debian's qemu-user-static")
    def test_other_cpus_have_the_same_hashes(self):
        cases = list(itertools.product(("CrashSk", "CrashWa"), ("double", "single"), ("Nehalem", "Haswell")))
        with concurrent.futures.ThreadPoolExecutor(RUNS_AT_ONCE) as pool:
            hashes = list(pool.map(lambda case: self.hash_of(*case[:2], "auto", ("qemu-x86_64-static", "-cpu", case[2])),
                                   cases))
        for (scene, precision, cpu), emulated in zip(cases, hashes):
            self.assertEqual(emulated, golden()[scene, precision], (cpu, scene, precision))


if __name__ == "__main__":
    unittest.main()
