"""Value prediction: section 5.1 and its part of 5.4, judged by the study of predict.py."""
import dataclasses
import math

from prediction import figure_8
from statements.statement import NOT_MEASURED, PREDICTION, Answer, Statements
from statements.suite import COLLISION_SAYS, MIX_SAYS, judge_collision_share, judge_mix

PROCESSOR = "modelled processor of Table 3 (docs/research/prediction.md)"
NO_CYCLES = "no cycles"
OF_THE_STUDY = Statements()  # judged by the study alone


def judged_by(section, text, rule):
    return OF_THE_STUDY.judged_by(section, text, rule, PREDICTION, "jobs/paper.sh --prediction")


def gain(scene, fvp, name):
    """A bar's gain over 20Iter; None if one of the two was not modelled, or its run blew up: a world that has lost bodies has less to
    compute."""
    case = scene.find(name)
    if case is not None and case.is_broken():
        return None
    bars = figure_8(scene, fvp)
    rates = [bar.rate.hz for bar in bars if bar.name == name]
    return rates[0] / bars[0].rate.hz - 1 if rates and math.isfinite(rates[0]) and math.isfinite(bars[0].rate.hz) else None


def gains_of(study, name):
    """[(scene, gain)] of the scenes that have one."""
    found = [(scene, gain(scene, study.fvp, name)) for scene in study.scenes]
    return [(scene, one) for scene, one in found if one is not None]


def mean_gain(study, name):
    gains = [one for _, one in gains_of(study, name)]
    return sum(gains) / len(gains) if gains else None


@judged_by("5.1", "exact prediction leaves the result as it is", "the same bits in every scene")
def exact(study):
    same = [scene.base.same_hash for scene in study.scenes]
    return Answer(f"the same bits in {sum(same)} of {len(same)} scenes", all(same)) if same else Answer(NOT_MEASURED)


@judged_by("5.1", "results blow up, even with a threshold of 1e-12", "a number that is not finite, or a crash, with 1e-12")
def blow_ups(study):
    broken, parts = [], []
    for name in ("FVP6", "FVP8", "FVP10", "FVP12"):
        cases = [scene.find(name) for scene in study.scenes]
        broken = [case.is_broken() for case in cases if case and (case.ended or case.has_crashed())]
        if broken:
            parts.append(f"{name} in {sum(broken)} of {len(broken)} scenes")
    return Answer(f"not finite or crashed: {', '.join(parts)}", any(broken)) if broken else Answer("no run with 1e-12")


@judged_by("5.1", "prediction in collision, in the forward step or in both behaves alike", "drift within a factor of ten")
def scopes(study):
    for scene in study.scenes:
        cases = [scene.find(study.fvp + scope) for scope in (" collision", " step", "")]
        if None not in cases:
            drift = [case.rms("drift") for case in cases]
            return Answer(f"{scene.name}: drift " + ", ".join(f"{1e3 * one:.3g} mm" for one in drift), max(drift) <= 10 * min(drift))
    return Answer("no case of single phases")


@judged_by("5.4", "FVP6 raises Battle2's frame rate by 24 %", "at least half of that")
def battle2(study):
    scene = study.find("Battle2")
    if scene is None:
        return Answer(NOT_MEASURED)
    gained = gain(scene, study.fvp, study.fvp)
    return Answer("no frame was measured before the run ended") if gained is None else Answer(f"{100 * gained:+.1f} %", gained >= 0.12)


@judged_by("5.4", "FVP6 alone sees more frames of Fight satisfied", "more than 20Iter")
def fight(study):
    scene = study.find("Fight")
    case = scene and scene.find(study.fvp)
    if not case or not math.isfinite(case.predicted.satisfied):
        return Answer(NOT_MEASURED)
    before, after = scene.base.unpredicted.satisfied, case.predicted.satisfied
    no_room = before == after and before in (0, 1)
    return Answer(f"{100 * after:.0f} % instead of {100 * before:.0f} %", None if no_room else after > before)


@judged_by("5.4", "FEEC raises the frame rate by 220 % on average", "at least half of that")
def feec(study):
    gained = mean_gain(study, "FEEC")
    return Answer(NO_CYCLES) if gained is None else Answer(f"{100 * gained:+.0f} %", gained >= 1.1)


@judged_by("5.4", "value prediction is less attractive than FEEC", "it gains less on average")
def comparison(study):
    of_feec, fvp, evp = (mean_gain(study, name) for name in ("FEEC", study.fvp, "EVP"))
    if None in (of_feec, fvp, evp):
        return Answer(NO_CYCLES)
    return Answer(f"{study.fvp} {100 * fvp:+.1f} %, EVP {100 * evp:+.1f} %, FEEC {100 * of_feec:+.0f} %", max(fvp, evp) < of_feec)


def slowed_down(study):
    """The scenes in which FEEC with FVP is slower than FEEC alone, and the number of scenes compared."""
    alone = {scene.name: one for scene, one in gains_of(study, "FEEC")}
    both = [(scene, one) for scene, one in gains_of(study, f"FEEC+{study.fvp}") if scene.name in alone]
    return [scene for scene, one in both if one < alone[scene.name]], len(both)


@judged_by("5.4", "FVP6 with FEEC slows three tests down, and is marginally faster in the rest", "slower in two to four scenes")
def both_methods(study):
    slower, num = slowed_down(study)
    names = f" ({', '.join(scene.name for scene in slower)})" if slower else ""
    return Answer(f"slower in {len(slower)} of {num} scenes{names}", 2 <= len(slower) <= 4) if num else Answer(NO_CYCLES)


@judged_by("5.4", "it is slower there mainly because larger islands form", "fewer islands in most of these scenes")
def larger_islands(study):
    cases = [scene.find(f"FEEC+{study.fvp}") for scene in slowed_down(study)[0]]
    fewer = [case.islands < case.base_islands for case in cases if math.isfinite(case.islands)]
    return Answer(f"fewer islands in {sum(fewer)} of {len(fewer)}", 2 * sum(fewer) > len(fewer)) if fewer else Answer("slower in no scene")


@judged_by("6", "FVP6 does not significantly accelerate the majority of workloads", "less than 10 % in most scenes")
def majority(study):
    slow = [one < 0.1 for _, one in gains_of(study, study.fvp)]
    return Answer(f"less than 10 % in {sum(slow)} of {len(slow)} scenes", 2 * sum(slow) > len(slow)) if slow else Answer(NO_CYCLES)


def of_any_number(answer):
    """The study's own scenes are all that it is about."""
    return dataclasses.replace(answer, needed=0) if answer else Answer(NOT_MEASURED)


IN_PAPER = list(OF_THE_STUDY)  # the rest is judged among the statements of the suite, as callgrind counts


@judged_by(*MIX_SAYS)
def mix(study):
    return of_any_number(judge_mix([scene.base.mix for scene in study.scenes]))


@judged_by(*COLLISION_SAYS)
def collision(study):
    return of_any_number(judge_collision_share([scene.base.collision_share for scene in study.scenes]))


def judge_study(study):
    """The verdict on each statement, by the study alone."""
    return [statement.judged(study) for statement in OF_THE_STUDY]


def among_all(statement):
    """The statement, judged by all that was measured; without a study none is decided."""
    def judge(data):
        if data.prediction is None:
            return None
        answer = statement.judge(data.prediction)
        if answer.ours == NOT_MEASURED:
            return None
        is_open = answer.holds is None
        return dataclasses.replace(answer, note="the study's default form with all nine scenes, or there is no room" if is_open else PROCESSOR)
    return dataclasses.replace(statement, judge=judge)


STATEMENTS = Statements()
STATEMENTS.undecidable("5.1", "an error of 1e-6 m is visually negligible", "1e-6 m", "no observers here")
STATEMENTS.extend(map(among_all, IN_PAPER))
