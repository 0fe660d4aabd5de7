"""What tests of hulls and of meshes ask alike."""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402


class SceneTest(ProgramTest):
    def refused(self, scene, *words):
        """`scene`: its name or file."""
        result = self.pbmpi(1, "--scene", scene, "--frames", 1, "--no-output")
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_one_hash(self, *args):
        """Three worlds have one hash for ranks, threads and instruction sets."""
        one = self.summary(1, *args, "--replicas", 3)["state_hash"]
        self.assertEqual(self.summary(2, *args, "--replicas", 3)["state_hash"], one)
        self.assertEqual(self.summary(3, *args, "--replicas", 3)["state_hash"], one)
        self.assertEqual(self.summary(1, *args, "--replicas", 3, "--threads", 3)["state_hash"], one)
        for simd in ("off", "sse2", "avx2", "avx512"):
            result = self.pbmpi(1, *args, "--replicas", 3, "--simd", simd, "--report", "json")
            if result.returncode == 2 and "lacks the instruction set" in result.stderr:
                continue  # not this machine's
            self.assertEqual(json.loads(result.stdout)["state_hash"], one, simd)
