"""Copies everything in a run's file except its rows."""
import h5py
import numpy as np

from reports.files import require
from reports.join.tables import PIECE_BYTES, row_bytes

MADE_ANEW = ("/ranks/rank", "/ranks/host", "/ranks/worlds_at_start", "/parameters/frames", "/parameters/ranks", "/parameters/joined_from")


def address_of(thing):
    """All names of an object have the same."""
    return h5py.h5o.get_info(thing.id).addr


def value_of(attribute):
    """With the type that it has in the file."""
    value = np.empty(attribute.shape, attribute.dtype)
    attribute.read(value, mtype=attribute.get_type())
    return value


def set_attribute(thing, name, value):
    """Writes an attribute that is there."""
    attribute = thing.attrs.get_id(name)
    attribute.write(np.array(value, attribute.dtype), mtype=attribute.get_type())


class Copier:
    """Creates in the empty file `target` what `source` has: groups, attributes, datasets, and further names of datasets. `shapes`: extents, by path, of
    datasets that are created without rows; `left_out`: paths of datasets, with which H5MD elements go whose value they are, and groups of nothing
    else; MADE_ANEW is passed over."""

    def __init__(self, source, target, shapes, left_out):
        self.source, self.target = source, target
        self.shapes = {address_of(source[path]): shape for path, shape in shapes.items()}
        self.left_out = {address_of(source[path]) for path in left_out if path in source}
        self.made, self.references = {}, []  # first name of each dataset by address; attributes that refer to objects

    def run(self):
        self.copy_members(self.source["/"], self.target["/"])
        for path, name, referred in self.references:
            self.target[path].attrs.create(name, self.target[referred].ref, dtype=h5py.ref_dtype)

    def stays(self, thing):
        if isinstance(thing, h5py.Dataset):
            return address_of(thing) not in self.left_out
        if "value" in thing and not self.stays(thing["value"]):
            return False
        return len(thing) == 0 or any(map(self.stays, thing.values()))

    def copy_members(self, source, target):
        self.copy_attributes(source, target)
        for name, thing in source.items():
            path = f"{source.name.rstrip('/')}/{name}"
            if path in MADE_ANEW or not self.stays(thing):
                continue
            if isinstance(thing, h5py.Group):
                self.copy_members(thing, target.create_group(name))
            elif address_of(thing) in self.made:
                target[name] = self.target[self.made[address_of(thing)]]
            else:
                self.made[address_of(thing)] = path
                self.copy_attributes(thing, self.copy_dataset(thing, target, name))

    def copy_dataset(self, source, target, name):
        """A dataset with a row a frame or an event gets its extent, and no rows."""
        creation, shape = source.id.get_create_plist(), self.shapes.get(address_of(source))
        space = source.id.get_space()
        if shape:
            whole = (*shape, *source.shape[len(shape):])
            space = h5py.h5s.create_simple(whole, (h5py.h5s.UNLIMITED, *whole[1:]))
            rows = max(1, min(whole[0], PIECE_BYTES // max(row_bytes(source), 1)))
            creation.set_chunk((rows, *source.chunks[1:]))
        copy = h5py.Dataset(h5py.h5d.create(target.id, name.encode(), source.id.get_type(), space, dcpl=creation))
        if not shape and source.size:
            values = np.empty(source.shape, source.dtype)
            source.id.read(h5py.h5s.ALL, h5py.h5s.ALL, values, mtype=source.id.get_type())
            copy.id.write(h5py.h5s.ALL, h5py.h5s.ALL, values, mtype=source.id.get_type())
        return copy

    def copy_attributes(self, source, target):
        for name in source.attrs:
            attribute = source.attrs.get_id(name)
            if h5py.check_ref_dtype(attribute.dtype) is h5py.Reference:
                self.references.append((target.name, name, self.source[source.attrs[name]].name))
                continue
            copy = h5py.h5a.create(target.id, name.encode(), attribute.get_type(), attribute.get_space())
            copy.write(value_of(attribute), mtype=attribute.get_type())


def require_same_objects(a, b, changing):
    """Raises BadInput unless the datasets that are written once have the same bytes in both runs, except those of /parameters and /ranks, and
    `changing`, paths of run a."""
    passed_over = {address_of(a.file[path]) for path in changing if path in a.file}

    def compare(path, thing):
        if not isinstance(thing, h5py.Dataset) or path.startswith(("parameters/", "ranks/")) or address_of(thing) in passed_over:
            return
        other = b.file.get(path)
        same = isinstance(other, h5py.Dataset) and thing.shape == other.shape and np.asarray(thing[()]).tobytes() == np.asarray(other[()]).tobytes()
        require(same, f"{a.path} and {b.path} are not of one run: /{path} is not the same in both")

    a.file.visititems(compare)
