"""Meshes of triangles and height fields: what rests on them, rolls over them and is shot at them, with the same bits everywhere."""
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SOURCE  # noqa: E402
from scene_test import SceneTest  # noqa: E402

TERRAIN = os.path.join(SOURCE, "scenes", "models", "terrain.toml")


def grid(cells, cell_m, height):
    """Points and triangles, two for each cell, about the origin."""
    n = cells + 1
    points = [[(i - cells / 2) * cell_m, (j - cells / 2) * cell_m, height((i - cells / 2) * cell_m, (j - cells / 2) * cell_m)]
              for j in range(n) for i in range(n)]
    triangles = [triangle for j in range(cells) for i in range(cells)
                 for triangle in ([j * n + i, j * n + i + 1, (j + 1) * n + i], [j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i])]
    return points, triangles


def obj(points, triangles):
    return "".join("v {} {} {}\n".format(*point) for point in points) + "".join("f {} {} {}\n".format(*(c + 1 for c in one)) for one in triangles)


def mesh(points, triangles, keys=""):
    return f'[[actor]]\nname = "land"\ntype = "mesh"\npoints = {points}\ntriangles = {triangles}\n{keys}\n'


def actor(name, kind, place, keys):
    return f'[[actor]]\nname = "{name}"\ntype = "{kind}"\nposition = {list(place)}\n{keys}\n'


class Surfaces(SceneTest):
    def positions(self, scene, *args):
        """Of all bodies, frame by frame."""
        self.write("scene.toml", 'title = "t"\n' + scene)
        self.summary(1, "--scene", "scene.toml", *args, "--quiet", "--output", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            return file["particles/bodies/position/value"][:]

    def refused_text(self, text, *words):
        self.write("scene.toml", 'title = "t"\n' + text)
        self.refused("scene.toml", *words)

    def test_terrain_has_one_hash_for_ranks_threads_instruction_sets_and_spaces(self):
        args = ("--scene", TERRAIN, "--stepper", "sor", "--frames", 45, "--quiet", "--no-output")
        self.assert_one_hash(*args)
        whole = self.summary(1, *args)["state_hash"]
        self.assertEqual(self.summary(2, *args, "--decompose", "spaces")["state_hash"], whole)

    def test_the_car_of_the_terrain_crosses_it_and_the_rest_lies_still(self):
        for stepper in ("sor", "quick"):
            self.summary(1, "--scene", TERRAIN, "--stepper", stepper, "--quiet", "--output", "run.h5")
            with h5py.File(self.path("run.h5")) as file:
                names = list(file["particles/bodies/name"].asstr()[:])
                positions, speeds = file["particles/bodies/position/value"][:], np.linalg.norm(file["particles/bodies/velocity/value"][-1], axis=1)
            way = positions[:, names.index("car.chassis")]
            self.assertGreater(way[-1, 0] - way[0, 0], 12, stepper)
            self.assertLess(np.ptp(way[:, 1]), 1.5, stepper)
            self.assertLess(np.abs(np.diff(way[:, 0], 2)).max(), 0.03, stepper)  # no frame in which it is held back
            for name in ("box", "stone"):
                self.assertLess(speeds[names.index(name)], 0.05, (stepper, name))
            for name in ("ball", "box", "stone"):
                self.assertGreater(positions[-1, names.index(name), 2], -0.6, (stepper, name))

    def test_a_ball_rolls_over_a_level_mesh_as_over_a_plane(self):
        ball = actor("ball", "sphere", (-3.7, 0.13, 0.2), "radius = 0.2\ndensity = 1000\nvelocity = [2, 0.3, 0]")
        level = mesh(*grid(24, 0.4, lambda x, y: 0.0))
        for stepper in ("sor", "quick"):
            args = ("--stepper", stepper, "--frames", 90)
            on_plane = self.positions('[[actor]]\nname = "land"\ntype = "ground"\nmaterial = { mu = 0.5 }\n' + ball, *args)
            on_mesh = self.positions(level + ball, *args)
            self.assertGreater(np.ptp(on_plane[:, 0, 0]), 3)
            # Besides rounding, what differs is by how much the kernels for planes and for hulls differ.
            np.testing.assert_allclose(on_mesh, on_plane, atol=1e-9)

    def test_solids_slide_over_a_level_mesh_as_over_a_plane(self):
        solids = (actor("box", "box", (-3.7, 1.1, 0.15), "size = [0.5, 0.4, 0.3]\ndensity = 1000\nvelocity = [4, 0.3, 0]") +
                  actor("drum", "cylinder", (-3.7, -1.1, 0.2), "radius = 0.3\nlength = 0.4\ndensity = 1000\nvelocity = [4, 0.3, 0]") +
                  actor("hull", "hull", (-3.7, -2.3, 0.15), "points = " + str([[x, y, z] for x in (-.25, .25) for y in (-.2, .2) for z in (-.15, .15)]) +
                        "\ndensity = 1000\nvelocity = [4, 0.3, 0]"))
        on_plane = self.positions('[[actor]]\nname = "land"\ntype = "ground"\nmaterial = { mu = 0.5 }\n' + solids, "--stepper", "sor", "--frames", 60)
        on_mesh = self.positions(mesh(*grid(24, 0.4, lambda x, y: 0.0)) + solids, "--stepper", "sor", "--frames", 60)
        self.assertGreater(np.ptp(on_plane[:, :, 0], axis=0).min(), 1)
        # The four points on which a solid stands are others of the same face, so that friction differs a little.
        np.testing.assert_allclose(on_mesh, on_plane, atol=0.02)
        np.testing.assert_allclose(on_mesh[:, :, 2], on_plane[:, :, 2], atol=2e-4)

    def test_a_car_steers_over_a_level_mesh_as_over_a_plane(self):
        car = actor("car", "car", (-42, 0.37, 0), "speed = 20\ndrive_torque = 300\nsteering = [[0, 0], [1, 4], [2, -4]]")
        args = ("--stepper", "sor", "--frames", 90)
        on_plane = self.positions('[[actor]]\nname = "land"\ntype = "ground"\n' + car, *args)
        on_mesh = self.positions(mesh(*grid(60, 1.5, lambda x, y: 0.0), "material = { mu = 0.9 }") + car, *args)
        self.assertGreater(np.ptp(on_plane[:, 0, 0]), 50)
        np.testing.assert_allclose(on_mesh, on_plane, atol=0.05)  # less than a thousandth of its way
        np.testing.assert_allclose(on_mesh[:, :, 2], on_plane[:, :, 2], atol=1e-3)

    def test_a_projectile_stops_at_it(self):
        wall = mesh(*grid(20, 0.25, lambda x, y: 0.0), "rotation = { axis = [0, 1, 0], angle = -90 }\nposition = [10, 0, 2]")
        ball = actor("ball", "sphere", (0, 0.1, 2), "radius = 0.1\ndensity = 7800\nvelocity = [300, 3, 0]")
        for stepper in ("sor", "quick", "direct"):
            way = self.positions(wall + ball, "--stepper", stepper, "--frames", 10)
            self.assertLess(way[:, 0, 0].max(), 10, stepper)
            self.assertGreater(way[:, 0, 0].max(), 9.5, stepper)

    def test_nothing_passes_rough_ground_however_it_comes(self):
        drawn = np.random.default_rng(3)
        ground = mesh(*grid(20, 0.5, lambda x, y: round(drawn.uniform(-0.1, 0.1), 3)))
        hull = "points = [[-0.1, -0.1, -0.1], [0.15, -0.1, -0.1], [0, 0.15, -0.1], [0, 0, 0.15]]"
        kinds = (("sphere", "radius = 0.1"), ("box", "size = [0.3, 0.2, 0.1]"), ("capsule", "radius = 0.06\nlength = 0.3"),
                 ("cylinder", "radius = 0.15\nlength = 0.1"), ("hull", hull))
        shots = ""
        for i in range(40):
            kind, shape = kinds[i % len(kinds)]
            along, up = drawn.uniform(0, 6.28), drawn.uniform(0.4, 1.5)
            way = np.array([np.cos(along) * np.cos(up), np.sin(along) * np.cos(up), -np.sin(up)])
            start = np.append(drawn.uniform(-2, 2, 2), 0) - drawn.uniform(2, 5) * way
            shots += actor(f"{kind}{i}", kind, start.round(3).tolist(),
                           f"{shape}\ndensity = 2000\nvelocity = {(300 * way).round(2).tolist()}\nrotation = {{ axis = [1, {i}, 0.3], angle = {17 * i} }}")
        way = self.positions("overlap = inf\n" + ground + shots, "--stepper", "sor", "--frames", 20)
        above = np.abs(way[:, :, :2]).max(axis=2) < 4.9
        self.assertGreater(above.sum(), 40)
        self.assertGreater(way[:, :, 2][above].min(), -0.2)

    def test_a_room_holds_what_bounces_in_it(self):
        corners = [[x, y, z] for z in (0, 4) for y in (-3, 3) for x in (-3, 3)]
        sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))  # their fronts inside
        room = mesh(corners, [[side[0], side[i], side[i + 1]] for side in sides for i in (1, 2)], "material = { mu = 0.3, restitution = 0.9 }")
        drawn = np.random.default_rng(5)
        things = ""
        for i in range(20):
            kind, shape = (("sphere", "radius = 0.15"), ("box", "size = [0.3, 0.2, 0.25]"))[i % 2]
            velocity = (20 * (lambda v: v / np.linalg.norm(v))(drawn.normal(size=3))).round(2).tolist()
            things += actor(f"{kind}{i}", kind, [-2 + i % 5, -1.5 + i // 5, 2],
                            f"{shape}\ndensity = 500\nvelocity = {velocity}\nmaterial = {{ mu = 0.2, restitution = 0.9 }}")
        for stepper in ("sor", "quick"):
            way = self.positions(room + things, "--stepper", stepper, "--frames", 150)
            self.assertLess(np.abs(way[:, :, :2]).max(), 3, stepper)
            self.assertLess(np.abs(way[:, :, 2] - 2).max(), 2, stepper)

    def test_files_have_its_triangles_and_pages_draw_it(self):
        points, triangles = grid(4, 1.0, lambda x, y: 0.1 * x * y)
        os.makedirs(self.path("land"))
        self.write("land/hills.obj", obj(points, triangles))
        ball = actor("ball", "sphere", (0.2, 0.1, 0.5), "radius = 0.2\ndensity = 1000")
        from_file = self.positions('[[actor]]\nname = "land"\ntype = "mesh"\nfile = "land/hills.obj"\n' + ball, "--frames", 10)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(list(file["geoms/shape"].asstr()[:]), ["mesh", "sphere"])
            corners, size = file["hulls/corners"][:] + file["geoms/position"][0], file["geoms/size"][0]
            np.testing.assert_allclose(corners, np.array(points)[triangles], atol=1e-12)
            np.testing.assert_allclose(size, [4, 4, 0.8], atol=1e-12)
        self.assertEqual(self.report("run.h5", "--html", "run.html").returncode, 0)
        self.drawn("run.html")
        np.testing.assert_array_equal(self.positions(mesh(points, triangles) + ball, "--frames", 10), from_file)
        heights = [[0.1 * x * y for x in range(-2, 3)] for y in range(-2, 3)]
        field = f'[[actor]]\nname = "land"\ntype = "heightfield"\nsize = [4, 4]\nheights = {heights}\n'
        np.testing.assert_allclose(self.positions(field + ball, "--frames", 10), from_file, atol=1e-12)

    def test_other_engines_refuse_it(self):
        self.write("scene.toml", 'title = "t"\n' + mesh(*grid(2, 1.0, lambda x, y: 0.0)) + actor("ball", "sphere", (0, 0, 1), "radius = 0.2\ndensity = 1000"))
        for stepper in ("bullet", "mujoco"):
            result = self.pbmpi(1, "--scene", "scene.toml", "--stepper", stepper, "--dt", 0.0025, "--frames", 1, "--no-output")
            self.assertEqual(result.returncode, 2, result.stderr)
            if "this build has no" not in result.stderr and "was built without" not in result.stderr:
                self.assertIn("a mesh of triangles or a height field is not there", result.stderr)

    def test_what_is_wrong_with_it_is_told_with_its_place(self):
        ball = actor("ball", "sphere", (0, 0, 1), "radius = 0.2\ndensity = 1000")
        self.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")
        self.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n")
        self.write("huge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 200001)
        corners = "points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]"
        for keys, *words in (
                ('type = "mesh"\nfile = "none.obj"', "scene.toml:", "none.obj"),
                ('type = "mesh"\nfile = "../land.obj"', "scene.toml:", "folder of the scene's file"),
                ('type = "mesh"\nfile = "empty.obj"', "scene.toml:", "no triangles"),
                ('type = "mesh"\nfile = "nan.obj"', "scene.toml:", "not finite"),
                ('type = "mesh"\nfile = "huge.obj"', "scene.toml:", "200001 triangles"),
                ('type = "mesh"', "scene.toml:", "'points'", "'file'"),
                (f'type = "mesh"\n{corners}', "scene.toml:", "triangles"),
                (f'type = "mesh"\n{corners}\ntriangles = [[0, 1, 3]]', "scene.toml:", "no point 3"),
                (f'type = "mesh"\n{corners}\ntriangles = [[0, 1, 1]]', "scene.toml:", "no triangles"),
                ('type = "heightfield"\nsize = [1, 1]\nheights = [[0, 0]]', "scene.toml:", "at least 2 rows"),
                ('type = "heightfield"\nsize = [1, 1]\nheights = [[0, 0], [0]]', "scene.toml:", "as many numbers"),
                ('type = "heightfield"\nsize = [1, 1]\nheights = [[0, inf], [0, 0]]', "scene.toml:", "finite"),
                ('type = "heightfield"\nsize = [1, 0]\nheights = [[0, 0], [0, 0]]', "scene.toml:", "above 0"),
                (f'type = "mesh"\n{corners}\ntriangles = [[0, 1, 2]]\nvelocity = [1, 0, 0]', "scene.toml:", "velocity")):
            self.refused_text(f'[[actor]]\nname = "land"\n{keys}\n' + ball, *words)


if __name__ == "__main__":
    unittest.main(verbosity=2)
