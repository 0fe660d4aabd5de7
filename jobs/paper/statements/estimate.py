"""FEEC: section 5.2, Figure 8."""
from reports.words import percent

from figures import FEEC, SCENES, count_stretch
from statements.statement import ALL, CLOCK, COUNTS, FIGURES_8_9, NUM_SCENES, Answer, Statements, joined, over_scenes, rate

STATEMENTS = Statements()


def with_feec(data):
    """[(scene, its method FEEC)] of all scenes that have it."""
    return [(scene, scene.find(FEEC)) for scene in data.figures if scene.find(FEEC)]


@STATEMENTS.judged_by("5.2.1", "FEEC's errors are 100 % corrected at the end of each frame",
                      "the final state has the bits of a run without estimates, in every scene", COUNTS, FIGURES_8_9, papers="100 %")
def correction(data):
    same = [feec.same_hash for _, feec in with_feec(data)]
    return Answer(f"the same bits in {sum(same)} of {len(same)} scenes", all(same), len(same), NUM_SCENES) if same else None


@STATEMENTS.judged_by("5.2.1", "errors of FEEC with one iteration are imperceptible",
                      "by the paper's own bound: no human segment in its estimates is stretched by 2.7 % or more", COUNTS, FIGURES_8_9,
                      papers="< 2.7 %", remark="share of segments and frames beyond, and the longest; images are not judged")
def imperceptible_errors(data):
    counts = [(scene.name, count_stretch(feec.stretch)) for scene, feec in with_feec(data) if feec.stretch]
    return over_scenes([(name, f"{percent(count.perhaps_seen / count.num)} up to {percent(count.most)}") for name, count in counts],
                       all(count.perhaps_seen == 0 for _, count in counts), 5)


@STATEMENTS.judged_by("5.2.1", "constraints are satisfied better with more iterations",
                      "the widest joint gap is smaller with 20 iterations than with one in every scene", COUNTS, FIGURES_8_9,
                      remark="widest gap with 20 and with one iteration")
def constraints(data):
    gaps = [(scene.name, scene.methods[0].joint_gap_m, scene.find("Iter1").joint_gap_m) for scene in data.figures if scene.find("Iter1")]
    return over_scenes([(name, f"{1e3 * twenty:.3g}, {1e3 * one:.3g} mm") for name, twenty, one in gaps],
                       all(twenty < one for _, twenty, one in gaps), NUM_SCENES)


def broken_cases(stability, iterations):
    """Hard cases that break with so many iterations of quick; None if the study lacks the setting."""
    setting = f"quick, 1 x {iterations}"
    if setting not in stability["settings"]:
        return None
    return sum(result["verdict"] == "broken" for case in stability["cases"] for result in case["results"] if result["setting"] == setting)


@STATEMENTS.judged_by("5.2.1", "20 iterations are the minimum for robust simulation", "fewer hard cases break than with 10, and no fewer with 40",
                      COUNTS, ALL, papers="20", remark="the paper quotes ODE's manual; verdicts of quick in pbmpi's small hard cases")
def twenty_iterations(data):
    if data.stability is None:
        return None
    broken = {iterations: broken_cases(data.stability, iterations) for iterations in (5, 10, 20, 40, 80)}
    ten, twenty, forty = (broken[iterations] for iterations in (10, 20, 40))
    is_known = None not in (ten, twenty, forty)
    text = joined([(f"{iterations} iterations:", str(count)) for iterations, count in broken.items() if count is not None])
    return Answer(f"broken: {text}", is_known and twenty < ten and forty >= twenty, int(is_known))


STATEMENTS.undecidable("5.4", "Figure 8: bars of frame rates", "printed without numbers",
                       "ours are in the page's figure; what the text says of them is judged below")


@STATEMENTS.judged_by("5.4", "with FEEC Environ, Battle and Fight are completely satisfied", "all deliveries within 3.33 ms in the three",
                      CLOCK, FIGURES_8_9, papers="100 %", remark="with 20 iterations, then FEEC's deliveries; this machine's processor")
def satisfied_estimates(data):
    scenes = [scene for scene in map(data.find_figure, ("Environ", "Battle", "Fight")) if scene and scene.find(FEEC)]
    if not scenes:
        return None
    shares = [(scene.name, scene.methods[0].satisfied, scene.find(FEEC).satisfied) for scene in scenes]
    text = joined([(name, f"{percent(before, 0)} to {percent(after, 0)}") for name, before, after in shares])
    if len(shares) == 3 and all(before == 1 for _, before, _ in shares):
        return Answer(text, note="20 iterations leave no room")
    return Answer(text, all(after == 1 for _, _, after in shares), len(shares), 3)


@STATEMENTS.judged_by("5.4", "CrashWa and Battle prove especially difficult to satisfy", "the two slowest deliveries of FEEC in Figure 8",
                      CLOCK, FIGURES_8_9, papers="these two", remark="the sentence before has Battle satisfied: Battle2 may be meant")
def difficult_scenes(data):
    scenes = sorted(data.scenes_with(FEEC), key=lambda scene: -scene.find(FEEC).frame_s)
    if not scenes:
        return None
    slowest = scenes[:2]
    return Answer(joined([(scene.name, rate(scene.find(FEEC).rate_hz)) for scene in slowest]),
                  len(scenes) > 1 and all(scene.name in ("CrashWa", "Battle") for scene in slowest), len(scenes), len(SCENES))


@STATEMENTS.judged_by("5.4", "FEEC improves performance by 220 % on average", "at least half of that, over the scenes of Figure 8",
                      CLOCK, FIGURES_8_9, papers="+220 %",
                      remark="time of a frame of 20 iterations over that until the estimate is delivered, less 1")
def gain_of_feec(data):
    gains = [(scene.name, scene.ratio(scene.find(FEEC)) - 1) for scene in data.scenes_with(FEEC)]
    if not gains:
        return None
    mean = sum(gain for _, gain in gains) / len(gains)
    text = joined([(name, f"{100 * gain:+.0f} %") for name, gain in gains])
    return Answer(f"{100 * mean:+.0f} %: {text}", mean >= 1.1, len(gains), len(SCENES))
