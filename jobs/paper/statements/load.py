"""Sections 1 to 2.2: what such simulations demand of a machine."""
from reports.words import percent

from figures import count_stretch
from statements.statement import ALL, CLOCK, COUNTS, FIGURE_6, FIGURES_8_9, NUM_SCENES, Answer, Statements, joined, over_scenes

STATEMENTS = Statements()


@STATEMENTS.judged_by("1", "parallel execution and FEEC satisfy nearly all of the suite",
                      "each frame within 3.33 ms in eight scenes: one iteration, a core for each island and space",
                      CLOCK, ALL, papers="nearly all", remark="this machine's processor")
def satisfied_suite(data):
    if not data.one_iteration:
        return None
    shares = [(one.scene, one.spaces_parallel.satisfied) for one in data.one_iteration]
    not_satisfied = [(scene, percent(share, 0)) for scene, share in shares if share < 1]
    satisfied = len(shares) - len(not_satisfied)
    text = f"{satisfied} of {len(shares)} scenes" + (f"; not all frames: {joined(not_satisfied)}" if not_satisfied else "")
    return Answer(text, satisfied >= 8, len(shares), NUM_SCENES)


STATEMENTS.undecidable("1", "30 frames a second give the illusion of visual continuity", "30 Hz",
                       "no observers here; taken over: a frame is 1/30 s")
STATEMENTS.undecidable("2.2", "a tenth of the frame is for physics", "3.33 ms", "the paper's assumption; taken over as the budget")


def stretch_text(stretch):
    count = count_stretch(stretch)
    return (f"{percent((count.num - count.perhaps_seen) / count.num)} unseen, {percent(count.seen / count.num)} seen, "
            f"most {percent(count.most)}")


@STATEMENTS.judged_by("2.2", "changes of length below 2.7 % cannot be perceived, beyond 20 % they always are", "observers would have to tell",
                      COUNTS, FIGURES_8_9, papers="2.7 %, 20 %",
                      remark="no observers here; ours is how much human segments stretch. The source (Harrison et al. 2004) has 3 % as seen "
                             "with full attention, and more than 20 % as unnoticed without")
def perception(data):
    """Ours is of all human segments of all scenes and measured frames, by method."""
    by_label = {}
    for scene in data.figures:
        for method in scene.methods:
            by_label.setdefault(method.label, []).extend(method.stretch)
    text = "; ".join(f"{label}: {stretch_text(stretch)}" for label, stretch in by_label.items() if stretch)
    return Answer(text) if text else None


@STATEMENTS.judged_by("2.2", "the load is distributed: many things happen independently",
                      "the longest island takes less than half of all islands' time in most scenes", CLOCK, FIGURE_6)
def distributed_load(data):
    distributed = sum(one.longest_share < 0.5 for one in data.suite)
    return over_scenes([(one.scene, percent(one.longest_share, 0)) for one in data.suite], 2 * distributed > len(data.suite), NUM_SCENES,
                       "the longest island: ")


@STATEMENTS.judged_by("2.2", "the load is sparse", "a row has two bodies at most: less than a tenth of a scene's in most scenes",
                      COUNTS, FIGURE_6)
def sparse_load(data):
    shares = [(one.scene, 2 / one.bodies) for one in data.suite]
    sparse = sum(share < 0.1 for _, share in shares)
    return over_scenes([(scene, percent(share)) for scene, share in shares], 2 * sparse > len(shares), NUM_SCENES,
                       "blocks of the Jacobian that may differ from zero: ")


STATEMENTS.undecidable("2.2", "the simulation can focus on the area around the user", "-",
                       "no users here; the effect field_of_interest does it (docs/effects.md)")
