"""What a study of accuracy answers: the setting to choose for a time of a frame, or for a length that it is to keep."""
import dataclasses
import math

from reports.words import number, percent

LENGTHS_M = {"1 mm": 1e-3, "1 cm": 1e-2, "10 cm": 1e-1}  # of the shares `determined` and `within`, in the order of the file
KEEPS = 0.9  # share of the bodies determined for a length that must end within it
FRAME_BUDGET_S = 3.33e-3  # the paper's, of a frame of 33.3 ms


def length_text(metres):
    """"1 mm", "10 cm"; other lengths in mm."""
    return next((name for name, value in LENGTHS_M.items() if math.isclose(value, metres)), f"{1e3 * metres:g} mm")


@dataclasses.dataclass
class Limit:
    """What is asked of a setting: a time of its worst frame, or a length that it keeps; or neither, then nothing is chosen."""
    budget_s: float | None = None
    tolerance_m: float | None = None

    def is_asked(self):
        return self.budget_s is not None or self.tolerance_m is not None

    def text(self):
        """"3.33 ms", "1 cm"."""
        return f"{1e3 * self.budget_s:g} ms" if self.budget_s else length_text(self.tolerance_m)

    def asked(self):
        return f"{'budget' if self.budget_s else 'tolerance'} {self.text()}"

    def keeps(self, case):
        if self.budget_s:
            return case.time_s <= self.budget_s and not math.isnan(case.error_m())
        if self.tolerance_m is None:
            return False
        within = case.within().get(self.text())
        return case.error_m() <= self.tolerance_m if within is None else within >= KEEPS

    def chosen(self, scene):
        """The setting with the least error within the time, or the least time of those that keep the length; None: there is none."""
        def order(one):
            return (one.error_m(), one.time_s) if self.budget_s else (one.time_s, one.error_m())

        return min((one for one in scene.settings if one.may_be_chosen() and self.keeps(one)), key=order, default=None)

    def why_none(self, scene):
        """Why nothing is chosen."""
        keeping = [one for one in scene.settings if one.finite() and self.keeps(one)]
        untried = any(one.hard and not one.hard.tried for one in keeping)
        faults = [words for words, found in (
            ("felling what stands at rest", any(one.fells() for one in keeping)),
            ("breaking hard cases", any(one.hard and one.hard.tried and not one.hard.holds() for one in keeping))) if found]
        length = self.text() if self.text() in LENGTHS_M else "1 mm"
        if scene.determined()[length] == 0:
            return f"nature determines no body to {length}"
        return (f"no setting of the study{' that was tried on the hard cases' if untried else ''} keeps it"
                + (f" without {' or '.join(faults)}" if faults else ""))


def result_text(limit, scene, one):
    """What a setting that is chosen takes and reaches: "0.129 ms, 97 % within it, 2.655 mm"."""
    share = None if limit.budget_s else one.within().get(limit.text())
    parts = [f"{1e3 * one.time_s:.3f} ms", *([] if share is None else [f"{percent(share, 0)} within it"]), f"{number(one.error_m(), '.4g', 1e3)} mm"]
    if scene.is_inside(one):
        parts.append(f"below the {1e3 * scene.uncertainty_m():.4g} mm to which nature is known")
    return ", ".join(parts)


# What every scene answers.
ANSWERS = (Limit(budget_s=FRAME_BUDGET_S), *(Limit(tolerance_m=length_m) for length_m in LENGTHS_M.values()))


def answer_json(limit, scene):
    one = limit.chosen(scene)
    if one is None:
        return {"asked": limit.text(), "setting": None, "reason": limit.why_none(scene)}
    return {"asked": limit.text(), "setting": one.setting(), "error_m": one.error_m(), "frame_time_s": one.time_s,
            "run": one.run_command()}


def answer_text(scene):
    """The sentence that says what the study is for."""
    parts = []
    for limit in ANSWERS:
        one = limit.chosen(scene)
        found = f"{one.setting()} ({result_text(limit, scene, one)})" if one else f"none, {limit.why_none(scene)}"
        asked = "least error (rms of body positions) in" if limit.budget_s else "least time for"
        parts.append(f"{asked} {limit.text()}: {found}")
    unknown = any(one.hard is None for one in scene.settings)
    text = "; ".join(parts) + (" (settings not held against the hard cases: --hard-cases stability.h5)." if unknown else ".")
    return text[0].upper() + text[1:]


def answer_command(scene):
    """The line to copy for the answer to the frame's budget; nothing where there is none."""
    best = ANSWERS[0].chosen(scene)
    return f"\n\nTo run with the first: {best.run_command()}" if best else ""
