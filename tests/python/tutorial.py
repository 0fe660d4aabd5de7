"""The blocks of docs/python.md and docs/start.md, and how they are run.

Python blocks share one interpreter; one that begins with "# NAME.py" is a file instead. Blocks of commands that start programs of pbmpi
are run by the shell, others (to install, to build) are not. A text block is what all blocks since the last one printed.
"""
import contextlib
import io
import re
import subprocess

BLOCK = re.compile(r"^```(python|sh|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROGRAM = re.compile(r"(mpirun|pbmpi|pbstudy|pbreport|cat|printf|jobs/scaling\.sh) ")
FILE = re.compile(r"# (\w+\.py)\n")


def blocks_of(page):
    return [(kind, code, page[:at].count("\n") + 2) for kind, code, at in
            ((match[1], match[2], match.start()) for match in BLOCK.finditer(page))]


def run(page, path):
    """Runs the blocks in the current folder. Yields (line of a text block, what it says, what was printed)."""
    names, printed = {"__name__": "__main__"}, ""
    for kind, code, line in blocks_of(page):
        if kind == "text":
            yield line, code, printed
            printed = ""
        elif kind == "sh" and PROGRAM.match(code):
            printed += subprocess.run(["bash", "-ec", code], stdout=subprocess.PIPE, text=True, check=True).stdout
        elif kind == "python" and FILE.match(code):
            with open(FILE.match(code)[1], "w", encoding="utf-8") as file:
                file.write(code)
        elif kind == "python":
            output = io.StringIO()
            with contextlib.redirect_stdout(output):
                exec(compile("\n" * (line - 1) + code, path, "exec"), names)  # noqa: S102
            printed += output.getvalue()


def filled(page, outputs):
    """The page with what was printed in its text blocks."""
    outputs = iter(outputs)
    return BLOCK.sub(lambda match: f"```text\n{next(outputs)}```" if match[1] == "text" else match[0], page)
