"""Steps are taken without the interpreter's lock."""
import signal
import sys
import threading
import time
import unittest

import pbmpi

MOST_ROUNDS = 20_000  # of 3 steps: a test that fails takes some seconds


class Threads(unittest.TestCase):
    def test_another_thread_goes_on_while_worlds_are_stepped(self):
        """The main thread never gives the lock away by itself: the interval after which it would have to is longer than the test. So the
        count can only grow inside step()."""
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0)  # gives the lock back

        batch = pbmpi.Batch("CrashSk", 8)
        counting = threading.Thread(target=count)
        counting.start()
        try:
            sys.setswitchinterval(1e6)
            before = counted[0]
            still = counted[0]
            for _ in range(1000):
                still = counted[0]
            self.assertEqual(still, before, "nobody counts while this thread has the lock")
            for _ in range(MOST_ROUNDS):
                batch.step(3)
                if counted[0] > before + 3:
                    break
            grown = counted[0] - before
        finally:
            done.set()
            counting.join()
        self.assertGreater(grown, 3)

    def test_calls_of_several_threads_wait_for_each_other(self):
        shared, alone = pbmpi.Batch("CrashSk", 4, threads=2), pbmpi.Batch("CrashSk", 4)

        def work():
            for _ in range(10):
                shared.step(2)
                shared.position.sum()

        threads = [threading.Thread(target=work) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        alone.step(60)
        self.assertEqual(shared.steps.tolist(), [60] * 4)
        self.assertEqual(shared.hash(), alone.hash())

    def test_a_signal_ends_a_long_step_between_two_steps(self):
        batch = pbmpi.Batch("CrashSk", 2)

        def interrupt(number, frame):
            raise KeyboardInterrupt

        previous = signal.signal(signal.SIGUSR1, interrupt)
        self.addCleanup(signal.signal, signal.SIGUSR1, previous)
        sender = threading.Timer(0.2, signal.raise_signal, [signal.SIGUSR1])
        sender.start()
        with self.assertRaises(KeyboardInterrupt):
            batch.step(2**31 - 1)
        sender.join()
        done = int(batch.steps[0])
        self.assertGreater(done, 0)
        other = pbmpi.Batch("CrashSk", 2)
        other.step(done)
        self.assertEqual(batch.hash(), other.hash(), "it can go on")


if __name__ == "__main__":
    unittest.main()
