"""Verdicts as text, Markdown and JSON, and the study of value prediction likewise."""
from reports import document
from reports.words import number, percent, plural

import prediction
from instructions import MIX
from statements.prediction import judge_study
from statements.statement import FINDINGS

HEADER = ("section", "verdict", "the paper", "its value", "confirmed if", "ours", "rests on", "remark")


def cells_of(verdict):
    """The row of a verdict under HEADER."""
    statement = verdict.statement
    return [statement.section, verdict.finding, statement.text, statement.papers, statement.rule, verdict.ours, statement.basis, verdict.remark]


def count_findings(verdicts):
    """Of each finding, in the order of FINDINGS."""
    return [sum(verdict.finding == finding for verdict in verdicts) for finding in FINDINGS]


def counts_text(chapters):
    counts = count_findings([verdict for chapter in chapters for verdict in chapter.entries])
    return ", ".join(f"{count} {finding}" for count, finding in zip(counts, FINDINGS))


def paper_text(chapters):
    text = ""
    for chapter in chapters:
        text += chapter.title + "\n"
        for verdict in chapter.entries:
            statement = verdict.statement
            papers = f" (paper: {statement.papers})" if statement.papers != "-" else ""
            remark = f"; {verdict.remark}" if verdict.remark else ""
            text += (f"  {statement.section:<6} {verdict.finding:<18} {statement.text}\n"
                     f"  {'':<25} ours: {verdict.ours}{papers}{remark}\n")
        text += "\n"
    return f"{text}statements: {counts_text(chapters)}\n"


def markdown_table(head, rows):
    return document.markdown_table([head, *([cell or "-" for cell in row] for row in rows)], rule="|" + " --- |" * len(head))


def paper_markdown(chapters):
    """One table a chapter, under its title."""
    tables = [f"## {chapter.title}\n\n{markdown_table(HEADER, map(cells_of, chapter.entries))}\n" for chapter in chapters]
    return "".join(tables) + counts_text(chapters)


def paper_json(chapters):
    return {"statements": [
        {"chapter": chapter.title, "section": verdict.statement.section, "statement": verdict.statement.text,
         "paper": verdict.statement.papers, "rule": verdict.statement.rule, "ours": verdict.ours, "finding": verdict.finding,
         "rests_on": verdict.statement.basis, "measured_by": verdict.statement.command, "remark": verdict.remark}
        for chapter in chapters for verdict in chapter.entries]}


def bands_text(bands):
    return "/".join(map(str, bands))


def plural_worlds(scene):
    return f"{plural(scene.worlds, 'world')}, {scene.warmup} + {scene.frames} frames"


def bars_text(scene, fvp):
    text = f"  {'Figure 8':<12} {'Hz':>12} {'satisfied':>10}\n"
    for bar in prediction.figure_8(scene, fvp):
        fate = f"  {bar.case.fate()}" if bar.case and bar.case.fate() else ""
        text += f"  {bar.name:<12} {number(bar.rate.hz, '.1f'):>12} {percent(bar.rate.satisfied, 0):>10}{fate}\n"
    return text


def errors_cells(case):
    """Drift and defect [mm], and the bands of the drift; dashes where they are not known."""
    if not case.errors_known:
        return ["-"] * 3
    return [f"{1e3 * case.rms('drift'):.3g}", f"{1e3 * case.rms('defect'):.3g}", bands_text(case.errors["drift"][1])]


def cases_text(scene):
    text = f"  {'case':<16} {'coverage':>9} {'hit rate':>9} {'drift [mm]':>11} {'defect [mm]':>11}  {'drift < 1 cm ... NaN':<22} \n"
    for case in scene.cases:
        hits, (drift, defect, bands) = case.hits(), errors_cells(case)
        text += (f"  {case.name:<16} {percent(hits.coverage()):>9} {percent(hits.hit_rate()):>9} {drift:>11} {defect:>11}  "
                 f"{bands:<22} {case.fate()}\n")
    rms, bands = scene.base.errors["floor"]
    return text + f"  {'noise floor':<16} {'':>9} {'':>9} {1e3 * rms:11.3g} {'':>11}  {bands_text(bands)}\n"


ENGINE_HEAD = ["scene", "engine", "exact: coverage", "hit rate", "fuzzy: coverage", "hit rate", "mean accepted error"]


def engine_rows(study):
    """Under ENGINE_HEAD: hits of floating-point results by scene and engine."""
    rows = []
    for scene in study.scenes:
        for engine, (exact, fuzzy) in prediction.engines_of(scene, study.fvp).items():
            rates = [percent(share) for hits in (exact, fuzzy) for share in (hits.coverage(), hits.hit_rate())]
            rows.append([scene.name, engine, *rates, number(fuzzy.mean_error(), ".1e")])
    return rows


def engines_text(study):
    text = f"\nHits of floating-point results by engine ({study.fvp}):\n"
    for scene, engine, *cells in (ENGINE_HEAD, *engine_rows(study)):
        text += f"  {scene:<10} {engine:<13} {cells[0]:>15} {cells[1]:>9} {cells[2]:>15} {cells[3]:>9} {cells[4]}\n"
    return text


def sensitivity_text(study):
    if not study.sensitivity:
        return ""
    rows = [f"  {row.scene:<10} {row.case:<8} {row.variant:<32} {row.cycles:14.0f} {row.predicted_cycles:14.0f} {100 * row.gain():+7.2f} %\n"
            for row in study.sensitivity]
    return "\nWhat other processors would change (cycles without and with prediction):\n" + "".join(rows)


def prediction_text(study):
    text = (f"study: prediction; {len(study.scenes)} scenes, cycles of the paper's Table 3 at 3 GHz, budget {1e3 * study.budget_s:.3g} ms\n")
    for scene in study.scenes:
        base = scene.base
        text += (f"\n{scene.name} ({plural_worlds(scene)}, {1e-6 * base.instructions:.2f} million instructions a frame, "
                 f"{100 * base.collision_share:.0f} % of them collision)\n{bars_text(scene, study.fvp)}{cases_text(scene)}")
    text += engines_text(study) + sensitivity_text(study) + "\nThe paper's statements:\n"
    for verdict in judge_study(study):
        text += f"  {verdict.finding:<18} {verdict.statement.text}: {verdict.ours} (confirmed: {verdict.statement.rule})\n"
    return text


def prediction_markdown(study):
    """Frame rates, hits and verdicts as tables."""
    names = [bar.name for bar in prediction.figure_8(study.scenes[0], study.fvp)]
    rates = [[scene.name, *(number(bar.rate.hz, ".0f") for bar in prediction.figure_8(scene, study.fvp))] for scene in study.scenes]
    verdicts = [[verdict.statement.text, verdict.finding, verdict.ours] for verdict in judge_study(study)]
    return "\n".join((markdown_table(["scene", *names], rates), markdown_table(ENGINE_HEAD, engine_rows(study)),
                      markdown_table(["statement", "finding", "number"], verdicts)))


def hits_json(hits):
    return {"executed": hits.executed, "exact": hits.exact, "fuzzy": hits.fuzzy, "wrong": hits.wrong, "coverage": hits.coverage(),
            "hit_rate": hits.hit_rate(), "mean_accepted_error": hits.mean_error(), "max_accepted_error": hits.error_max}


def rate_json(rate):
    return {"hz": rate.hz, "satisfied": rate.satisfied}


def case_json(case):
    errors = {f"{name}_m": {"rms": case.errors[kind][0], "bands": case.errors[kind][1]}
              for name, kind in (("defect", "defect"), ("drift", "drift"), ("noise_floor", "floor"))}
    first_bad = {name: value if value >= 0 else None
                 for name, value in (("nonfinite_step", case.nonfinite_step), ("nonfinite_frame", case.nonfinite_frame))}
    return {"name": case.name, "stepper": case.stepper, "precision": case.precision, "scope": case.scope, "threshold": case.threshold,
            "ended": case.ended, "frames_done": case.frames_done, "measured_frames": case.measured, "same_state_hash": case.same_hash,
            **first_bad, "islands_mean": case.islands, "unpredicted_islands_mean": case.base_islands,
            "instructions_per_frame": case.instructions, "loads": hits_json(case.loads), "operations": hits_json(case.operations),
            "unpredicted": rate_json(case.unpredicted), "predicted": rate_json(case.predicted), **errors}


def scene_json(scene, fvp):
    return {"scene": scene.name, "worlds": scene.worlds, "warmup": scene.warmup, "frames": scene.frames,
            "collision_share": scene.base.collision_share, "mix": dict(zip(MIX, scene.base.mix)),
            "figure_8": {bar.name: rate_json(bar.rate) for bar in prediction.figure_8(scene, fvp)},
            "engines": {engine: {"exact": hits_json(exact), "fuzzy": hits_json(fuzzy)}
                        for engine, (exact, fuzzy) in prediction.engines_of(scene, fvp).items()},
            "cases": list(map(case_json, scene.cases))}


def prediction_json(study):
    return {
        "budget_s": study.budget_s, "processor_hz": prediction.PROCESSOR_HZ,
        "scenes": [scene_json(scene, study.fvp) for scene in study.scenes],
        "sensitivity": [{"scene": row.scene, "case": row.case, "variant": row.variant, "cycles": row.cycles,
                         "predicted_cycles": row.predicted_cycles} for row in study.sensitivity],
        "statements": [{"statement": verdict.statement.text, "finding": verdict.finding, "number": verdict.ours,
                        "rule": verdict.statement.rule} for verdict in judge_study(study)]}
