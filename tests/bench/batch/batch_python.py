"""How long Python takes for frames of many worlds, beside a loop in C++ over the same batch.

Usage: batch_python.py [WORLDS [ROUNDS [THREADS]]] (4096, 15, 1), after jobs/build.sh. All step the same frames of CrashSk in each round, one
after the other, and look at the poses after each frame. Prints ratios of processor time: of the shortest rounds, which what else
runs on the machine lengthens least, and the median and quartiles of the rounds' ratios; a second loop in C++ shows what ratio the noise alone has.
"""
import functools
import pathlib
import statistics
import subprocess
import sys
import time

BUILD = pathlib.Path(__file__).resolve().parents[3] / "build" / "release"
sys.path.insert(0, str(BUILD / "python"))

import pbmpi  # noqa: E402

FRAMES = 2  # of a round


class Loop:
    """The loop in C++."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([BUILD / "tests" / "bench" / "batch" / "batch_loop", *map(str, arguments)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def step(self, frames):
        print(frames, file=self.process.stdin, flush=True)
        seconds, digits, _ = self.process.stdout.readline().split()
        return float(seconds), digits

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def step(batch, first_frame, frames):
    """Processor time of the frames [s], and the hash behind them."""
    batch.load(first_frame)
    height, steps = 0.0, batch.steps_per_frame
    start = time.process_time()
    for _ in range(frames):
        batch.step(steps)
        height += batch.position[0, 0, 2]
    return time.process_time() - start, batch.hash()


def report(name, seconds, base):
    low, middle, high = statistics.quantiles((one / other for one, other in zip(seconds, base)), n=4)
    print(f"{name:<15} shortest {min(seconds) / min(base):.4f}, median {middle:.4f} (quartiles {low:.4f} to {high:.4f})")


def main():
    worlds, rounds, threads = (int(text) for text in (sys.argv[1:] + ["4096", "15", "1"][len(sys.argv) - 1:]))
    for precision in ("double", "single"):
        loops = [Loop("CrashSk", worlds, precision, threads) for _ in range(2)]
        batch = pbmpi.Batch("CrashSk", worlds, precision=precision, threads=threads)
        batch.step(batch.steps_per_frame)
        saved = batch.save()
        runs = {"C++": loops[0].step, "Python": functools.partial(step, batch, saved), "C++ again": loops[1].step}
        seconds, digits = {name: [] for name in runs}, set()
        for number in range(rounds):
            for name in list(runs)[::1 if number % 2 else -1]:
                taken, end = runs[name](FRAMES)
                seconds[name].append(taken)
                digits.add(end)
        assert len(digits) == 1, "all have the same bits"
        print(f"CrashSk x {worlds}, {precision}, {threads} threads, {rounds} rounds of {FRAMES} frames, {min(seconds['C++']) / FRAMES:.4f} s a frame "
              f"in C++, hash {digits.pop()}")
        for name in ("Python", "C++ again"):
            report(f"{name} / C++", seconds[name], seconds["C++"])
        for loop in loops:
            loop.close()


if __name__ == "__main__":
    main()
