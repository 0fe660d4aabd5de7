"""Section 4: Figure 3, shares of the time, Table 2."""
from reports.words import percent

from instructions import counted_cost, direct_cost
from islands import PAPER
from statements.statement import CLOCK, COUNTS, FIGURE_3, FIGURE_6, INSTRUCTIONS, NUM_SCENES, Answer, Statements, is_near, joined

STATEMENTS = Statements()


def add_instructions(name):
    """The statement of a scene's bars in Figure 3."""
    @STATEMENTS.judged_by("4.1", f"Figure 3, {name}: quick takes significantly fewer instructions",
                          "half of direct's or fewer; of an extrapolation its least", INSTRUCTIONS, FIGURE_3, papers="printed without numbers")
    def instructions(data):
        scene = next((one for one in data.counts if one.name == name), None)
        if scene is None or not scene.quick:
            return None
        works = data.works()
        direct = direct_cost(scene, counted_cost(data.counts, works), works)
        text = f"quick {1e-6 * scene.quick.per_frame:.3g} million a frame"
        if direct is None:
            return Answer(text, note=f"direct was not counted: {FIGURE_3}")
        text += f", direct {1e-6 * direct.middle:.3g}"
        if not direct.is_counted:
            text += f" ({1e-6 * direct.least:.3g} to {1e-6 * direct.most:.3g})"
        return Answer(text, direct.least >= 2 * scene.quick.per_frame,
                      note="" if direct.is_counted else "direct extrapolated with the cubed rows of the islands")


for scene_of_paper in PAPER:
    add_instructions(scene_of_paper)


def shares_text(data, share):
    return joined([(one.scene, percent(getattr(one, share), 0)) for one in data.suite])


def mean_share(data, share):
    return sum(getattr(one, share) for one in data.suite) / len(data.suite)


@STATEMENTS.judged_by("4.1.1", "physics of the islands takes 92 % of the time on average", "what is left, 8 %, within half and twice: 84 to 96 %",
                      CLOCK, FIGURE_6, papers="92 %", remark="all but collision detection; ODE finds islands within its step")
def physics_share(data):
    if not data.suite:
        return None
    physics = 1 - mean_share(data, "collide_share_serial")
    return Answer(f"{percent(physics, 0)}; collision: {shares_text(data, 'collide_share_serial')}", 0.84 <= physics <= 0.96,
                  len(data.suite), NUM_SCENES)


@STATEMENTS.judged_by("4.1.1", "with parallel islands collision detection takes 20 % on average", "within half and twice: 10 to 40 %",
                      CLOCK, FIGURE_6, papers="20 %", remark="a core an island, no overheads")
def parallel_collision(data):
    if not data.suite:
        return None
    mean = mean_share(data, "collide_share_parallel")
    return Answer(f"{percent(mean, 0)}: {shares_text(data, 'collide_share_parallel')}", 0.1 <= mean <= 0.4, len(data.suite), NUM_SCENES)


@STATEMENTS.judged_by("4.1.1", "with parallel islands collision detection takes 55 % at most",
                      "its largest share within half and twice: at least 27.5 %", CLOCK, FIGURE_6, papers="55 %")
def largest_collision(data):
    if not data.suite:
        return None
    most = max(data.suite, key=lambda one: one.collide_share_parallel)
    return Answer(f"{percent(most.collide_share_parallel, 0)}, {most.scene}", most.collide_share_parallel >= 0.275,
                  len(data.suite), NUM_SCENES)


@STATEMENTS.judged_by("4.2", "the maximum island count in the suite is 337", "within 10 %", COUNTS, FIGURE_6, papers="337")
def most_islands(data):
    if not data.suite:
        return None
    most = max(data.suite, key=lambda one: one.islands.max)
    return Answer(f"{most.islands.max:.0f}, {most.scene}", is_near(most.islands.max, 337), len(data.suite), NUM_SCENES)


def add_cores(scene, papers):
    """The statement of one row of Table 2."""
    @STATEMENTS.judged_by("4.2", f"Table 2, {scene}: cores for full parallelization", "within one core or 10 %", CLOCK, FIGURE_6,
                          papers=str(papers))
    def cores(data):
        one = data.find(scene)
        if one is None:
            return None
        return Answer(str(one.cores), abs(one.cores - papers) <= max(1, 0.1 * papers),
                      note=f"the worst frame, 5 % above the longest island; mean {one.cores_mean:.1f}")


for scene_of_paper, row_of_paper in PAPER.items():
    add_cores(scene_of_paper, row_of_paper.cores)


@STATEMENTS.judged_by("4.2", "most scenes of many islands are satisfied with less than five cores",
                      "most of those with 90 islands or more, 100CrSk left out as the paper does", CLOCK, FIGURE_6, papers="< 5")
def few_cores(data):
    many = [one for one in data.suite if one.islands.mean >= 90 and one.scene != "100CrSk"]
    if not many:
        return None
    few = sum(one.cores < 5 for one in many)
    return Answer(joined([(one.scene, str(one.cores)) for one in many]), 2 * few > len(many), len(data.suite), NUM_SCENES)
