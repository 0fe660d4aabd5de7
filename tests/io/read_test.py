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
    reference = None
    for ranks, move in ((1, 0), (2, 0), (2, 3), (3, 1), (4, 2)):
        path = os.path.join(folder, "same.h5")
        result = sample_check.run_writer(mpiexec, ranks, writer, path, 12, 12, 2, move=move)
        assert result.returncode == 0, result.stderr
        assert sample_check.check(path) == 12
        found = {k: v for k, v in datasets(path).items() if not k.startswith(("/ranks/", "/timings/rank/", "/estimate/compute", "/checksums/timings.rank.",
                                                                                  "/checksums/estimate.compute"))}
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
    """The paths in the schema's tables of a run's file are those in the file."""
    with open(schema) as text:
        of_runs = text.read().split("\n# ")[0]
    listed = set(re.findall(r"^\| `(/[^`]*)`", of_runs, re.M))
    present = {p for p in datasets(path) if not p.startswith("/parameters/")}
    assert present == listed, (sorted(present - listed), sorted(listed - present))


def attributes_are_there(path):
    with h5py.File(path, "r") as f:
        assert f.attrs["filetype"].decode() == "pbmpi-run" and list(f.attrs["version"]) == [1, 5]
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
        xdmf_points_into(path)
        schema_names_all(schema, path)
        variables = schema_examples(schema, path)
        assert np.array_equal(variables["position"], sample_check.positions(range(12)))
        assert list(variables["frames"]["wall"]) == [1e-3 * (k + 1) for k in range(12)]
        assert len(variables["frames"]) == 12
        assert len(variables["contacts"]) == sum((w + 11) % 4 for w in range(20))


main()
