"""Fails if a program has instructions of AVX outside the code that is compiled for it.

Usage: avx_code.py PROGRAM...

One build runs on every x86-64: only packs of lanes that are as wide as the instruction set may use it
(src/solver/pack/pack_avx2.cpp, pack_avx512.cpp). A template of the standard library that is instantiated between their
target pragmas would be shared with all other code, and stop the program on a machine without AVX.
"""

import re
import subprocess
import sys

FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
AVX = re.compile(r"\t(v[a-z0-9]+)\b|\t.*%[yz]mm")
NOT_AVX = re.compile(r"\tver[rw]\b")
LANES = re.compile(r"LaneTraits(?:<(\w+), (\d+)>|I([df])Li(\d+)E)")  # objdump leaves long names as they are mangled
TYPES = {"d": "double", "f": "float"}
WIDE = {("double", "4"), ("float", "8"), ("double", "8"), ("float", "16")}
MAKERS = re.compile(r"pbmpi::solver::make_(double|single)_avx(2|512)\(")


def may_use_avx(function):
    lanes = {(kind or TYPES[short], number or short_number) for kind, number, short, short_number in LANES.findall(function)}
    return (bool(lanes) and lanes <= WIDE) or MAKERS.match(function) is not None


def functions_with_avx(program):
    dump = subprocess.run(["objdump", "--disassemble", "--demangle", "--no-show-raw-insn", program], capture_output=True,
                          text=True, errors="replace", check=True)
    function, found = "", {}
    for line in dump.stdout.splitlines():
        head = FUNCTION.match(line)
        if head:
            function = head.group(1)
        elif AVX.search(line) and not NOT_AVX.search(line):
            found.setdefault(function, line.strip())
    return found


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    forbidden = 0
    for program in sys.argv[1:]:
        found = functions_with_avx(program)
        wrong = {name: line for name, line in found.items() if not may_use_avx(name)}
        for name, line in sorted(wrong.items()):
            print(f"{program}: {name}: {line}", file=sys.stderr)
        print(f"{program}: {len(found)} functions with AVX, {len(wrong)} of them outside its packs")
        forbidden += len(wrong)
    return 1 if forbidden else 0


if __name__ == "__main__":
    sys.exit(main())
