"""Steps a scene's window by two settings in turn, for engines.py: `window.py JSON`, prints JSON.

A process of its own, so that it can be stopped, and on the one core that it is given. Times are processor times of the steps alone.
"""
import json
import os
import pathlib
import sys
import time

BIN = pathlib.Path(os.environ["PBMPI_BIN"])
sys.path.insert(0, str(BIN.parent / "python"))

import pbmpi  # noqa: E402

LEAST_S = 0.1      # a shorter window is stepped again, and the shortest time counts
MOST_WINDOWS = 12  # of a setting in a round


class Window:
    """A batch that begins its measured frames again and again."""

    def __init__(self, task, engine, options, parts):
        """`parts`: steps of the engine in one of the scene."""
        self.frames = task["frames"]
        self.batch = pbmpi.Batch(task["scene"], task["worlds"], stepper=engine, dt=task["dt"] / parts, **options)
        self.steps = (task["steps_per_frame"] or self.batch.steps_per_frame) * parts
        start = time.process_time()
        self.batch.step(1)
        self.first_step_s = (time.process_time() - start) * parts
        self.rest_of_warmup = task["warmup"] * self.steps - 1
        self.saved = None
        self.errors = {"joint_gap": 0.0, "max_penetration": 0.0, "energy": 0.0, "nonfinite": 0.0, "contacts": 0.0}
        self.digits = set()

    def warm_up(self):
        if self.rest_of_warmup > 0:
            self.batch.step(self.rest_of_warmup)
        self.saved = self.batch.save()

    def run(self):
        """Seconds of the measured frames."""
        self.batch.load(self.saved)
        self.batch.step(0)
        seconds = 0.0
        for _ in range(self.frames):
            start = time.process_time()
            self.batch.step(self.steps)
            seconds += time.process_time() - start
            self.observe()
        self.digits.add(self.batch.hash())
        return seconds

    def observe(self):
        """The largest errors of all worlds and frames, and energy and contacts of the last."""
        seen = self.batch.observable
        for name in ("joint_gap", "max_penetration"):
            self.errors[name] = max(self.errors[name], float(seen(name).max()))
        self.errors["nonfinite"] += float(seen("nonfinite").sum())
        self.errors["energy"], self.errors["contacts"] = float(seen("energy").sum()), float(seen("contacts").sum())


def shortest(window):
    """Of as many runs as it takes to measure them."""
    times = [window.run()]
    while sum(times) < LEAST_S and len(times) < MOST_WINDOWS:
        times.append(window.run())
    return min(times)


def start_energy(task):
    """[J] of all worlds: after a step of next to no time."""
    batch = pbmpi.Batch(task["scene"], task["worlds"], stepper="quick", dt="1e-9s")
    batch.step(1)
    return float(batch.observable("energy").sum())


def main():
    task = json.loads(sys.argv[1])
    os.sched_setaffinity(0, {task["core"]})
    window = Window(task, task["engine"], task["options"], task["parts"])
    if window.first_step_s > task["step_limit"]:
        return {"why_not": f"beyond {task['step_limit']:g} s a step"}
    window.warm_up()
    base = Window(task, "sor", task["base"], 1)
    base.warm_up()
    pairs = [(shortest(base), shortest(window)) for _ in range(task["rounds"])]
    if window.errors["nonfinite"] > 0:
        return {"why_not": "not finite"}
    if len(window.digits) > 1:
        return {"why_not": "two runs of the same window differ"}
    return {"pairs": pairs, "worlds": window.batch.num_worlds, "world_steps": window.batch.num_worlds * base.steps * window.frames,
            "hash": window.digits.pop(), "start_energy": start_energy(task) if task["at_rest"] else None, **window.errors}


if __name__ == "__main__":
    try:
        print(json.dumps(main()))
    except (ValueError, RuntimeError) as error:
        print(json.dumps({"why_not": str(error).splitlines()[0]}))
