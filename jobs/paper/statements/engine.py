"""Section 2.3: what ODE does, and what it costs."""
import dataclasses
import math

from reports.words import percent

from instructions import LEADING_ROWS
from statements.statement import ALL, CLOCK, COUNTS, FIGURE_6, NUM_SCENES, Answer, Statements, joined, over_scenes

STATEMENTS = Statements()
PASS = "pass"  # a verdict of `pbreport stability`


@STATEMENTS.judged_by("2.3.1", "ODE resolves collisions of high speed even at coarse time steps",
                      "nothing passes through anything without pbmpi's contacts ahead of fast bodies: CrashWa (89.4 m/s), "
                      "hard/contact/bullets_50 (50 m/s), steps of 0.01 s", COUNTS, ALL, remark="guards look after each step")
def high_speed(data):
    return over_scenes([(scene, str(passages)) for scene, passages in data.plain], all(passages == 0 for _, passages in data.plain), 2,
                       "passages: ")


def verdicts_of(data, setting, cases):
    """{case without its folder: verdict of `pbreport stability`}, as far as the study has them."""
    if data.stability is None:
        return {}
    return {case["scene"].rpartition("/")[2]: result["verdict"] for case in data.stability["cases"] if case["scene"] in cases
            for result in case["results"] if result["setting"] == setting}


@STATEMENTS.judged_by("2.3.1", "a penetration is eliminated after a short number of steps",
                      "quick with 20 iterations is right in the hard cases half_embedded and overlapping_rows", COUNTS, ALL,
                      remark="bounds of a case: scenes/FORMAT.md")
def penetration(data):
    verdicts = verdicts_of(data, "quick, 1 x 20", ("hard/contact/half_embedded", "hard/contact/overlapping_rows"))
    return over_scenes(list(verdicts.items()), all(verdict == PASS for verdict in verdicts.values()), 2)


@STATEMENTS.judged_by("2.3.1", "the number of spaces has significant impact on collision detection",
                      "a core for each space saves a quarter of its time in most scenes of several spaces", CLOCK, FIGURE_6,
                      remark="kinds of spaces are not compared; pbmpi takes a simple one or sweep and prune")
def number_of_spaces(data):
    several = [one for one in data.suite if one.spaces >= 2]
    faster = sum(one.spaces_share <= 0.75 for one in several)
    return over_scenes([(one.scene, percent(one.spaces_share, 0)) for one in several], 2 * faster > len(several), 6, "left of its time: ")


@STATEMENTS.judged_by("2.3.2", "the forward step is the most expensive part", "more than half of the time in every scene", CLOCK, FIGURE_6)
def expensive_step(data):
    shares = [(one.scene, 1 - one.collide_share_serial) for one in data.suite]
    return over_scenes([(scene, percent(share, 0)) for scene, share in shares], all(share > 0.5 for _, share in shares), NUM_SCENES)


@dataclasses.dataclass
class Growth:
    """Power law through the times of islands: least squares of log(seconds) over log(rows)."""
    exponent: float
    num_islands: int
    least_rows: int
    most_rows: int

    def text(self):
        return f"rows to the power of {self.exponent:.2f} ({self.num_islands} islands of {self.least_rows} to {self.most_rows} rows)"


def growth_of(works):
    """Over all islands of at least LEADING_ROWS rows; None unless the largest has four times the rows of the smallest."""
    islands = [(rows, seconds) for work in works for step in work.islands for rows, seconds in step if rows >= LEADING_ROWS and seconds > 0]
    sizes = [rows for rows, _ in islands]
    if not islands or max(sizes) < 4 * min(sizes):
        return None
    points = [(math.log(rows), math.log(seconds)) for rows, seconds in islands]
    n, x_sum, y_sum = len(points), sum(x for x, _ in points), sum(y for _, y in points)
    xx_sum, xy_sum = sum(x * x for x, _ in points), sum(x * y for x, y in points)
    return Growth((n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum), n, min(sizes), max(sizes))


@STATEMENTS.judged_by("2.3.2", "the normal step takes O(m^3) for m constraints", "exponent of 2.5 to 3.5 over islands of at least 100 rows",
                      CLOCK, ALL, papers="3")
def normal_step(data):
    growth = growth_of(data.direct)
    return growth and Answer(growth.text(), 2.5 <= growth.exponent <= 3.5)


@STATEMENTS.judged_by("2.3.2", "the quick step takes O(m i) for m constraints and i iterations",
                      "exponent of m 0.8 to 1.2; from 40 to 80 iterations 1.5 to 2.5 times as much more as from 20 to 40", CLOCK, ALL,
                      papers="1; 2", remark="time of a row, CrashWa")
def quick_step(data):
    growth, base = growth_of(data.works()), data.find("CrashWa")
    more = {work.iterations: work.time_of_a_row() for work in reversed(data.more_iterations) if work.scene == "CrashWa"}
    if growth is None or base is None or not {40, 80} <= more.keys():
        return None
    ratio = (more[80] - more[40]) / (more[40] - base.work.time_of_a_row())
    return Answer(f"{growth.text()}; {ratio:.2f} times", 0.8 <= growth.exponent <= 1.2 and 1.5 <= ratio <= 2.5)


@STATEMENTS.judged_by("2.3.2", "the quick step far outperforms the big matrix in scenes of average size",
                      "half its time or less in every scene that was tried", CLOCK, ALL,
                      remark="CrashWa: one step, before the crash; Environ and Battle2 take minutes. The paper calls 2-Cars, 10-Cars and "
                             "CrashSk simple")
def both_steps(data):
    pairs = [(direct, data.find(direct.scene)) for direct in data.direct]
    ratios = [(direct.scene, direct.frame_s / direct.steps_per_frame / (quick.work.frame_s / quick.work.steps_per_frame))
              for direct, quick in pairs if quick]
    return over_scenes([(scene, f"{ratio:.3g}") for scene, ratio in ratios], all(ratio >= 2 for _, ratio in ratios), 7,
                       "time of direct over quick's: ")


@STATEMENTS.judged_by("2.3.2", "ODE's integrator allows large steps, even with collisions of high speed",
                      "steps of 0.01 s: no number that is not finite, and no energy gained without a cause", COUNTS, FIGURE_6,
                      papers="0.001 to 0.01 s", remark="guards of the nine scenes' runs; over seconds: docs/stability.md")
def large_steps(data):
    if not data.suite:
        return None
    blown_up = [(one.scene, one.events.get("nonfinite", 0) + one.events.get("energy_gain", 0)) for one in data.suite]
    blown_up = [(scene, str(events)) for scene, events in blown_up if events > 0]
    text = f"events of guards: {joined(blown_up)}" if blown_up else f"none in {len(data.suite)} scenes"
    return Answer(text, not blown_up, len(data.suite), NUM_SCENES)


# Rows of pbmpi's joints without limits and motors, and the paper's degrees of freedom. A test counts the rows of a run with each joint.
HELD_ROWS = {"ball": 3, "hinge": 5, "hinge2": 4, "slider": 5, "universal": 4, "fixed": 6}
REMOVED_FREEDOM = {"ball": 3, "hinge": 5, "hinge2": 4, "slider": 5, "universal": 4, "fixed": 6}


@STATEMENTS.judged_by("2.3.2", "degrees of freedom that a joint removes", "as many rows", COUNTS, papers=joined(REMOVED_FREEDOM.items()),
                      remark="contact: the paper's 1 is its normal; friction adds two rows")
def degrees_of_freedom(_):
    return Answer(joined(HELD_ROWS.items()), HELD_ROWS == REMOVED_FREEDOM)


STATEMENTS.undecidable("2.3.2", "ODE's worlds, and islands of a world, can be solved independently", "-",
                       "QuickStep draws its row order from one seed of the process, which pbmpi sets before each step: its runs cannot show "
                       "what ODE does alone")
