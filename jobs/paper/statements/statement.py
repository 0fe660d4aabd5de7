"""A statement of the paper as data: what it says, the rule by which it counts as confirmed, and the function that judges it.

A function that judges takes all that was measured and gives back an Answer, or None where nothing was measured for it."""
import dataclasses
from collections.abc import Callable

CONFIRMED, REFUTED, UNDECIDABLE = FINDINGS = ("confirmed", "refuted", "not decidable here")
NOT_MEASURED = "not measured"
NUM_SCENES = 9  # of the suite
# What a number rests on: the same bits in each run; times of this machine; callgrind; the modelled processor; nothing decides it.
COUNTS, CLOCK, INSTRUCTIONS, PREDICTION, NOTHING = ("counts", "clock", "instructions", "prediction", "nothing")
FIGURE_3, FIGURE_6, FIGURES_8_9, ALL = ("jobs/figure3.sh", "jobs/figure6.sh", "jobs/figure8_9.sh", "jobs/paper.sh")


@dataclasses.dataclass
class Answer:
    """Ours, and whether it confirms the statement; None if that cannot be told. Unless all scenes that the statement is about were
    measured it is not decided. `note` is added to the statement's remark."""
    ours: str
    holds: bool | None = None
    measured: int = 1
    needed: int = 1
    note: str = ""


@dataclasses.dataclass(frozen=True)
class Statement:
    section: str
    text: str  # the paper's, abridged
    papers: str  # the paper's value
    rule: str
    basis: str
    command: str = ""  # measures the number
    remark: str = ""
    judge: Callable = None

    def judged(self, data):
        """The verdict on it, by what was measured."""
        answer = self.judge(data) if self.judge else Answer("-")
        if answer is None:
            return Verdict(self, UNDECIDABLE, NOT_MEASURED, f"measured by {self.command}")
        remark = "; ".join(part for part in (self.remark, answer.note) if part)
        finding = UNDECIDABLE if answer.holds is None else CONFIRMED if answer.holds else REFUTED
        if answer.holds is not None and answer.measured < answer.needed:
            finding = UNDECIDABLE
            remark = f"{answer.measured} of {answer.needed} scenes; all: {ALL}" + (f"; {remark}" if remark else "")
        return Verdict(self, finding, answer.ours, remark)


@dataclasses.dataclass(frozen=True)
class Verdict:
    statement: Statement
    finding: str
    ours: str
    remark: str  # why it is so, what differs, or how to measure it


class Statements(list):
    """Statements in the order of the source."""

    def judged_by(self, section, text, rule, basis, command="", papers="-", remark=""):
        """Adds the statement that the decorated function judges."""
        def add(judge):
            self.append(Statement(section, text, papers, rule, basis, command, remark, judge))
            return judge
        return add

    def undecidable(self, section, text, papers, reason):
        """Adds a statement that nothing here can decide."""
        self.append(Statement(section, text, papers, "-", NOTHING, remark=reason))


def joined(pairs):
    """ "CrashWa 3, Fight 4" of (scene, number); a scene alone where there is no number."""
    return ", ".join(f"{scene} {number}" if number else scene for scene, number in pairs)


def over_scenes(pairs, holds, needed, lead=""):
    """The answer that lists (scene, number); None without scenes."""
    return Answer(lead + joined(pairs), holds, len(pairs), needed) if pairs else None


def is_near(ours, papers):
    """Is it within a tenth of the paper's?"""
    return abs(ours - papers) <= 0.1 * papers


def rate(hz):
    return f"{hz:.3g} Hz" if hz < 100 else f"{hz:.0f} Hz"
