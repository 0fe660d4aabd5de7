"""What a field of the map of hard cases opens on the page: its curves, and a replay of its bodies (web/map.js, data.js).

Arrays are in base64, numbers little-endian and in single precision, but for indices.
"""
import base64
import math

import numpy as np

CURVES = {"energy": ("Energy", "J"), "joint_gap": ("Joint gap", "m"), "penetration": ("Deepest contact", "m"), "drift": ("Drift", "m")}


def packed(values, kind="f4"):
    """`kind`: numpy's, e.g. i4."""
    return base64.b64encode(np.asarray(values, f"<{kind}").tobytes()).decode("ascii")


def by_scene(study, table):
    scenes = {}
    for row in study.rows(table):
        scenes.setdefault(row.scene, []).append(row)
    return scenes


class Recorded:
    """What a study recorded of its cases."""

    def __init__(self, study):
        self.bodies, self.geoms = by_scene(study, "bodies"), by_scene(study, "geoms")  # since version 1.7
        self.tables = {name: {column: np.asarray(values) for column, values in study.tables[name].items()} for name in ("curves", "poses")}

    def rows(self, table, case):
        """The columns of a table, of this case alone; rows are in the order of the cases."""
        columns = self.tables[table]
        first, last = np.searchsorted(columns["case"], [case, case + 1])
        return {name: values[first:last] for name, values in columns.items()}

    def curves(self, case):
        found = self.rows("curves", case)
        if not len(found["time"]):
            return []
        return [{"title": title, "unit": unit, "time_s": packed(found["time"]), "value": packed(found[column])}
                for column, (title, unit) in CURVES.items()]

    def still(self, scene):
        """A scene's bodies, their first poses [num_bodies][7], and its geoms. None: the study did not record them."""
        bodies, geoms = self.bodies.get(scene), self.geoms.get(scene, [])
        if not bodies:
            return None
        kinds, shapes = list(dict.fromkeys(geom.kind for geom in geoms)), list(dict.fromkeys(geom.shape for geom in geoms))
        return {"body_names": [body.name for body in bodies], "first": np.array([body.pose for body in bodies]), "kind_names": kinds,
                "shape_names": shapes,
                "geoms": {"kind": packed([kinds.index(geom.kind) for geom in geoms], "u1"),
                          "shape": packed([shapes.index(geom.shape) for geom in geoms], "u1"), "world": packed(np.zeros(len(geoms)), "i4"),
                          "body": packed([geom.body for geom in geoms], "i4"), "size": packed([geom.size for geom in geoms]),
                          "local": packed([geom.local for geom in geoms])}}

    def replay(self, case, still, dt_s):
        """Frames are numbered from the start, whose poses are those of frame 0. None: there is nothing to show."""
        found = self.rows("poses", case)
        if still is None or not len(found["time"]):
            return None
        num_bodies = len(still["body_names"])
        times = found["time"][::num_bodies].tolist()
        poses = np.concatenate([still["first"], found["pose"]])  # [(frames + 1) * num_bodies][7]
        return {"note": "", "num_worlds": 1, "num_bodies": num_bodies, "body_names": still["body_names"],
                "body_world": packed(np.zeros(num_bodies), "i4"), "number": list(range(len(times) + 1)), "time_s": [0, *times],
                "step": [0, *(math.floor(time / dt_s + 0.5) for time in times)], "position": packed(poses[:, :3]),
                "orientation": packed(poses[:, 3:]), "kind_names": still["kind_names"], "shape_names": still["shape_names"],
                "geoms": still["geoms"]}
