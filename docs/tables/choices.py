"""The table of docs/settings.md: what the settings that one may take cost and miss, from the tables that other studies left."""
import re

from tables import kept, programs

SCENES = ("CrashWa", "100CrSk")


def front():
    """{setting: {scene: (time over that of quick, error rms [mm])}}"""
    rows = kept.rows(f"{kept.LONG}front.md", "front")
    name = next(iter(rows[0]))
    return {row[name]: {scene: re.match(r"([\d.]+): ([^,]+),", row[scene]).groups() for scene in SCENES} for row in rows}


def verdicts_of_map(column):
    """Counts of the map of hard cases, which stand below its cases."""
    rows = kept.rows(f"{kept.LONG}hard_map.md", "hard_map")
    counts = {row["case"]: row[column] for row in rows if not row["row"]}
    return " / ".join(counts[verdict] for verdict in ("pass", "degraded", "broken"))


def verdicts_of_held(name):
    row = next(row for row in kept.rows("docs/accuracy.md", "held") if row["hard cases"] == name)
    return " / ".join(row[verdict] for verdict in ("pass", "degraded", "broken"))


def verdicts_at_equal_time(name):
    """Of a study that left the largest cases out."""
    row = next(row for row in kept.rows(f"{kept.LONG}at_equal_time.md", "at_equal_time") if row["setting"] == name)
    counts = [row[verdict] for verdict in ("pass", "degraded", "broken")]
    return f"{' / '.join(counts)}, of {sum(map(int, counts))}"


def approach(length):
    """[(time over the default's, error rms [mm])] of --approach `length` in each scene; None: of the default."""
    rows = {row["rms, 90th percentile, median [mm]"]: row for row in kept.rows("docs/accuracy.md", "fine")}
    if length is None:
        return [("1.0", rows["default"][scene].split(",")[0]) for scene in SCENES]
    return [(rows[f"time of --approach {length} over the default's"][scene], rows[f"--approach {length}"][scene].split(",")[0]) for scene in SCENES]


def single():
    """The same of --precision single, over the time of double precision."""
    rows = [[kept.plain(cell) for cell in kept.cells(line)] for line in kept.lines(f"{kept.LONG}speed.md", "speed")[2:]]
    double, in_single = (next(row for row in rows if row[0] == f"sor {precision}, 14 x 1") for precision in ("double", "single"))
    return [(programs.digits(float(in_single[at][1:]) / float(double[at][1:])), in_single[at + 1]) for at in (1, 4)]


def table():
    settings = front()
    once = settings["sor, 10 ms, 14 x 1"]  # one collision detection a step
    once_over_default = {scene: float(time) for scene, (time, _) in zip(SCENES, approach("0"))}

    def of_front(name):
        return [(programs.digits(once_over_default[scene] * float(settings[name][scene][0]) / float(once[scene][0])), settings[name][scene][1])
                for scene in SCENES]

    lines = (("the default", approach(None), verdicts_of_held("sor, 10 ms, 14 x 1")),
             ("`--precision single`", single(), verdicts_of_map("sor single, 14 x 1")),
             ("`--substeps 4`", of_front("sor, 10 ms, 4 x 1"), verdicts_at_equal_time("sor double, 4 x 1")),
             *((f"`--approach {length}`", approach(length), verdicts_of_held(f"sor, 10 ms, 14 x 1, --approach {length}")) for length in ("0", "2cm")),
             ("`--dt 0.0025 --substeps 4`", of_front("sor, 2.5 ms, 4 x 1"), verdicts_of_held("sor, 2.5 ms, 4 x 1, --approach 0")),
             ("`--stepper quick`", of_front("quick, 10 ms, 1 x 20"), verdicts_of_map("quick, 1 x 20")))
    columns = [f"{scene}: {what}" for scene in SCENES for what in ("time over the default's", "error rms [mm]")]
    head = ["setting", *columns, "hard cases: pass / degraded / broken"]
    return programs.table(head, [[name, *(number for pair in pairs for number in pair), verdicts] for name, pairs, verdicts in lines])
