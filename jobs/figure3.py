"""Turns callgrind's dumps, one a frame, into instructions a frame and their mix, and writes a page.

Usage: figure3.py FOLDER PAGE.html TABLE.json, with FOLDER/SCENE-STEPPER.callgrind.FRAME made by figure3.sh.

An instruction counts as what it computes; its access to memory counts besides as a load or a store, as in a processor
that splits them into micro-operations. A plain move is only its load or store; between registers it is an integer or a
floating-point operation.
"""
import collections
import html
import json
import pathlib
import re
import subprocess
import sys

CLASSES = ("floating point", "integer", "branch", "store", "load")
PAPER = {"floating point": 0.34, "integer": 0.25, "branch": 0.06, "store": 0.05, "load": 0.30}
PAPER_COLLISION = "7 % (2 to 20 %)"
WARMUP = 3
SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk", "Battle", "Fight", "Battle2")
COLLISION = ("pbmpi::ode::BroadPhase::find_pairs", "pbmpi::ode::Contacts::make")
# Of the 8 frames with direct on a busy 2-core machine.
DIRECT_TIME = {"CrashWa": "70 s", "Environ": "about 10 minutes a frame", "100CrSk": "3 s", "Battle": "2 s",
               "Battle2": "9 minutes"}

NO_DESTINATION = ("cmp", "test", "bt", "comis", "ucomis", "comisd", "ucomisd")


def left_out(scene):
    return (f"the big matrix takes {DIRECT_TIME.get(scene, 'very long')} natively, and about fifty times that under callgrind: too "
            "long for this job's ten minutes")


def classify(mnemonic, operands):
    """The classes that one execution of an instruction adds to, in AT&T syntax (the last operand is the destination)."""
    if re.match(r"(j|call|ret|loop|bnd)", mnemonic):
        return ["branch"] + (["load"] if "(" in operands and operands.startswith("*") else [])
    if mnemonic.startswith(("nop", "lea", "endbr", "cs", "data16", "prefetch", "ud2", "pause", "xchg")):
        return ["integer"]
    if mnemonic.startswith("push"):
        return ["store"]
    if mnemonic.startswith(("pop", "leave")):
        return ["load"]
    is_float = bool(re.search(r"%[xyz]mm|%st", operands)) or (mnemonic.startswith("f"))
    parts = re.split(r",(?![^(]*\))", operands) if operands else [""]
    from_memory = any("(" in part or re.match(r"(%[defgs]s:)?-?0x[0-9a-f]+$", part) for part in parts[:-1])
    to_memory = "(" in parts[-1]
    if len(parts) == 1 and mnemonic.startswith(("fld", "fild")):
        from_memory, to_memory = to_memory, False
    is_move = bool(re.match(r"v?mov|fld|fild|fst|fist", mnemonic))
    if is_move and (from_memory or to_memory):
        return ["store"] if to_memory else ["load"]
    result = ["floating point" if is_float else "integer"]
    reads_only = mnemonic.startswith(NO_DESTINATION)
    if from_memory or (to_memory and not is_move):
        result.append("load")
    if to_memory and not reads_only:
        result.append("store")
    return result


def disassemble(path):
    """Address -> classes, of all instructions of one object file."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-w", path], capture_output=True, text=True, check=True).stdout
    found = {}
    for match in re.finditer(r"^ *([0-9a-f]+):\t(?:(?:rep[a-z]*|lock|bnd|notrack|data16|cs) )*(\S+) *([^#<\n]*)", text, re.M):
        found[int(match[1], 16)] = classify(match[2], match[3].strip())
    return found


def read_dump(path):
    """Instructions by (object, address), and those within collision detection, of one frame."""
    self_cost, collision = collections.Counter(), 0
    obj = callee = None
    skip = False
    with open(path, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line.startswith("ob="):
                obj = line[3:].strip()
            elif line.startswith("cfn="):
                callee = line[4:].strip()
            elif line.startswith("calls="):
                skip = True
            elif line.startswith("0x"):
                address, cost = line.split()[:2]
                if not skip:
                    self_cost[obj, int(address, 16)] += int(cost)
                elif callee.startswith(COLLISION):
                    collision += int(cost)
                skip = False
    return self_cost, collision


def summarize(dumps, code):
    """One scene and stepper: mean over the measured frames."""
    executed, collision = collections.Counter(), 0
    for dump in dumps:
        cost, inside = read_dump(dump)
        executed.update(cost)
        collision += inside
    total = sum(executed.values())
    mix, unknown = collections.Counter(), 0
    for (obj, address), count in executed.items():
        if obj not in code:
            code[obj] = disassemble(obj) if pathlib.Path(obj).is_file() else {}
        classes = code[obj].get(address)
        if classes is None:
            unknown += count
        else:
            for name in classes:
                mix[name] += count
    operations = sum(mix.values())
    if unknown > 0.02 * total:
        raise SystemExit(f"{dumps[0]}: {unknown / total:.0%} of the instructions are in no object file that objdump reads")
    return {"instructions_per_frame": total / len(dumps), "collision_share": collision / total,
            "mix": {name: mix[name] / operations for name in CLASSES}, "frames": len(dumps)}


def collect(folder):
    """{scene: {stepper: numbers}} of all scenes that were counted."""
    code, table = {}, {}
    for scene in SCENES:
        for stepper in ("quick", "direct"):
            dumps = sorted(folder.glob(f"{scene}-{stepper}.callgrind.*"), key=lambda path: int(path.suffix[1:]))
            if dumps[WARMUP:]:
                table.setdefault(scene, {})[stepper] = summarize(dumps[WARMUP:], code)
    return table


def percent(share):
    return f"{100 * share:.0f} %"


def bar(count, most):
    return (f'<td class="n">{count / 1e6:,.2f}</td><td class="bar"><i style="width:{100 * count / most:.2f}%"></i></td>')


def rows_of(table):
    most = max(numbers["instructions_per_frame"] for steppers in table.values() for numbers in steppers.values())
    for scene, steppers in table.items():
        for stepper in ("quick", "direct"):
            if stepper not in steppers:
                reason = left_out(scene) if stepper == "direct" else "not counted in time"
                yield f"<tr><td>{scene}</td><td>{stepper}</td><td colspan=8 class=note>left out: {html.escape(reason)}</td></tr>"
                continue
            numbers = steppers[stepper]
            cells = "".join(f"<td class=n>{percent(numbers['mix'][name])}</td>" for name in CLASSES)
            yield (f"<tr><td>{scene}</td><td>{stepper}</td>{bar(numbers['instructions_per_frame'], most)}{cells}"
                   f"<td class=n>{percent(numbers['collision_share'])}</td></tr>")


PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Instructions · pbmpi</title><link rel="icon" href="data:,">
<style>
body {{ font: 15px/1.45 system-ui, "DejaVu Sans", sans-serif; margin: 24px auto; max-width: 1100px; padding: 0 16px; color: #1d2733; }}
table {{ border-collapse: collapse; width: 100%; font-size: 14px; }} th, td {{ text-align: left; padding: 3px 10px 3px 0; border-top: 1px solid #dde3ea; }}
.n {{ text-align: right; font-variant-numeric: tabular-nums; }} .bar {{ width: 30%; }} .bar i {{ display: block; height: 12px; background: #0072b2; min-width: 1px; }}
.note {{ color: #5b6775; }} .paper td {{ font-weight: 600; }}
</style></head><body>
<h1>Instructions of a frame</h1>
<p>The paper's Figure 3 and the mix of its section 3.3. Millions of instructions a frame, mean of the measured frames, inside the
stepper, counted by callgrind. An instruction counts as what it computes, its access to memory besides as a load or a store.
The paper prints Figure 3 without numbers; its text says that quick takes far fewer instructions than direct. It counts
single-precision code of 2006, this is double precision.</p>
<table><tr><th>scene</th><th>stepper</th><th>millions</th><th></th>{heads}<th>collision</th></tr>
{rows}
<tr class="paper"><td>mean of quick</td><td></td><td></td><td></td>{mean}</tr>
<tr class="paper"><td>paper</td><td></td><td></td><td></td>{paper}<td class="n">{collision}</td></tr>
</table></body></html>
"""


def page(table):
    quick = [steppers["quick"] for steppers in table.values() if "quick" in steppers]
    mean = "".join(f"<td class=n>{percent(sum(q['mix'][name] for q in quick) / len(quick))}</td>" for name in CLASSES)
    mean += f"<td class=n>{percent(sum(q['collision_share'] for q in quick) / len(quick))}</td>"
    return PAGE.format(heads="".join(f"<th>{name}</th>" for name in CLASSES), rows="\n".join(rows_of(table)), mean=mean,
                       paper="".join(f"<td class=n>{percent(PAPER[name])}</td>" for name in CLASSES),
                       collision=PAPER_COLLISION)


def main():
    folder, page_path, json_path = map(pathlib.Path, sys.argv[1:4])
    table = collect(folder)
    if not any("quick" in steppers for steppers in table.values()):
        raise SystemExit(f"{folder}: no frame was counted; see its logs")
    json_path.write_text(json.dumps({"scenes": table, "paper": {"mix": PAPER, "collision_share": PAPER_COLLISION}}, indent=2),
                         encoding="utf-8")
    page_path.write_text(page(table), encoding="utf-8")
    for scene, steppers in table.items():
        for stepper, numbers in steppers.items():
            mix = ", ".join(f"{name} {percent(numbers['mix'][name])}" for name in CLASSES)
            print(f"{scene:8} {stepper:6} {numbers['instructions_per_frame'] / 1e6:10.2f} M a frame; {mix}; "
                  f"collision {percent(numbers['collision_share'])}")


if __name__ == "__main__":
    main()
