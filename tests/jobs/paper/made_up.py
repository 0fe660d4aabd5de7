"""Measurements that nobody made: those of a machine and programs that reproduce the paper's results."""
import dataclasses
import os
import sys

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path[:0] = [os.path.join(SOURCE, "jobs", "paper"), os.path.join(SOURCE, "src", "app")]

import figures  # noqa: E402
import instructions  # noqa: E402
import suite  # noqa: E402
from data import PaperData  # noqa: E402
from islands import PAPER  # noqa: E402

SIMPLE = ("2-Cars", "10-Cars", "CrashSk")


def linear(rows):
    return 1e-8 * rows


def cubic(rows):
    return 1e-9 * rows ** 3


def work_of(scene, iterations, cost):
    """A solver's steps: the time of an island is its cost by its rows, times the iterations."""
    islands = [[(rows, cost(rows) * (iterations or 1))] for rows in (50, 100, 200, 400, 800)]
    return suite.Work(scene, iterations, 3, 10e-3, islands)


def rate(hz):
    return suite.Rate(hz, 1.0 if hz >= 300 else 0.0)


def parallel_hz(scene, serial_hz):
    gain = {"100CrSk": 50, "Battle": 4, "Fight": 4}
    return serial_hz * gain.get(scene, 1.1)


def suite_of(scene):
    """A run with the paper's numbers or, where it gives none, with numbers that match its words."""
    row, serial_hz = PAPER[scene], 400 if scene in SIMPLE else 28
    parallel = parallel_hz(scene, serial_hz)
    work = work_of(scene, 20, linear)
    work.frame_s = 1e-3
    return suite.Suite(
        scene, dataclasses.replace(row.islands), int(row.spaces.rpartition(" ")[2]),
        0 if row.traffic == "none" else 3, [2] * 5 if scene == "2-Cars" else [9, 8, 7, 7, 6], row.cores,
        longest_share=0.9 if scene == "CrashWa" else 0.2, longest_share_parallel=0.8, spaces_share=0.5, serial=rate(serial_hz),
        islands_parallel=rate(parallel), spaces_parallel=rate(parallel), collide_share_serial=0.08,
        collide_share_parallel=0.55 if scene == "100CrSk" else 0.2, work=work, actor_bodies={"human": [16], "car": [5]}, bodies=100)


def errors_of(bands, rms_m):
    """Errors of positions; none of the other kinds."""
    none = {"count": 0, "rms": 0, "p99": 0, "max": 0, "bands": [0] * 5}
    return {f"{name}_{unit}": dict(none) for name, unit, *_ in figures.ERRORS} | {
        "body_position_m": {"count": sum(bands), "rms": rms_m, "p99": 0, "max": 0, "bands": bands}}


def method_of(label, bands, rms_m, frame_s):
    is_estimate = label.startswith("FEEC")
    return figures.Method(label, is_estimate, 1, frame_s, 1 / frame_s, float(frame_s <= 1 / 300), errors_of(bands, rms_m), is_estimate,
                          [0.001, 0.02], 0.1 if label == "Iter1" else 0.01)


def figure_of(name):
    """CrashWa and Battle take longest; Fight's estimates are worse than 19 iterations, the others' better."""
    feec_s = 3e-3 if name in ("CrashWa", "Battle") else 2e-3
    nineteen = method_of("Iter19", [90, 10, 0, 0, 0], 0.01, 3.1 * feec_s)
    feec = method_of(figures.FEEC, [85, 15, 0, 0, 0] if name == "Fight" else [95, 5, 0, 0, 0], 0.01, feec_s)
    return figures.Scene(name, [method_of("Iter20", [100, 0, 0, 0, 0], 0, 3.2 * feec_s), nineteen,
                                method_of("Iter1", [40, 20, 20, 10, 10], 1, feec_s), feec], [nineteen.errors])


def counted(name):
    quick, direct = (instructions.Counts(per_frame, 0.07, instructions.PAPER_MIX) for per_frame in (10e6, 50e6))
    return instructions.CountedScene(name, quick, direct)


def stability_as_in_the_manual():
    """As `pbreport stability --json` prints it: ten iterations break every case."""
    settings = {"quick, 1 x 10": "broken", "quick, 1 x 20": "pass", "quick, 1 x 40": "pass"}
    cases = ("hard/contact/half_embedded", "hard/contact/overlapping_rows", "hard/rest/column10")
    return {"settings": list(settings),
            "cases": [{"scene": case, "results": [{"setting": setting, "verdict": verdict} for setting, verdict in settings.items()]}
                      for case in cases]}


def as_in_the_paper():
    """PaperData of such a machine."""
    data = PaperData(more_iterations=[work_of("CrashWa", 40, linear), work_of("CrashWa", 80, linear)],
                     plain=[("CrashWa", 0), ("hard/contact/bullets_50", 0)], stability=stability_as_in_the_manual())
    for scene in PAPER:
        data.suite.append(suite_of(scene))
        data.one_iteration.append(suite_of(scene))
        data.one_iteration[-1].spaces_parallel = rate(100 if scene == "Battle2" else 400)
        data.direct.append(work_of(scene, 0, cubic))
        data.counts.append(counted(scene))
        data.figures.append(figure_of(scene))
    return data
