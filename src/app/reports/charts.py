"""Configurations of Chart.js for the charts of reports."""
# Colours that people with any colour vision can tell apart: Okabe and Ito, "Color Universal Design" (2008), and greys.
BLUE, ORANGE, GREEN, PINK, RED = "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00"
SKY, YELLOW, BLACK, GREY, PALE = "#56b4e9", "#f0e442", "#000000", "#999999", "#c9c9c9"
COLOURS = (BLUE, ORANGE, GREEN, PINK, RED, SKY, YELLOW, BLACK, GREY)
NOISE = "rgba(120, 130, 142, .30)"  # of a band of noise
INK = "#7a8490"  # of bounds and floors
ENGINES = {"quick": BLUE, "direct": PINK, "sor": ORANGE, "bullet": RED, "mujoco": SKY}  # in all diagrams


def axis(text, scale=None, **others):
    """An axis with its title; `scale`: linear, logarithmic."""
    return ({"type": scale} if scale else {}) | {"title": {"display": True, "text": text}} | others


def chart(kind, datasets, scales, labels=None, **marks):
    """`kind`: bar, line, scatter. `marks`: bands and key, which pbmpi draws itself."""
    data = {"datasets": datasets} | ({"labels": labels} if labels is not None else {})
    options = {"scales": scales} | ({"plugins": {"pbmpi": marks}} if marks else {})
    return {"type": kind, "data": data, "options": options}


def point(x, y, label):
    return {"x": x, "y": y, "label": label}


def bars(label, points, colour, **others):
    """A set of bars: points whose x are names."""
    return {"label": label, "data": points, "backgroundColor": colour} | others


def line(label, points, colour, **others):
    return {"label": label, "data": points, "borderColor": colour, "backgroundColor": colour} | others


def dashed(one):
    return one | {"borderDash": [4, 4], "pointRadius": 0, "borderWidth": 1}


def band(low, high, label, colour=NOISE, **others):
    return {"from": low, "to": high, "label": label, "colour": colour} | others
