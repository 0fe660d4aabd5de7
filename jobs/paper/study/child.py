"""Runs other programs to their end."""
import ctypes
import dataclasses
import json
import os
import re
import signal
import subprocess

PR_SET_PDEATHSIG = 1  # of prctl


class RunError(Exception):
    """A run that ended as none should, and what it wrote."""


@dataclasses.dataclass
class Run:
    """`exit_code`: as a shell gives it, 128 + the signal for a program that a signal ended; -1: the time limit did. `summary`: what it printed; None
    if that is not JSON."""
    exit_code: int
    errors: str
    summary: object

    @property
    def nonfinite_frame(self):
        """The frame of "... non-finite body in frame 3"; -1 if there is none."""
        found = re.search("non-finite bod(?:y|ies) in frame ([0-9]+)", self.errors)
        return int(found[1]) if found else -1

    @property
    def has_ended_well(self):
        """Did it take all its frames, or end at one with a number that is not finite?"""
        return self.exit_code == 0 or (self.exit_code == 1 and self.nonfinite_frame >= 0)

    def require_end(self, what):
        if self.exit_code != -1 and not self.has_ended_well:
            raise RunError(f"{what} ended with exit code {self.exit_code}:\n{self.errors}")


def end_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def environment(more):
    """This program's own, but for what mpirun has set for it, so that a program with MPI starts on its own."""
    return {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))} | more


def run(command, name, limit_s, **more):
    """Runs a command whose output goes to NAME.json and NAME.err; `more`: environment. Raises RunError if it cannot be started."""
    out, err = name.with_suffix(".json"), name.with_suffix(".err")
    with open(out, "wb") as output, open(err, "wb") as errors:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=errors, env=environment(more),
                                       preexec_fn=end_with_parent)  # pylint: disable=subprocess-popen-preexec-fn
        except OSError as error:
            raise RunError(f"{command[0]} cannot be started: {error.strerror}") from None
        try:
            code = process.wait(limit_s)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            code = None
    return Run(-1 if code is None else code if code >= 0 else 128 - code, err.read_text(errors="replace"), json_in(out))


def json_in(path):
    """The document in a file, or None."""
    try:
        return json.loads(path.read_bytes())
    except (OSError, ValueError):
        return None
