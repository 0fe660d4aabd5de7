"""Every scene has one hash in each of many settings: for 1 to 4 ranks, as whole worlds and cut into spaces, with every
instruction set. More than a thousand runs in all, of few frames each.

`--ranks 2,3` starts these alone, no other instruction sets, and in each scene every third setting, another third in the next:
the form for programs with sanitizers, whose reports count as failures."""
import concurrent.futures
import json
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import AT_ONCE, ODE_LAW, EFFECT_SCENES, SCENES, ProgramTest  # noqa: E402

SOR = {
    "default": (),
    "single": ("--precision", "single"),
    "seed 2": ("--seed", 2),
    "solver seed 3, single": ("--solver-seed", 3, "--precision", "single"),
    "law ode": ODE_LAW,
    "law ode, 4 x 2, single": (*ODE_LAW, "--substeps", 4, "--iterations", 2, "--precision", "single"),
    "4 x 2": ("--substeps", 4, "--iterations", 2),
    "law coulomb": ("--stepper", "sor", "--law", "coulomb", "--iterations", 2),
    "half the step": ("--dt", 0.005),
    "sleeping": ("--effects", "+sleeping,+drag"),
    "tolerance": ("--tolerance", "0.1mm"),
    "approach": ("--approach", "5cm", "--effects", "+sleeping"),
    "field of interest": ("--effects", "+field_of_interest,+restitution"),
}
ODE = {"quick": SCENES + EFFECT_SCENES, "direct": ("2-Cars", "CrashSk", "100CrSk")}  # the big matrix of the others takes minutes
SIMDS = ("off", "sse2", "avx2", "avx512")
RUNS_AT_ONCE = 3  # a run waits for most of its time until MPI is up
FEW = ("--frames", 4, "--warmup", 1, "--no-output", "--report", "json")


RANKS = None
if "--ranks" in sys.argv:
    at = sys.argv.index("--ranks")
    RANKS = tuple(map(int, sys.argv[at + 1].split(",")))
    del sys.argv[at:at + 2]


class ManyHashes(ProgramTest):
    def setUp(self):
        super().setUp()
        self.runs = 0

    def hash_of(self, ranks, args):
        # Two runs that begin at once would make the same folder for their sessions, and one would fail.
        with tempfile.TemporaryDirectory(dir=self.folder) as session:
            result = self.pbmpi(ranks, *args, *FEW, env={**os.environ, **AT_ONCE, "OMPI_MCA_orte_tmpdir_base": session})
        self.runs += 1
        if result.returncode == 2 and "lacks the instruction set" in result.stderr:
            return None
        self.assertEqual(result.returncode, 0, (args, result.stderr))
        self.assertNotIn("runtime error", result.stderr)
        return json.loads(result.stdout)["state_hash"]

    def one_hash(self, what, cases):
        """`cases`: ranks and arguments, which must all lead to one hash."""
        with concurrent.futures.ThreadPoolExecutor(RUNS_AT_ONCE) as pool:
            hashes = list(pool.map(lambda case: self.hash_of(*case), cases))
        known = {state_hash for state_hash in hashes if state_hash is not None}
        self.assertEqual(len(known), 1, (what, list(zip(cases, hashes))))

    def test_ranks_and_cuts_leave_every_hash(self):
        for i, scene in enumerate(SCENES + EFFECT_SCENES):
            for name, options in list(SOR.items())[i % 3::3] if RANKS else SOR.items():
                with self.subTest(scene=scene, setting=name):
                    args = ("--scene", scene, "--replicas", 3 if scene == "100CrSk" else 1, *options)
                    self.one_hash((scene, name), [(ranks, (*args, "--decompose", cut)) for ranks in RANKS or (1, 2, 3, 4)
                                                  for cut in ("worlds", "spaces") if scene != "100CrSk" or cut == "worlds"])
        print(self.runs, "runs of sor")

    def test_ranks_leave_every_hash_of_ODE(self):
        for stepper, scenes in ODE.items():
            for scene in scenes:
                with self.subTest(scene=scene, stepper=stepper):
                    worlds = 3 if scene in ("2-Cars", "CrashSk", "100CrSk") else 1
                    args = ("--scene", scene, "--stepper", stepper, "--replicas", worlds)
                    self.one_hash((scene, stepper), [(ranks, args) for ranks in RANKS or (1, 2, 3, 4)])
        print(self.runs, "runs of ODE's steppers")

    @unittest.skipIf(RANKS, "instruction sets are not asked for")
    def test_instruction_sets_leave_every_hash(self):
        for scene in SCENES:
            for name in ("default", "single", "law ode"):
                with self.subTest(scene=scene, setting=name):
                    args = ("--scene", scene, *SOR[name])
                    cuts = ("worlds",) if scene == "100CrSk" else ("worlds", "spaces")
                    self.one_hash((scene, name), [(ranks, (*args, "--simd", simd, "--decompose", cut))
                                                  for simd in SIMDS for ranks in (1, 2) for cut in cuts])
        print(self.runs, "runs over instruction sets")


if __name__ == "__main__":
    unittest.main()
