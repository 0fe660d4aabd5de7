"""All statements of the paper, in its order, by chapters. The rules were written before the numbers were known."""
import dataclasses

from statements import engine, errors, estimate, load, parallel, performance, prediction, suite


@dataclasses.dataclass(frozen=True)
class Chapter:
    """A part of the paper with its statements or, once they are judged, their verdicts."""
    name: str  # one word, for a diagram
    title: str
    entries: list


CHAPTERS = (
    Chapter("load", "What such simulations ask for (sections 1 and 2)", load.STATEMENTS + engine.STATEMENTS),
    Chapter("suite", "The suite (section 3)", suite.STATEMENTS),
    Chapter("performance", "Performance (section 4)", performance.STATEMENTS + parallel.STATEMENTS),
    Chapter("prediction", "Value prediction (section 5.1)", prediction.STATEMENTS),
    Chapter("FEEC", "Fast estimation with error control (section 5.2)", estimate.STATEMENTS + errors.STATEMENTS),
)


def judged(data):
    """The chapters with a verdict on each of their statements, by what was measured."""
    return [dataclasses.replace(chapter, entries=[statement.judged(data) for statement in chapter.entries]) for chapter in CHAPTERS]
