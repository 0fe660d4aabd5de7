"""Turns callgrind's dumps, one a frame, into instructions a frame and their mix.

Usage: figure3.py FOLDER TABLE.json, with FOLDER/SCENE-STEPPER.callgrind.FRAME made by figure3.sh; for `paper/paper.py figure3`.

An instruction counts as what it computes; its access to memory counts besides as a load or a store, as in a processor
that splits them into micro-operations. A plain move is only its load or store; between registers it is an integer or a
floating-point operation.
"""
import collections
import json
import pathlib
import re
import subprocess
import sys

CLASSES = ("floating point", "integer", "branch", "store", "load")
WARMUP = 3
SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk", "Battle", "Fight", "Battle2")
COLLISION = ("pbmpi::ode::BroadPhase::find_pairs", "pbmpi::ode::Contacts::make")

NO_DESTINATION = ("cmp", "test", "bt", "comis", "ucomis", "comisd", "ucomisd")


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
    """Address -> (mnemonic, operands), of all instructions of one object file."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-w", path], capture_output=True, text=True, check=True).stdout
    found = {}
    for match in re.finditer(r"^ *([0-9a-f]+):\t(?:(?:rep[a-z]*|lock|bnd|notrack|data16|cs) )*(\S+) *([^#<\n]*)", text, re.M):
        found[int(match[1], 16)] = match[2], match[3].strip()
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
        instruction = code[obj].get(address)
        if instruction is None:
            unknown += count
        else:
            for name in classify(*instruction):
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


def main():
    folder, json_path = map(pathlib.Path, sys.argv[1:3])
    table = collect(folder)
    if not any("quick" in steppers for steppers in table.values()):
        raise SystemExit(f"{folder}: no frame was counted; see its logs")
    json_path.write_text(json.dumps({"filetype": "pbmpi-instructions", "scenes": table}, indent=2), encoding="utf-8")


if __name__ == "__main__":
    main()
