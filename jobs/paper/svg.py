"""Bar charts as SVG: one group of bars a scene, side by side or stacked, on a linear or a logarithmic axis."""
import dataclasses
import html
import math

HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 320, 64, 12, 10, 34
BAR, WIDEST_BAR, GAP, LEAST_GROUP = 13, 44, 22, 66  # pixels
LEAST_WIDTH = 480


@dataclasses.dataclass
class Bars:
    """One bar, or part of a stack, in each group; None where a group has none."""
    label: str
    values: list
    colour: str
    stack: str = ""  # bars of one stack lie on each other; empty: each for itself


@dataclasses.dataclass
class Chart:
    """A chart with its title, a line below it, and its bars over the groups. `most`: the end of a linear axis; `levels`: [(value,
    label, colour)] of dashed lines; `key`: [(label, colour)] instead of the bars' own."""
    title: str
    text: str
    groups: list
    bars: list
    axis: str
    is_logarithmic: bool = False
    most: float = None
    levels: list = dataclasses.field(default_factory=list)
    key: list = None


def finite_values(chart):
    return [value for bars in chart.bars for value in bars.values if value is not None and math.isfinite(value)]


def round_up(value):
    """The next of 1, 2, 5, 10, 20 ..."""
    power = 10.0 ** math.floor(math.log10(value)) if value > 0 else 1
    return next(step * power for step in (1, 2, 5, 10) if step * power >= value * (1 - 1e-9))


class Axis:
    """Places values, from `low` at the bottom to `high` at the top."""

    def __init__(self, chart):
        positive = [value for value in [*finite_values(chart), *(level[0] for level in chart.levels)] if value > 0]
        self.is_logarithmic = chart.is_logarithmic
        if self.is_logarithmic:
            least, most = (min(positive), max(positive)) if positive else (1, 10)
            first = math.ceil(math.log10(least)) - 1
            last = max(math.ceil(math.log10(most)), first + 1)
            self.low, self.high = 10.0 ** first, 10.0 ** last
            self.ticks = [10.0 ** exponent for exponent in range(first, last + 1)]
        else:
            self.low, self.high = 0.0, chart.most or round_up(max(positive, default=1))
            self.ticks = [self.high * part / 5 for part in range(6)]

    def y(self, value):
        """Pixels from the top of the picture; values off the axis lie on its end."""
        value = min(max(value, self.low), self.high)
        part = math.log(value / self.low) / math.log(self.high / self.low) if self.is_logarithmic else value / self.high
        return TOP + (1 - part) * (HEIGHT - TOP - BOTTOM)


def stacks_of(chart):
    """Names of the stacks, in order; a bar outside of a stack is one of its own."""
    return list(dict.fromkeys(bars.stack or bars.label for bars in chart.bars))


def text_at(x, y, text, anchor="middle"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{html.escape(text)}</text>'


def frame_of(chart, axis, width):
    """Lines and labels of the axis, and the dashed levels."""
    parts = []
    for value in axis.ticks:
        y = axis.y(value)
        parts += [f'<line class="grid" x1="{LEFT}" x2="{width - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>', text_at(LEFT - 6, y + 4, f"{value:g}", "end")]
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(f'<text transform="translate(14 {middle:.1f}) rotate(-90)" text-anchor="middle">{html.escape(chart.axis)}</text>')
    for value, _, colour in chart.levels:
        y = axis.y(value)
        parts.append(f'<line class="level" x1="{LEFT}" x2="{width - RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="{colour}"/>')
    return parts


def bars_of_group(chart, axis, group, left, bar_width):
    """Rectangles of a group that begins at `left`; each says its value."""
    parts = []
    for place, stack in enumerate(stacks_of(chart)):
        below = 0.0
        for bars in chart.bars:
            value = bars.values[group]
            if (bars.stack or bars.label) != stack or value is None or not math.isfinite(value) or value <= 0:
                continue
            top, bottom = axis.y(below + value), axis.y(below) if below else HEIGHT - BOTTOM
            parts.append(f'<rect x="{left + place * bar_width:.1f}" width="{bar_width - 1:.1f}" y="{top:.2f}" height="{bottom - top:.2f}" '
                         f'fill="{bars.colour}"><title>{html.escape(f"{chart.groups[group]}, {bars.label}: {value:.4g}")}</title></rect>')
            if bars.stack:
                below += value
    return parts


def draw(chart):
    """The chart as an <svg>, wider with more bars."""
    num_stacks = len(stacks_of(chart))
    group_width = max(LEAST_GROUP, num_stacks * BAR + GAP, (LEAST_WIDTH - LEFT - RIGHT) / max(1, len(chart.groups)))
    width, axis = LEFT + RIGHT + group_width * len(chart.groups), Axis(chart)
    bar_width = min(WIDEST_BAR, (group_width - GAP) / max(1, num_stacks))
    parts = frame_of(chart, axis, width)
    for group, name in enumerate(chart.groups):
        middle = LEFT + (group + 0.5) * group_width
        parts += bars_of_group(chart, axis, group, middle - num_stacks * bar_width / 2, bar_width)
        parts.append(text_at(middle, HEIGHT - BOTTOM + 18, name))
    label = html.escape(f"{chart.title}: {chart.text}", quote=True)
    return f'<svg role="img" aria-label="{label}" width="{width:.0f}" height="{HEIGHT}" viewBox="0 0 {width:.0f} {HEIGHT}">{"".join(parts)}</svg>'
