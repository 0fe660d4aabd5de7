"""Work that is divided among the cores."""
import itertools
import os

from reports import files


def in_order(makers):
    """Yields the text that each maker() gives, in their order, made by as many processes as there are cores. A maker prints nothing and reads no
    file. `makers` are asked for few at a time."""
    num_processes = len(os.sched_getaffinity(0))
    makers = iter(makers)
    while batch := list(itertools.islice(makers, num_processes)):
        if len(batch) == 1:
            yield batch[0]()
            continue
        children = [start(maker) for maker in batch]
        for maker, (child, pipe) in zip(batch, children):
            with open(pipe, "rb") as stream:
                data = stream.read()
            _, status = os.waitpid(child, 0)
            yield data.decode("utf-8") if status == 0 else maker()  # which raises the child's error here


def start(maker):
    """(process, pipe) of a copy of this process that writes maker()'s text into the pipe."""
    reading, writing = os.pipe()
    child = os.fork()
    if child:
        os.close(writing)
        return child, reading
    files.unfinished.clear()  # the parent's
    try:
        os.close(reading)
        with open(writing, "wb") as stream:
            stream.write(maker().encode("utf-8", "replace"))
        os._exit(0)
    finally:
        os._exit(1)
