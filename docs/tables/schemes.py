"""Drawings of how things hang together, which rest on no table."""
from tables.canvas import Canvas


def box(canvas, place, words, colour="band"):
    """A rounded box at (x, y, width) with lines of words: the first in bold."""
    x, y, width = place
    canvas.rectangle(x, y, width, 20 + 15 * len(words), colour, 6)
    for number, line in enumerate(words):
        canvas.text(x + width / 2, y + 20 + 15 * number, line, "text" if not number else "faint", 12 if not number else 10.5, "middle", bold=not number)


def arrow(canvas, start, end, words=""):
    """A straight arrow, with words above its middle."""
    (x0, y0), (x1, y1) = start, end
    canvas.line([start, end], "faint", 1.5)
    if x0 == x1:
        down = 6 if y1 > y0 else -6
        canvas.line([(x1 - 4, y1 - down), end, (x1 + 4, y1 - down)], "faint", 1.5)
    else:
        right = 6 if x1 > x0 else -6
        canvas.line([(x1 - right, y1 - 4), end, (x1 - right, y1 + 4)], "faint", 1.5)
    canvas.text((x0 + x1) / 2, (y0 + y1) / 2 - 6, words, "faint", 10, "middle")


def runs():
    """What a run reads and writes, and who reads that."""
    canvas = Canvas(860, 250, "What a run reads and writes: a scene and a table of parameters; the run's file, checkpoints; pages, tables, Python")
    box(canvas, (20, 24, 170), ("scene", "TOML, MJCF or URDF"))
    box(canvas, (20, 100, 170), ("parameters", "a row a world: CSV, TOML"))
    box(canvas, (280, 62, 170), ("pbmpi", "over ranks, frame by frame"), "band")
    box(canvas, (275, 178, 180), ("checkpoint", "on USR1, by time, at the end"))
    box(canvas, (550, 62, 130), ("run.h5", "readable at any time"))
    box(canvas, (730, 20, 116), ("pbreport", "summary, page", "csv, ensemble, diff"))
    box(canvas, (730, 104, 116), ("Python", "pbmpi.read, h5py"))
    box(canvas, (730, 176, 116), ("ParaView", "run.xdmf"))
    arrow(canvas, (190, 50), (276, 80))
    arrow(canvas, (190, 126), (276, 98))
    arrow(canvas, (450, 88), (546, 88), "each frame")
    arrow(canvas, (340, 114), (340, 174))
    arrow(canvas, (390, 178), (390, 116))
    canvas.text(400, 150, "--resume, on any ranks", "faint", 10)
    arrow(canvas, (680, 78), (726, 52))
    arrow(canvas, (680, 92), (726, 126))
    arrow(canvas, (680, 106), (726, 196))
    return canvas.svg()


def frame():
    """The phases of a frame on each rank, in order."""
    canvas = Canvas(860, 190, "A frame: each rank advances its worlds, one collective agrees, root gathers poses, observers write")
    canvas.text(14, 22, "A frame of 1/30 s, as each rank goes through it", size=13, bold=True)
    for number, rank in enumerate(("root", "rank 1", "rank 2")):
        y = 40 + 34 * number
        canvas.text(62, y + 17, rank, size=11, anchor="end")
        canvas.rectangle(74, y, 70, 24, "none", 4)
        canvas.rectangle(148, y, (300, 260, 330)[number], 24, "sor", 4)
        canvas.rectangle(500, y, 60, 24, "degraded", 4)
        canvas.rectangle(564, y, 110 if not number else 50, 24, "bullet", 4)
        canvas.rectangle(678, y, 90, 24, "mujoco", 4)
    for x, words in ((109, "estimate"), (300, "advance: its worlds, step by step"), (530, "wait"), (619, "gather"), (723, "output")):
        canvas.text(x, 160, words, size=11, anchor="middle")
    for x, words in ((109, "with --feec"), (300, "no message, unless a world is cut"), (530, "one collective"), (619, "poses to root"), (723, "run.h5")):
        canvas.text(x, 176, words, "faint", 9.5, "middle")
    return canvas.svg()


def substeps():
    """The parts of a step of sor."""
    canvas = Canvas(860, 150, "A step of sor: contacts are found once, then substeps of forces, a sweep with bias, motion, a sweep without bias")
    canvas.text(14, 22, "A step of sor: contacts are found once, then come 14 substeps", size=13, bold=True)
    canvas.rectangle(14, 44, 120, 46, "bullet", 5)
    canvas.text(74, 71, "collide", "page", 12, "middle", bold=True)
    for number in range(3):
        x = 142 + 222 * number
        canvas.rectangle(x, 38, 216, 58, "band", 5)
        for place, (words, colour) in enumerate((("forces", "direct"), ("sweep", "sor"), ("motion", "mujoco"), ("relax", "quick"))):
            canvas.rectangle(x + 5 + 52 * place, 44, 49, 46, colour, 4)
            canvas.text(x + 29.5 + 52 * place, 71, words, "page", 10.5, "middle", bold=True)
        canvas.text(x + 108, 112, f"{('substep 1', 'substep 2', '... substep 14')[number]}", "faint", 10.5, "middle")
    canvas.text(826, 72, "next", "faint", 11)
    canvas.text(14, 138, "The forces at its end begin the next step (memory). --substeps changes how many; ODE's law has one, and no memory.", "faint", 10.5)
    return canvas.svg()
