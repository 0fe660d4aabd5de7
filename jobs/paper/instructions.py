"""Figure 3 of the paper and the mix of its section 3.3: instructions as jobs/figure3.sh counts them."""
import dataclasses
import json
import math

from reports.files import BadInput, require
from reports.words import percent

from runs import Source

FILETYPE = "pbmpi-instructions"
MIX = ("floating point", "integer", "branch", "store", "load")
PAPER_MIX = (0.34, 0.25, 0.06, 0.05, 0.30)
LEADING_ROWS = 100  # the fewest of an island for the cubic part of its cost to dominate


@dataclasses.dataclass
class Counts:
    """Of one stepper inside a scene's frame, mean over the measured frames."""
    per_frame: float
    collision_share: float
    mix: tuple

    def solver(self):
        return self.per_frame * (1 - self.collision_share)


@dataclasses.dataclass
class CountedScene:
    name: str
    quick: Counts = None
    direct: Counts = None


def document_of(path):
    """The JSON document; None if it is none."""
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}; name the figure3.json of jobs/figure3.sh") from None
    except ValueError:
        return None


def source_of(path):
    """For the foot of a page."""
    return Source(path, {"command_line": "jobs/figure3.sh"})


def is_of_counts(document):
    return isinstance(document, dict) and document.get("filetype") == FILETYPE


def read_counts(path):
    """[CountedScene] in the order of the file."""
    document = document_of(path)
    require(is_of_counts(document), f"{path}: no counts of instructions; name the figure3.json of jobs/figure3.sh")
    try:
        scenes = [CountedScene(name, *(counts_of(scene.get(stepper)) for stepper in ("quick", "direct")))
                  for name, scene in document["scenes"].items()]
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BadInput(f"{path}: it lacks what jobs/figure3.py writes ({error}); count again") from None
    require(scenes, f"{path}: it has no scene; count again")
    return scenes


def counts_of(numbers):
    if numbers is None:
        return None
    return Counts(float(numbers["instructions_per_frame"]), float(numbers["collision_share"]),
                  tuple(float(numbers["mix"][name]) for name in MIX))


@dataclasses.dataclass
class CubicCost:
    """Instructions of the solver over cubed rows of islands, over some scenes; the middle is the geometric mean."""
    least: float
    middle: float
    most: float
    num_scenes: int


@dataclasses.dataclass
class DirectCost:
    """Instructions of a frame with direct."""
    least: float
    middle: float
    most: float
    is_counted: bool = False


def cubic_cost(ratios):
    """None without ratios."""
    if not ratios:
        return None
    return CubicCost(min(ratios), math.exp(sum(map(math.log, ratios)) / len(ratios)), max(ratios), len(ratios))


def find_work(works, scene):
    return next((work for work in works if work.scene == scene), None)


def counted_cost(scenes, works):
    """From the scenes that were counted with direct and have a large island. Any stepper's works: all see the same contacts at first."""
    pairs = [(scene.direct, find_work(works, scene.name)) for scene in scenes if scene.direct]
    return cubic_cost([direct.solver() / work.cubed_rows() for direct, work in pairs if work and work.most_rows() >= LEADING_ROWS])


def direct_cost(scene, cost, works):
    """Counted, or extrapolated; None without a cost, the scene's work, or a count of quick, whose collision detection is the same."""
    if scene.direct:
        return DirectCost(*[scene.direct.per_frame] * 3, True)
    work = find_work(works, scene.name)
    if not cost or not work or not scene.quick:
        return None
    collision = scene.quick.per_frame - scene.quick.solver()
    return DirectCost(*(collision + one * work.cubed_rows() for one in (cost.least, cost.middle, cost.most)))


def mean_mix(mixes):
    """All zero without mixes."""
    return tuple(sum(mix[i] / len(mixes) for mix in mixes) for i in range(len(MIX)))


def millions(instructions):
    return f"{instructions / 1e6:.4g}"


def direct_text(cost):
    """In millions: "40 (20 to 80), extrapolated", or the count."""
    if cost is None:
        return "not counted"
    if cost.is_counted:
        return millions(cost.middle)
    return f"{millions(cost.middle)} ({millions(cost.least)} to {millions(cost.most)}), extrapolated"


def law_text(cost):
    """How direct was extrapolated; empty if it was not."""
    if cost is None:
        return ""
    return (f"Where direct was not counted its solver is taken to need {cost.middle:.3g} instructions ({cost.least:.3g} to {cost.most:.3g}, "
            f"by {cost.num_scenes} counted scenes with an island of at least {LEADING_ROWS} rows) for each cubed row of an island, over all "
            "islands of a frame's steps, from their recorded rows; collision detection is quick's.")


def line_of(scene, stepper, counts):
    mix = ",".join(f" {name} {percent(share, 0)}" for name, share in zip(MIX, counts.mix))
    return f"{scene:<8} {stepper:<6} {counts.per_frame / 1e6:10.2f} M a frame;{mix}; collision {percent(counts.collision_share, 0)}\n"


def figure3_text(scenes, works):
    """One line a scene and stepper, and how direct was extrapolated."""
    text, cost = "", counted_cost(scenes, works)
    for scene in scenes:
        if scene.quick:
            text += line_of(scene.name, "quick", scene.quick)
        of_direct = direct_cost(scene, cost, works)
        if scene.direct:
            text += line_of(scene.name, "direct", scene.direct)
        elif of_direct:
            text += f"{scene.name:<8} {'direct':<6} {direct_text(of_direct)} M a frame\n"
    return text + (law_text(cost) + "\n" if cost else "")
