"""What the tests of the Python package share: pbmpi's own programs beside the package."""
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests" / "app"))

from harness import PBMPI, ProgramTest  # noqa: E402

# An arm that a motor turns, at a speed that differs from world to world, and a ball that falls.
ARM = """title = "a driven arm"
[[actor]]
name = "arm"
type = "box"
size = [1, 0.1, 0.1]
mass = 2
position = [0.5, 0, 1]
variation = { velocity = [0, 0, 0.5] }
[[joint]]
name = "shoulder"
kind = "hinge"
bodies = ["arm", "world"]
anchor = [0, 0, 1]
axis = [0, 0, 1]
motor = { velocity = 1, max_force = 50 }
[[actor]]
name = "loose"
type = "sphere"
radius = 0.1
mass = 1
position = [3, 0, 1]
"""


class PackageTest(ProgramTest):
    """A test in an empty folder of its own."""

    def state_hash(self, *args):
        """What pbmpi prints at the end of a run."""
        return self.json(self.run_command([PBMPI, *map(str, args), "--no-output", "--report", "json"]))["state_hash"]
