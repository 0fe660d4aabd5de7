"""A small writer of SVG: the same bytes on every machine, and colours that follow a light or a dark page."""
import math
from xml.sax.saxutils import escape

# name: colour on a light page, colour on a dark one.
COLOURS = {"page": ("#ffffff", "#0d1117"), "text": ("#24292f", "#e6edf3"), "faint": ("#656d76", "#9198a1"), "grid": ("#d8dee4", "#30363d"),
           "band": ("#e8f1fb", "#132339"), "sor": ("#1f6fbf", "#5aa9f5"), "quick": ("#c2571f", "#f0883e"), "direct": ("#6e7781", "#9198a1"),
           "bullet": ("#2b8a4b", "#56c271"), "mujoco": ("#8e44ad", "#c98ce0"), "pass": ("#2f7fc4", "#3f8fd9"), "degraded": ("#f2c14e", "#d9a520"),
           "broken": ("#c4361c", "#e5533d"), "none": ("#d8dee4", "#30363d")}
FONT = "system-ui,-apple-system,'Segoe UI','DejaVu Sans',Helvetica,Arial,sans-serif"


def style():
    def rules(which):
        return "".join(f".{name}{{fill:{pair[which]}}}.l-{name}{{stroke:{pair[which]};fill:none}}" for name, pair in COLOURS.items())

    return f"<style>text{{font-family:{FONT}}}{rules(0)}@media(prefers-color-scheme:dark){{{rules(1)}}}</style>"


def short(number):
    """A coordinate."""
    return f"{number:.1f}".rstrip("0").rstrip(".")


class Canvas:
    """Shapes in pixels, y downwards; `colour` is a name of COLOURS."""

    def __init__(self, width, height, description):
        self.width, self.height, self.description, self.parts = width, height, description, []

    def rectangle(self, x, y, width, height, colour, round_px=0, hint=None):
        self.parts.append(f'<rect class="{colour}" x="{short(x)}" y="{short(y)}" width="{short(width)}" height="{short(height)}"'
                          + (f' rx="{short(round_px)}"' if round_px else "") + self.closed("rect", hint))

    def line(self, points, colour, width=1.0, dashed=False):
        path = " ".join(f"{short(x)},{short(y)}" for x, y in points)
        self.parts.append(f'<polyline class="l-{colour}" points="{path}" stroke-width="{short(width)}"' + (' stroke-dasharray="4 3"' if dashed else "") + "/>")

    def dot(self, x, y, radius, colour, hint=None):
        self.parts.append(f'<circle class="{colour}" cx="{short(x)}" cy="{short(y)}" r="{short(radius)}"{self.closed("circle", hint)}')

    def ring(self, x, y, radius, colour):
        self.parts.append(f'<circle class="l-{colour}" cx="{short(x)}" cy="{short(y)}" r="{short(radius)}" stroke-width="1.5"/>')

    def text(self, x, y, words, colour="text", size=11, anchor="start", bold=False, turned=False):
        turn = f' transform="rotate(-90 {short(x)} {short(y)})"' if turned else ""
        self.parts.append(f'<text class="{colour}" x="{short(x)}" y="{short(y)}" font-size="{short(size)}" text-anchor="{anchor}"'
                          + (' font-weight="600"' if bold else "") + f"{turn}>{escape(words)}</text>")

    @staticmethod
    def closed(tag, hint):
        return f"><title>{escape(hint)}</title></{tag}>" if hint else "/>"

    def svg(self):
        return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" height="{self.height}"'
                          f' role="img" aria-label="{escape(self.description)}">', style(),
                          f'<rect class="page" width="{self.width}" height="{self.height}" rx="6"/>', *self.parts, "</svg>", ""])


class LogAxes:
    """Two logarithmic axes on a part of a canvas: their ranges in units, their place in pixels."""

    def __init__(self, canvas, x_range, y_range, place):
        self.canvas, self.x_range, self.y_range = canvas, x_range, y_range
        self.left, self.top, self.right, self.bottom = place

    def x(self, value):
        return self.left + (self.right - self.left) * share(value, self.x_range)

    def y(self, value):
        return self.bottom - (self.bottom - self.top) * share(value, self.y_range)

    def frame(self, x_label, y_label):
        for value in decades(self.x_range):
            self.canvas.line([(self.x(value), self.top), (self.x(value), self.bottom)], "grid")
            self.canvas.text(self.x(value), self.bottom + 13, plain(value), "faint", 10, "middle")
        for value in decades(self.y_range):
            self.canvas.line([(self.left, self.y(value)), (self.right, self.y(value))], "grid")
            self.canvas.text(self.left - 4, self.y(value) + 3.5, plain(value), "faint", 10, "end")
        self.canvas.text((self.left + self.right) / 2, self.bottom + 27, x_label, "faint", 10.5, "middle")
        self.canvas.text(self.left - 32, (self.top + self.bottom) / 2, y_label, "faint", 10.5, "middle", turned=True)


def share(value, limits):
    low, high = map(math.log10, limits)
    return (math.log10(min(max(value, limits[0]), limits[1])) - low) / (high - low)


def decades(limits):
    """The powers of ten within."""
    return [10.0 ** power for power in range(math.ceil(math.log10(limits[0]) - 1e-9), math.floor(math.log10(limits[1]) + 1e-9) + 1)]


def plain(value):
    """Of a power of ten: 0.01, 1, 10, 1000."""
    return f"{value:g}" if value < 1e5 else f"{value:.0e}"
