"""The tables of the study's file (io/SCHEMA.md), as rows that are dictionaries by column."""
import numpy as np

from reports.errors import KINDS
from reports.tables import Values
from study.cases import VARIANTS, Case

MIX = ("floating_point", "integer", "branch", "store", "load")
VALUES = ("fp_load", "fp_operation", "int_load", "int_operation")  # in pbvalue's words, as the mix
COUNTS = ("executed", "repeated", "exact", "fuzzy", "wrong")


def error_columns(prefix, errors=None):
    """Of the errors of runs.joined_errors(); 0 without."""
    columns = {}
    for kind in KINDS:
        of_kind = (errors or {}).get(kind, {"rms": 0.0, "max": 0.0, "bands": [0] * 5, "broken": 0})
        columns |= {f"{prefix}_{kind}_{what}": value for what, value in of_kind.items() if what != "broken" or kind.startswith("joint")}
    return columns


def case_row(case, scene, result):
    row = {"scene": scene["name"], "name": case.name, "worlds": scene["worlds"], "warmup": scene["warmup"], "frames": scene["frames"], "stepper": case.stepper,
           "precision": case.precision, "iterations": case.iterations if case.stepper == "quick" else 0, "feec": int(case.feec),
           "threshold": case.threshold, "scope": case.scope}
    usual = {"exit_code": 0, "ended": 0, "frames_done": 0, "same_hash": 0, "nonfinite_frame": -1, "nonfinite_step": -1, "islands_mean": 0.0,
             "islands_max": 0.0, "base_islands_mean": 0.0, "errors_known": 0}
    row |= {name: type(value)(result.get(name, value)) for name, value in usual.items()}
    for prefix in ("defect", "drift", "floor"):
        row |= error_columns(prefix, result.get(prefix))
    return row


def frame_row(case_index, frame, section):
    """Of a frame, or of its estimate, in the tool's report."""
    is_modelled = section["modelled"]
    row = {"case": case_index, "frame": frame, "is_estimate": int(section["section"] == "estimate"), "instructions": section["instructions"],
           "collision_instructions": section["collision_instructions"], "micro_ops": section["micro_ops"] if is_modelled else -1,
           "cycles": section["cycles"]["none"] if is_modelled else -1, "predicted_cycles": section["cycles"]["predicted"] if is_modelled else -1}
    row |= {f"mix_{name}": section["mix"][name] for name in MIX}
    for kind in VALUES:
        hits = section["classes"][kind]
        row |= {f"{kind}_{name}": hits[name] for name in COUNTS} | {f"{kind}_{name}": float(hits[name]) for name in ("error_sum", "error_max")}
    return row


def variant_row(case_index, index, sections):
    name = list(VARIANTS)[index]
    suffix = str(index) if index else ""
    return {"case": case_index, "variant": name, "settings": VARIANTS[name],
            "cycles": sum(section["cycles"][f"none{suffix}"] for section in sections if section["modelled"]),
            "predicted_cycles": sum(section["cycles"][f"predicted{suffix}"] for section in sections if section["modelled"])}


def rows_of_case(case_index, case, scene, result):
    """{table: rows by column}."""
    frames, seen = [], {True: 0, False: 0}
    for section in result["sections"]:
        is_estimate = section["section"] == "estimate"
        frames.append(frame_row(case_index, seen[is_estimate], section))
        seen[is_estimate] += 1
    has_variants = case.has_variants and result.get("ended")
    return {"cases": [case_row(case, scene, result | {"frames_done": seen[False]})], "frames": frames,
            "sensitivity": [variant_row(case_index, index, result["sections"]) for index in range(len(VARIANTS)) if has_variants]}


def rows(request, result):
    """{table: [row]}, a row as a dictionary by column."""
    fields = {name: value for name, value in request["case"].items() if name != "cost"}
    return rows_of_case(request["index"], Case(**fields), request["scene"], result)


def columns(outcomes):
    """{table: [Values]} of the rows of all cases. Types and widths are those of a made-up case that has a row in each table."""
    hits = dict.fromkeys((*COUNTS, "error_sum", "error_max"), 0)
    section = {"section": "precise", "modelled": True, "instructions": 0, "collision_instructions": 0, "micro_ops": 0,
               "cycles": {f"{name}{suffix}": 0 for name in ("none", "predicted") for suffix in ("", *range(1, len(VARIANTS)))},
               "mix": dict.fromkeys(MIX, 0), "classes": dict.fromkeys(VALUES, hits)}
    scene = {"name": "", "worlds": 0, "warmup": 0, "frames": 0}
    samples = rows_of_case(0, Case(0, "", 0, has_variants=True), scene, {"sections": [section], "ended": 1})
    return {table: [column(name, sample, [row[name] for outcome in outcomes for row in outcome[table]]) for name, sample in its_rows[0].items()]
            for table, its_rows in samples.items()}


def column(name, sample, values):
    """A column of rows with values like the sample: a text, a number, or a list of numbers."""
    unit = next((unit for kind, unit in KINDS.items() if name.endswith((f"{kind}_rms", f"{kind}_max"))), "")
    if isinstance(sample, str):
        return Values(name, unit, values)
    like = np.array(sample)
    return Values(name, unit, np.array(values, like.dtype).reshape(len(values), *like.shape))
