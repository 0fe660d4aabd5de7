"""Reads a run with h5py, pandas and an XML parser, as io/SCHEMA.md tells users to.
usage: read_test.py MPIEXEC RUN_WRITER SCHEMA.md"""
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import h5py
import numpy as np

import sample_check

NUM_NECKS = 20  # one joint between two bodies in each of run_writer's worlds


def datasets(path):
    """Path -> values, hard links included (h5py's own visitor names an object once)."""
    def walk(group):
        for item in group.values():
            if isinstance(item, h5py.Group):
                yield from walk(item)
            else:
                yield item.name, item[()]
    with h5py.File(path, "r") as f:
        return dict(walk(f))


def same_for_any_ranks_and_placement(mpiexec, writer, folder):
    """All but the per-rank columns are the same bytes."""
    of_ranks = ("/ranks/", "/timings/rank/", "/checksums/timings.rank.",
                "/estimate/compute", "/checksums/estimate.compute")
    reference = None
    for ranks, move in ((1, 0), (2, 0), (2, 3), (3, 1), (4, 2)):
        path = os.path.join(folder, "same.h5")
        result = sample_check.run_writer(mpiexec, ranks, writer, path, 12, 12, 2, move=move)
        assert result.returncode == 0, result.stderr
        assert sample_check.check(path) == 12
        found = {k: v for k, v in datasets(path).items() if not k.startswith(of_ranks)}
        if reference is None:
            reference = found
        assert found.keys() == reference.keys()
        for name, values in found.items():
            assert values.dtype == reference[name].dtype and values.tobytes() == reference[name].tobytes(), (name, ranks)


def schema_examples(schema, path):
    """Runs the Python of io/SCHEMA.md on this file and returns its variables."""
    with open(schema) as text:
        blocks = re.findall(r"```python\n(.*?)```", text.read(), re.S)
    assert len(blocks) == 4, "one example for h5py, one for pandas, one for contacts, one for the hash"
    hashing = blocks.pop(2 if "state_hash" in blocks[2] else 3)
    assert len(hashing.splitlines()) <= 35, "the hash: tests/io/judge_test.py calls it"
    variables = {}
    for block in blocks:
        assert len(block.strip().splitlines()) == 3, "a three-liner"
        exec(block.replace("100CrSk.h5", path), variables)
    return variables


def schema_names_all(schema, path):
    """The paths in the schema's tables of a run's file are those in the file, in which nothing has a hull."""
    with open(schema) as text:
        of_runs = text.read().split("\n# ")[0]
    of_hulls = {"/geoms/hull", "/hulls/geom", "/hulls/corners"}
    listed = set(re.findall(r"^\| `(/[^`]*)`", of_runs, re.M))
    assert of_hulls <= listed
    listed -= of_hulls
    present = {p for p in datasets(path) if not p.startswith("/parameters/") and not re.fullmatch("/observables/.*/(value|step|time)", p)}
    assert present == listed, (sorted(present - listed), sorted(listed - present))


def is_ascii(attributes, name):
    kind = h5py.h5a.open(attributes._id, name.encode()).get_type()
    return isinstance(kind, h5py.h5t.TypeStringID) and kind.get_cset() == h5py.h5t.CSET_ASCII


def follows_h5md(path):
    """The rules of H5MD 1.1 (nongnu.org/h5md/h5md.html) and of its module units 1.0, as far as they say "must"."""
    def is_element(group):
        """Time-dependent data: value, with step and time of its first extent; the units of value and time."""
        if not isinstance(group, h5py.Group) or "value" not in group:
            return False
        value, step, time = group["value"], group["step"], group["time"]
        assert step.dtype.kind in "iu" and step.shape == value.shape[:1] and np.all(np.diff(step[:].astype(int)) > 0), group.name
        assert time.dtype.kind == "f" and time.shape == value.shape[:1] and np.all(np.diff(time[:]) > 0), group.name
        assert time.attrs["unit"] == b"s", group.name
        return True

    with h5py.File(path, "r") as f:
        h5md = f["h5md"]
        assert h5md.attrs["version"].dtype.kind == "i" and list(h5md.attrs["version"]) == [1, 1]
        assert h5md["author"].attrs["name"] and h5md["creator"].attrs["name"] and h5md["creator"].attrs["version"]
        units = h5md["modules/units"]
        assert list(units.attrs["version"]) == [1, 0] and units.attrs["system"] == b"SI"
        for group in f["particles"].values():
            box = group["box"]
            assert box.attrs["dimension"] == 3 and list(box.attrs["boundary"]) == [b"none"] * 3
            assert "edges" not in box.attrs and "edges" not in box, "only a periodic box has edges"
            assert is_element(group["position"]) and group["position/value"].shape[1:] == (len(group["id"]), 3)
            for name in ("velocity", "orientation", "angular_velocity"):
                assert is_element(group[name]) and group[name]["value"].shape[1] == len(group["id"])
            assert group["mass"].shape == group["id"].shape and len(set(group["id"][:])) == len(group["id"])
        elements = {name for name, group in f["observables"].items() if is_element(group)}
        tables = {name: set(group) for name, group in f["observables"].items() if name not in elements}
        expected = {("joint_" if table == "joint" else "") + column: f"{table}/{column}" for table in tables for column in tables[table]}
        assert elements == set(expected) and {"energy", "joint_force", "bodies_inside"} <= elements
        for name, column in expected.items():
            assert f["observables"][name]["value"] == f["observables"][column], "one dataset under two names"
        ids = set(f["particles/bodies/id"][:])
        for bonds in f["connectivity"].values():
            assert bonds.dtype.kind == "i" and bonds.ndim == 2 and set(bonds[:].ravel()) <= ids
            assert f[bonds.attrs["particles_group"]] == f["particles/bodies"]
        between_two = f["joints/body_b"][:] >= 0
        joined = np.stack([f["joints/body_a"][:], f["joints/body_b"][:]], axis=1)[between_two]
        assert np.array_equal(f["connectivity/joints"][:], joined) and len(joined) == NUM_NECKS
        with_unit = []
        f.visititems(lambda name, thing: with_unit.append(thing) if "unit" in thing.attrs else None)
        assert len(with_unit) > 30
        for thing in with_unit:
            assert is_ascii(thing.attrs, "unit"), thing.name
            for factor in thing.attrs["unit"].decode().split(" "):
                assert re.fullmatch("(kg|m|s|rad|N|J|B)-?[1-9]?", factor), (thing.name, factor)


def attributes_are_there(path):
    with h5py.File(path, "r") as f:
        assert f.attrs["filetype"].decode() == "pbmpi-run" and list(f.attrs["version"]) == [1, 8]
        assert f.attrs["complete"] == 1 and f.attrs["state_hash"].decode() == "0123456789abcdef"
        assert list(f["h5md"].attrs["version"]) == [1, 1] and f["h5md/creator"].attrs["name"] == b"pbmpi"
        assert f["particles/bodies/position/value"].attrs["unit"] == b"m"
        assert f["particles/bodies/velocity/step"] == f["particles/bodies/position/step"], "one dataset, linked"
        assert list(f["particles/bodies/box"].attrs["boundary"]) == [b"none"] * 3
        names = f["particles/bodies/name"].asstr()[:]
        assert names[0] == "human1.left_upper_arm_é0" and names[-1] == "human1.b8"
        assert f["parameters/scene_text"].asstr()[()].startswith("[[actor]]")
        assert f["events"].attrs["num_events"] == 3 == len(f["events/kind"]) and f["events"].attrs["num_dropped"] == 0


def xdmf_points_into(path):
    """Each referenced dataset exists with the dimensions that the sidecar states, and the slabs lie in it."""
    root = ElementTree.parse(path + ".xdmf").getroot()
    assert root.tag == "Xdmf" and root.get("Version") == "3.0"
    grids = root.findall("./Domain/Grid[@CollectionType='Temporal']/Grid")
    with h5py.File(path, "r") as f:
        times = f["particles/bodies/position/time"][:]
        assert [float(g.find("Time").get("Value")) for g in grids] == list(times), "17 digits read back exactly"
        for row, grid in enumerate(grids):
            assert int(grid.find("Topology").get("NumberOfElements")) == len(f["particles/bodies/id"])
            for item in grid.iter("DataItem"):
                dims = [int(d) for d in item.get("Dimensions").split()]
                if item.get("Type") == "HyperSlab":
                    slab, source = list(item)
                    start, stride, count = np.array(slab.text.split(), dtype=int).reshape(3, 3)
                    assert list(start) == [row, 0, 0] and list(stride) == [1, 1, 1]
                    assert list(count) == [1] + dims
                    assert all(start + count <= [int(d) for d in source.get("Dimensions").split()])
                    said_again = [source.text] + [" ".join(map(str, v)) for v in (start, stride, count)]
                    assert item.text == "{}|{}:{}:{}:".format(*said_again) + source.get("Dimensions")
                elif item.get("Format") == "HDF":
                    name, dataset = item.text.split(":")
                    assert name == os.path.basename(path)
                    assert list(f[dataset].shape) == dims, dataset
                    kind = {"f": "Float", "i": "Int"}[f[dataset].dtype.kind]
                    assert (item.get("NumberType"), int(item.get("Precision"))) == (kind, f[dataset].dtype.itemsize)
            names = {a.get("Name") for a in grid.findall("Attribute")}
            assert names == {"velocity", "angular_velocity", "orientation", "world", "id", "mass"}


def main():
    mpiexec, writer, schema = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        same_for_any_ranks_and_placement(mpiexec, writer, folder)
        path = os.path.join(folder, "run.h5")
        result = sample_check.run_writer(mpiexec, 2, writer, path, 12, 12)
        assert result.returncode == 0, result.stderr
        attributes_are_there(path)
        follows_h5md(path)
        xdmf_points_into(path)
        schema_names_all(schema, path)
        variables = schema_examples(schema, path)
        assert np.array_equal(variables["position"], sample_check.positions(range(12)))
        assert list(variables["frames"]["wall"]) == [1e-3 * (k + 1) for k in range(12)]
        assert len(variables["frames"]) == 12
        assert len(variables["contacts"]) == sum((w + 11) % 4 for w in range(20))


main()
