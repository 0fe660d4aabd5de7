"""Which frames of a joined run come from which file. Frames are counted from the start of the first run."""
from typing import NamedTuple

import numpy as np

from reports.files import BadInput, require


class Stretch(NamedTuple):
    """Consecutive frames that come from one file; `part`: its index."""
    part: int
    first: int
    count: int

    @property
    def end(self):
        return self.first + self.count


class Plan:
    """Of `parts` (path, first_frame, num_frames), sorted by first frame, and by their ends where those are equal. A frame that several parts have
    comes from the last of them. `stretches`: all frames, in their order.
    Raises BadInput for frames that no part has, or for a part whose recording intervals do not continue those of the first."""

    def __init__(self, parts, record_every):
        self.parts, self.record_every, self.first = parts, record_every, parts[0].first_frame
        for part in parts:
            require(part.num_frames > 0, f"{part.path}: it has no frame; leave it out")
        self._owner = np.full(max(map(end_of, parts)) - self.first, -1)
        for index, part in enumerate(parts):
            self._owner[part.first_frame - self.first:end_of(part) - self.first] = index
        self._require_all_frames()
        begins = np.flatnonzero(np.diff(self._owner, prepend=-1)).tolist()
        self.stretches = [Stretch(int(self._owner[begin]), self.first + begin, end - begin)
                          for begin, end in zip(begins, [*begins[1:], len(self._owner)])]
        for part in (parts[stretch.part] for stretch in self.stretches):
            require((part.first_frame - self.first) % record_every == 0,
                    f"{part.path}: one frame of {record_every} is recorded, counted from its first, {part.first_frame}, which is no such frame of "
                    f"{parts[0].path}; only runs that were saved after a multiple of as many frames can be joined")

    def _require_all_frames(self):
        missing = np.flatnonzero(self._owner < 0)
        if len(missing) == 0:
            return
        first = self.first + int(missing[0])
        [*_, before] = [part for part in self.parts if end_of(part) == first]
        after = min((part for part in self.parts if part.first_frame > first), key=lambda part: part.first_frame)
        last = after.first_frame - 1
        frames = f"frame {first} is" if first == last else f"frames {first} to {last} are"
        raise BadInput(f"{frames} missing: {before.path} ends before, {after.path} begins behind; name the file of the run between them, too")

    @property
    def num_frames(self):
        return len(self._owner)

    def part_of(self, frame):
        """The part from which a frame comes; that of the last stretch for a frame after the end."""
        return int(self._owner[np.clip(frame - self.first, 0, len(self._owner) - 1)])

    def overlaps_of(self, part):
        """The frames that this part has, but that come from another."""
        one = self.parts[part]
        cut = [(stretch.part, max(stretch.first, one.first_frame), min(stretch.end, end_of(one))) for stretch in self.stretches]
        return [Stretch(other, first, end - first) for other, first, end in cut if other != part and first < end]

    def rows(self, frames, begin, recorded):
        """The rows of a stretch, as a slice, of a table with a row a frame, or a recorded frame, in a file that begins with frame `begin`."""
        every = self.record_every if recorded else 1
        return slice((frames.first - begin) // every, (frames.end - begin) // every)


def end_of(part):
    return part.first_frame + part.num_frames
