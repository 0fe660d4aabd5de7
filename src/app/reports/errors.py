"""Errors of bodies and joints, as studies store them: in columns PREFIX_body_position_rms and so on (io/SCHEMA.md)."""
import dataclasses

# name, unit; in the order of the file
KINDS = {"body_position": "m", "body_orientation": "rad", "joint_position": "m", "joint_orientation": "rad"}
NUMBERS = ("rms", "median", "p90", "p99", "max")
BANDS = ("< 1 cm", "1-10", "10-100", "> 100", "inf")


@dataclasses.dataclass
class Errors:
    """rms, percentiles and the largest, and how many bodies or joints have an error in each band; the last: not finite."""
    rms: float
    p99: float
    max: float
    bands: list
    broken: int = 0  # joints that broke, which have no error
    median: float | None = None  # None: nobody asked for it; p90 too
    p90: float | None = None

    @property
    def count(self):
        return sum(self.bands) + self.broken

    def json(self):
        return {what: getattr(self, what) for what in (*NUMBERS, "bands") if getattr(self, what) is not None}


def read(row, prefix):
    """{kind: Errors} of a row."""
    return {kind: Errors(*(getattr(row, f"{prefix}_{kind}_{what}") for what in ("rms", "p99", "max", "bands")),
                         *(row.get(f"{prefix}_{kind}_{what}", default) for what, default in (("broken", 0), ("median", None), ("p90", None))))
            for kind in KINDS}


def json_of(table):
    return {f"{kind}_{KINDS[kind]}": errors.json() for kind, errors in table.items()}


def bands_text(errors, separator="/"):
    return separator.join(map(str, errors.bands))


def all_finite(table):
    return all(errors.bands[-1] == 0 for errors in table.values())
