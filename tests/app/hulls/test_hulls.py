"""Convex hulls: a pile of stones with the same bits everywhere, meshes from files, and what is wrong with them."""
import os
import re
import struct
import sys
import tomllib
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SOURCE  # noqa: E402
from scene_test import SceneTest  # noqa: E402

STONES = os.path.join(SOURCE, "scenes", "models", "stones.toml")
# The corners of a cube of 2 m, and the two triangles of each of its faces, counter-clockwise as seen from outside.
CORNERS = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
TRIANGLES = [(side[0], side[i], side[i + 1]) for side in SIDES for i in (1, 2)]


def binary_stl(triangles):
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in triangle for x in CORNERS[corner]), 0) for triangle in triangles)
    return b"cube".ljust(80) + struct.pack("<I", len(triangles)) + body


def text_stl(triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex {} {} {}\n".format(*CORNERS[c]) for c in triangle) +
                     "endloop\nendfacet\n" for triangle in triangles)
    return f"solid cube\n{facets}endsolid cube\n"


def obj():
    return ("".join("v {} {} {}\n".format(*corner) for corner in CORNERS) +
            "".join("f " + " ".join(f"{corner + 1}//1" for corner in side) + "\n" for side in SIDES))


def scene(actor):
    return f"""title = "t"
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "one"
position = [0, 0, 1]
{actor}
"""


def hull(keys):
    return scene(f'type = "hull"\ndensity = 1000\n{keys}')


def with_hulls(text):
    """A scene with a hull of eight points in place of each box."""
    def points(size):
        x, y, z = (float(side) / 2 for side in size.group(1).split(","))
        return f"points = {[[i * x, j * y, k * z] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]}"

    actors = re.split(r"(?m)^(?=\[\[)", text)
    return "".join(re.sub(r"size = \[([^\]]*)\]", points, actor.replace('type = "box"', 'type = "hull"')) if 'type = "box"' in actor else actor
                   for actor in actors)


MJCF = """<mujoco><compiler meshdir="parts"/><asset><mesh name="cube" file="cube.stl" scale=".1 .1 .2"/></asset>
<worldbody><geom type="plane" size="1 1 1"/><body name="b" pos="0 0 .5"><freejoint/><geom type="mesh" mesh="cube"/></body></worldbody></mujoco>
"""
URDF = """<robot name="r"><link name="base"><inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1"/></inertial>
<collision><geometry><mesh filename="package://parts/cube.stl" scale=".1 .1 .1"/></geometry></collision></link></robot>
"""


class Hulls(SceneTest):
    def write_bytes(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(content)

    def mass(self, name):
        self.summary(1, "--scene", name, "--frames", 1, "--quiet", "--output", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            bodies = file["particles/bodies"]
            return bodies["mass"][0], bodies["inertia"][0]

    def test_stones_have_one_hash_for_ranks_threads_and_instruction_sets(self):
        args = ("--scene", STONES, "--stepper", "sor", "--frames", 30, "--quiet", "--no-output")
        self.assert_one_hash(*args)

    def test_a_world_cut_into_spaces_has_the_hash_of_the_whole_one(self):
        with open(STONES, encoding="utf-8") as file:
            text = file.read()
        spaces = text.replace('title = "a pile of stones"', 'title = "a pile of stones"\nspaces = ["a", "b"]')
        for i, name in enumerate(("stone40", "stone20", "stone12", "stone8", "stone5")):
            spaces = spaces.replace(f'name = "{name}"', f'name = "{name}"\nspace = "{"ab"[i % 2]}"')
        self.write("stones.toml", spaces)
        args = ("--scene", "stones.toml", "--stepper", "sor", "--frames", 40, "--quiet", "--no-output")
        whole = self.summary(1, *args)
        cut = self.summary(2, *args, "--decompose", "spaces")
        self.assertEqual(cut["state_hash"], whole["state_hash"])

    def test_stones_come_to_rest(self):
        for stepper in ("sor", "quick"):
            summary = self.summary(1, "--scene", STONES, "--stepper", stepper, "--quiet", "--output", "run.h5")
            self.assertEqual(summary["invariants"]["nonfinite_bodies"], 0, stepper)
            with h5py.File(self.path("run.h5")) as file:
                bodies = file["particles/bodies"]
                speed = np.linalg.norm(bodies["velocity/value"][-1], axis=1)
                self.assertLess(speed.max(), 0.05, stepper)
                self.assertGreater(bodies["position/value"][-1, :, 2].min(), 0.05, stepper)

    def test_cases_at_rest_hold_with_hulls_in_place_of_boxes(self):
        for case in ("column10", "card_house", "kapla_tower", "plank_arch", "pyramid15"):
            with open(os.path.join(SOURCE, "scenes", "hard", "rest", case + ".toml"), encoding="utf-8") as file:
                text = file.read()
            self.write("case.toml", with_hulls(text))
            self.summary(1, "--scene", "case.toml", "--stepper", "sor", "--dt", 0.01, "--steps-per-frame", 10, "--frames", 100, "--quiet",
                         "--output", "run.h5")
            bounds = tomllib.loads(text)["case"]["bounds"]
            with h5py.File(self.path("run.h5")) as file:
                self.assertEqual(set(file["geoms/shape"].asstr()[:]), {"plane", "hull"})
                bodies = file["particles/bodies"]
                drift = np.linalg.norm(bodies["position/value"][:] - bodies["initial_position"][:], axis=2)
                speed = np.linalg.norm(bodies["velocity/value"][20:], axis=2)
            self.assertLess(drift.max(), bounds["drift"][0], case)
            self.assertLess(speed.max(), bounds["speed"][0], case)

    def test_engines_step_them_that_this_build_has(self):
        for stepper in ("direct", "bullet", "mujoco"):
            args = () if stepper == "direct" else ("--dt", 0.0025, "--steps-per-frame", 12)
            result = self.pbmpi(1, "--scene", STONES, "--stepper", stepper, *args, "--frames", 45, "--quiet", "--output", "run.h5")
            if "this build has no" in result.stderr or "was built without" in result.stderr:
                continue
            self.assertEqual(result.returncode, 0, result.stderr)
            with h5py.File(self.path("run.h5")) as file:
                heights = file["particles/bodies/position/value"][-1, :, 2]
            self.assertGreater(heights.min(), 0.0, stepper)

    def test_files_have_the_surface_of_each_hull_once_in_a_world_and_pages_draw_it(self):
        self.summary(2, "--scene", STONES, "--replicas", 2, "--frames", 3, "--quiet", "--output", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            of_geom, owner, corners = file["geoms/hull"][:], file["hulls/geom"][:], file["hulls/corners"][:]
            body = file["geoms/body"][:]
            mass = file["particles/bodies/mass"][:]
        self.assertEqual(len(of_geom), 2 * 21)
        self.assertEqual(sorted(set(of_geom)), [-1, 1, 5, 9, 13, 17, 22, 26, 30, 34, 38])
        volumes = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        for geom in range(1, 21):
            self.assertAlmostEqual(2500 * volumes[owner == of_geom[geom]].sum() / mass[body[geom]], 1, delta=1e-12)
        self.assertEqual(self.report("run.h5", "--html", "run.html").returncode, 0)
        self.drawn("run.html")

    def test_meshes_of_all_formats_are_the_same_cube(self):
        self.write_bytes("parts/cube.stl", binary_stl(TRIANGLES))
        self.write_bytes("parts/text.stl", text_stl(TRIANGLES).encode())
        self.write_bytes("parts/cube.obj", obj().encode())
        self.write_bytes("parts/BINARY.STL", binary_stl(TRIANGLES))
        self.write_bytes("parts/LINES.OBJ", obj().encode())
        for file in ("cube.stl", "text.stl", "cube.obj", "BINARY.STL", "LINES.OBJ"):
            self.write("cube.toml", hull(f'file = "parts/{file}"\nscale = [0.5, 0.5, 1]'))
            mass, inertia = self.mass("cube.toml")
            self.assertAlmostEqual(mass, 2000, delta=1e-9)
            np.testing.assert_allclose(inertia, np.diag([2000 / 12 * 5, 2000 / 12 * 5, 2000 / 12 * 2]), atol=1e-9)

    def test_a_run_goes_on_without_its_mesh(self):
        self.write_bytes("parts/cube.stl", binary_stl(TRIANGLES))
        self.write("cube.toml", hull('file = "parts/cube.stl"'))
        whole = self.summary(1, "--scene", "cube.toml", "--frames", 8, "--no-output", "--quiet")
        self.summary(1, "--scene", "cube.toml", "--frames", 4, "--no-output", "--quiet", "--checkpoint", "run.ck.h5")
        os.remove(self.path("parts/cube.stl"))
        rest = self.summary(1, "--resume", "run.ck.h5", "--frames", 8, "--no-output", "--quiet")
        self.assertEqual(rest["state_hash"], whole["state_hash"])

    def test_models_have_meshes(self):
        self.write_bytes("parts/cube.stl", binary_stl(TRIANGLES))
        self.write("cube.xml", MJCF)
        mass, inertia = self.mass("cube.xml")
        self.assertAlmostEqual(mass, 16, delta=1e-9)  # 1000 kg/m3 x 0.2 x 0.2 x 0.4 m
        np.testing.assert_allclose(np.diag(inertia), [16 / 12 * 0.2, 16 / 12 * 0.2, 16 / 12 * 0.08], atol=1e-9)
        self.write_bytes("urdf/r.urdf", URDF.encode())
        self.summary(1, "--scene", "urdf/r.urdf", "--frames", 2, "--quiet", "--no-output")

    def test_what_is_wrong_with_points_or_a_mesh_is_told_with_its_place(self):
        self.write_bytes("parts/cube.stl", binary_stl(TRIANGLES)[:-7])
        self.write_bytes("parts/huge.stl", b"huge".ljust(80) + struct.pack("<I", 1000001) + bytes(50 * 1000001))
        self.write_bytes("parts/flat.stl", binary_stl(TRIANGLES[:2]))
        for keys, *words in (
                ("points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]", "scene.toml:", "at least 4 points"),
                ("points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]", "scene.toml:", "in one plane"),
                ("points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, nan, 1]]", "scene.toml:", "finite"),
                ("vertices = 3\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]", "scene.toml:", "vertices"),
                ("", "scene.toml:", "'points'", "'file'"),
                ('file = "parts/none.stl"', "scene.toml:", "none.stl"),
                ('file = "../cube.stl"', "scene.toml:", "folder of the scene's file"),
                ('file = "parts/cube.stl"', "scene.toml:", "truncated", "12 triangles"),
                ('file = "parts/huge.stl"', "scene.toml:", "more than 1000000 triangles"),
                ('file = "parts/flat.stl"', "scene.toml:", "in one plane")):
            self.write("scene.toml", hull(keys))
            self.refused("scene.toml", *words)
        self.write("cube.xml", MJCF)
        self.refused("cube.xml", "cube.xml:1:", "truncated")
        self.write("none.xml", MJCF.replace("cube.stl", "../../none.stl"))
        self.refused("none.xml", "none.xml:1:", "below it")
        self.write("dae.xml", MJCF.replace("cube.stl", "cube.dae"))
        self.refused("dae.xml", "dae.xml:1:", "STL or OBJ")
        self.write("unknown.xml", MJCF.replace('mesh="cube"', 'mesh="cub"'))
        self.refused("unknown.xml", "unknown.xml:2:", "did you mean")

    def test_describe_says_what_a_hull_leaves_out(self):
        self.write("stone.toml", hull("vertices = 6\npoints = " + str([list(corner) for corner in CORNERS])))
        result = self.pbmpi(1, "--scene", "stone.toml", "--describe")
        self.assertRegex(result.stdout, r"note: .*stone.toml:.*a hull of 6 vertices, out of which others stick by up to [0-9.]+ m")


if __name__ == "__main__":
    unittest.main(verbosity=2)
