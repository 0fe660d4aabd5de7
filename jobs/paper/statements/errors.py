"""What few iterations do to the result: sections 5.2.1 and 5.4, Figure 9."""
from reports.words import percent

from figures import FEEC, SCENES
from statements.statement import COUNTS, FIGURES_8_9, Answer, Statements, joined, over_scenes

STATEMENTS = Statements()
WORST = -1  # infinite or NaN


def share_of_band(errors, band):
    return errors["bands"][band] / errors["count"] if errors["count"] else 0


def beyond_1_cm(errors):
    """Share of positions that are off by 1 cm or more, or not finite."""
    return 1 - share_of_band(errors, 0)


def blown_up(method):
    """The largest share of infinite or NaN errors of a kind."""
    return max(share_of_band(errors, WORST) for errors in method.errors.values())


def mean_of_floor(scene, number):
    """Of the positions with other solver seeds; 0 without."""
    return sum(number(errors["body_position_m"]) / len(scene.floor) for errors in scene.floor)


@STATEMENTS.judged_by("5.2.1", "fewer iterations drastically increase errors, which accumulate",
                      "one iteration has ten times the rms of 19 or more, in most scenes of Figure 9", COUNTS, FIGURES_8_9,
                      remark="rms of positions against 20 iterations: 19; 1; another seed, on average")
def iteration_reduction(data):
    rms = [(scene.name, scene.find("Iter19").positions["rms"], scene.find("Iter1").positions["rms"],
            mean_of_floor(scene, lambda errors: errors["rms"])) for scene in data.scenes_with("Iter19", "Iter1")]
    drastic = sum(one >= 10 * nineteen for _, nineteen, one, _ in rms)
    return over_scenes([(name, f"{1e3 * nineteen:.3g}; {1e3 * one:.3g}; {1e3 * floor:.3g} mm") for name, nineteen, one, floor in rms],
                       2 * drastic > len(rms), len(SCENES))


STATEMENTS.undecidable("5.4", "Figure 9: categories of errors", "printed without numbers",
                       "ours are in the page's figure; what the text says of them is judged below")


@STATEMENTS.judged_by("5.4", "FEEC's errors are comparable to those of 19 iterations",
                      "no category of positions differs by more than ten points, in most scenes of Figure 9", COUNTS, FIGURES_8_9,
                      remark="positions 1 cm or more off: FEEC's estimates, 19 iterations, other seeds. FEEC's are defects of a frame, those "
                             "of 19 iterations drift, as large as another seed's")
def nineteen_iterations(data):
    found, comparable = [], 0
    for scene in data.scenes_with("Iter19", FEEC):
        feec, nineteen = scene.find(FEEC).positions, scene.find("Iter19").positions
        apart = max(abs(share_of_band(feec, band) - share_of_band(nineteen, band)) for band in range(len(feec["bands"])))
        floor = percent(mean_of_floor(scene, beyond_1_cm), 0) if scene.floor else "-"
        found.append((scene.name, f"{percent(beyond_1_cm(feec), 0)}, {percent(beyond_1_cm(nineteen), 0)}, {floor}"))
        comparable += apart <= 0.1
    return over_scenes(found, 2 * comparable > len(found), len(SCENES))


@STATEMENTS.judged_by("5.4", "FEEC does sometimes better and sometimes worse than 19 iterations",
                      "fewer positions 1 cm or more off in one scene of Figure 9 at least, more in another", COUNTS, FIGURES_8_9)
def better_and_worse(data):
    pairs = [(scene.name, beyond_1_cm(scene.find(FEEC).positions), beyond_1_cm(scene.find("Iter19").positions))
             for scene in data.scenes_with("Iter19", FEEC)]
    if not pairs:
        return None
    better, worse = [(name, "") for name, feec, other in pairs if feec < other], [(name, "") for name, feec, other in pairs if feec > other]
    return Answer(f"better: {joined(better) or 'none'}; worse: {joined(worse) or 'none'}", bool(better and worse), len(pairs), len(SCENES))


@STATEMENTS.judged_by("5.4", "19 iterations and FEEC blow up in few cases",
                      "less than 1 % infinite or NaN in every category and scene of Figure 9", COUNTS, FIGURES_8_9, papers="few")
def few_blow_ups(data):
    scenes = data.scenes_with("Iter19", FEEC)
    if not scenes:
        return None
    most = max(blown_up(scene.find(label)) for scene in scenes for label in ("Iter19", FEEC))
    return Answer(f"{percent(most)} at most", most < 0.01, len(scenes), len(SCENES))


@STATEMENTS.judged_by("5.4", "one iteration has a substantial number of the highest class of errors",
                      "1 % or more infinite or NaN in most scenes of Figure 9", COUNTS, FIGURES_8_9, papers="substantial",
                      remark="positions: infinite or NaN; more than 100 cm off")
def one_iteration(data):
    scenes = [(scene.name, scene.find("Iter1")) for scene in data.scenes_with("Iter1")]
    substantial = sum(blown_up(method) >= 0.01 for _, method in scenes)
    return over_scenes([(name, "; ".join(percent(share_of_band(method.positions, band)) for band in (WORST, WORST - 1)))
                        for name, method in scenes], 2 * substantial > len(scenes), len(SCENES))


STATEMENTS.undecidable("5.4", "images of one iteration are not usable", "-", "images are not judged here")
