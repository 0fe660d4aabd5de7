"""The count of models that run: those that come with pbmpi do, and others are counted by their reason."""
import os
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BOX = "<body><freejoint/><geom size='1'/></body>"
OTHERS = {
    "runs.xml": f"<mujoco><worldbody>{BOX}</worldbody></mujoco>",
    "still.xml": "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>",
    "medium.xml": f"<mujoco><option density='1'/><worldbody>{BOX}</worldbody></mujoco>",
    "soft.xml": "<mujoco><worldbody><flexcomp/></worldbody></mujoco>",
    "deep/sdf.xml": "<mujoco><worldbody><body><freejoint/><geom type='sdf'/></body></worldbody></mujoco>",
    "notes.xml": "<notes/>",
}


class ModelFiles(unittest.TestCase):
    def counted(self, folder):
        script = os.path.join(SOURCE, "docs", "model_files.py")
        return subprocess.run([sys.executable, script, folder], capture_output=True, text=True, check=True)

    def test_models_that_come_with_pbmpi_run(self):
        self.assertEqual(self.counted(os.path.join(SOURCE, "scenes", "models")).stdout, "| files, of 3 | |\n|---|---|\n| 3 | run |\n")

    def test_others_are_counted_by_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "deep"))
            for name, text in OTHERS.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            result = self.counted(folder)
        self.assertEqual(result.stdout.splitlines()[2:], [
            "| 1 | run |", "| 1 | have nothing that moves |", "| 1 | move in a medium |",
            "| 1 | have shapes or meshes of other kinds, or bodies whose mass is not given |"])
        self.assertEqual(result.stdout.splitlines()[0], "| files, of 4 | |")
        self.assertIn("medium.xml: ", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
