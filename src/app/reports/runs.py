"""Files of runs: their settings, and the rows of committed frames, which a run that was killed has as well."""
from reports.files import RUN, BadInput, open_file, require, text_of

PHASES = ("collide", "islands", "rows", "solve", "integrate", "cross_space", "ship", "gather", "wait", "output")  # of a rank, in a frame
USEFUL = PHASES[:6]  # time spent on the simulation itself
# Columns of /observables/world and their units.
OBSERVABLES = {"contacts": "", "rows": "", "islands": "", "max_island_rows": "", "fast_bodies": "", "row_visits": "", "energy": "J",
               "max_penetration": "m", "joint_gap": "m", "nonfinite": "", "linear_momentum": "kg m s-1", "angular_momentum": "kg m2 s-1"}
# What a parameter matters for: another value gives other results, another sample of the same case, other estimates, or none of these.
RESULTS, SEED, ESTIMATE, NOTHING = "results", "seed", "estimate", "nothing"
SEEDS = ("seed", "solver_seed", "world_range")
FREE = ("ranks", "threads", "processors", "build", "simd", "decompose", "budget", "frames", "record_every", "record_islands",
        "record_contacts", "record_residuals", "resumed_from", "joined_from", "parameters_file", "ranks_per_world", "rank_groups",
        "on_blowup")
MOST_LETTERS = 60  # of a value in a sentence


class Run:
    """A run's file: T committed frames, in P of which bodies were recorded, of W worlds on R ranks.

    path; attributes, parameters: texts by name, in the order of the alphabet; complete; hosts [R]; num_frames T, num_recorded P,
    num_worlds W, num_ranks R, record_every; first_frame: number of the first frame in the whole run; measured: bool [T], False in a warm-up
    frame.
    The file stays open. Raises BadInput for anything but a sound run."""

    def __init__(self, path):
        self.path = path
        self.file = open_file(path, RUN)
        self.attributes = {name: text_of(value) for name, value in sorted(self.file.attrs.items())}
        self.num_frames, self.record_every = self.whole_number("frames_committed"), self.whole_number("record_every")
        self._require(self.num_frames >= 0 and self.record_every >= 1, "impossible root attributes")
        self.first_frame = self.whole_number("first_frame", 0)  # files of layout 1.0 have none
        self.complete = self.whole_number("complete") != 0
        self._require("parameters" in self.file, "it has no /parameters")
        self.parameters = {name: text_of(value[()]) for name, value in self.file["parameters"].items()}
        self.num_recorded = self.num_frames // self.record_every
        self.hosts = self.column("ranks/host")
        self.num_ranks = len(self.hosts)
        contacts = self._dataset("observables/world/contacts")
        self._require(contacts.ndim == 2 and contacts.shape[1] >= 1, "/observables/world/contacts has an impossible number of worlds")
        self.num_worlds = contacts.shape[1]
        self.measured = self.frames("timings/frame/measured") != 0

    def _require(self, holds, message):
        require(holds, f"{self.path}: {message}; the file is damaged or incomplete")

    def whole_number(self, attribute, default=None):
        text = str(self.attributes.get(attribute, default))
        self._require(text.lstrip("-").isdigit(), f"attribute {attribute} is no whole number, or missing")
        return int(text)

    def _dataset(self, name):
        self._require(name in self.file, f"/{name} is missing")
        return self.file[name]

    def has(self, name):
        """Whether there is a dataset, or a group, of this name, e.g. "estimate/delivered"."""
        return name in self.file

    def unit(self, name):
        return text_of(self._dataset(name).attrs.get("unit", b""))

    def column(self, name):
        """A dataset that is written once, e.g. "particles/bodies/name": texts as a list, numbers as an array."""
        values = self._read(name, slice(None))
        return [text_of(value) for value in values] if values.dtype.kind in "SO" else values

    def frames(self, name, rows=slice(None)):
        """Array [T, ...] of a column with a row a frame, e.g. "timings/rank/solve" [T][R], "observables/world/energy" [T][W].
        `rows`: a slice of the frames."""
        return self._rows(name, self.num_frames, rows)

    def recorded(self, name, rows=slice(None)):
        """Array [P, ...] of a column with a row a recorded frame, e.g. "particles/bodies/position/value" [P][N][3]."""
        return self._rows(name, self.num_recorded, rows)

    def _rows(self, name, count, rows):
        found = self._dataset(name).shape[0]
        self._require(found >= count, f"/{name} has {found} rows, not {count}")
        return self._read(name, slice(*rows.indices(count)))

    def _read(self, name, rows):
        try:
            return self._dataset(name)[rows]
        except OSError as error:
            raise BadInput(f"{self.path}: /{name} cannot be read ({error}); the file is damaged or incomplete") from None

    def parameter(self, name, default=""):
        return self.parameters.get(name, default)

    def number(self, name, default=None):
        """A parameter as a float. Raises BadInput for what is no number, or is not there and has no default."""
        if default is not None and name not in self.parameters:
            return default
        try:
            return float(self.parameter(name))
        except ValueError:
            raise BadInput(f"{self.path}: /parameters has no number '{name}'; was the file written by pbmpi?") from None

    @property
    def scene(self):
        return self.attributes.get("scene", "")

    @property
    def state_hash(self):
        """In words for a run that was cut off: its file has blanks in the hash's place."""
        return self.attributes.get("state_hash", "").strip() or "none (the run was cut off)"

    def of_ranks(self, name):
        """Array [measured frames][R] of floats of a column of /timings/rank: a phase, useful, processor [s]; messages, bytes."""
        return self.frames(f"timings/rank/{name}")[self.measured].astype(float)


def matters_for(name):
    """What a parameter matters for."""
    if name in SEEDS:
        return SEED
    if name == "feec" or name.startswith("estimate_"):
        return ESTIMATE
    return NOTHING if name in FREE or name.startswith(("library_", "env_")) else RESULTS


def differences(a, b, matters):
    """[(name, value in run a, value in run b)] of the parameters that matter so and differ, by name; "(none)" where a run has it not."""
    names = sorted(name for name in {*a.parameters, *b.parameters} if matters_for(name) == matters)
    pairs = [(name, a.parameter(name, "(none)"), b.parameter(name, "(none)")) for name in names]
    return [(name, one, other) for name, one, other in pairs if one != other]


def difference_text(difference, a, b):
    """"iterations is 20 in a.h5 and 10 in b.h5"; for a long text only that it differs."""
    name, one, other = difference
    if any(len(value) > MOST_LETTERS or "\n" in value for value in (one, other)):
        return f"{name} is not the same in {a.path} and {b.path}"
    return f"{name} is {one} in {a.path} and {other} in {b.path}"
