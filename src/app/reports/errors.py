"""Errors of bodies and joints, as studies store them: in columns PREFIX_body_position_rms and so on (io/SCHEMA.md)."""
import dataclasses
import math

# name, unit; in the order of the file
KINDS = {"body_position": "m", "body_orientation": "rad", "joint_position": "m", "joint_orientation": "rad"}
NUMBERS = ("rms", "median", "p90", "p99", "max")
BANDS = ("< 1 cm", "1-10", "10-100", "> 100", "inf")


@dataclasses.dataclass
class Errors:
    """rms, percentiles and the largest, and how many bodies or joints have an error in each band; the last: not finite."""
    rms: float
    median: float  # NaN in files that lack it, as p90
    p90: float
    p99: float
    max: float
    bands: list
    broken: int = 0  # joints that broke, which have no error

    @property
    def count(self):
        return sum(self.bands) + self.broken

    def json(self):
        return {what: getattr(self, what) for what in NUMBERS} | {"bands": self.bands}


def read(row, prefix):
    """{kind: Errors} of a row."""
    return {kind: Errors(*(row.get(f"{prefix}_{kind}_{what}", math.nan) for what in NUMBERS), getattr(row, f"{prefix}_{kind}_bands"),
                         row.get(f"{prefix}_{kind}_broken", 0)) for kind in KINDS}


def json_of(table):
    return {f"{kind}_{KINDS[kind]}": errors.json() for kind, errors in table.items()}


def bands_text(errors, separator="/"):
    return separator.join(map(str, errors.bands))


def all_finite(table):
    return all(errors.bands[-1] == 0 for errors in table.values())
