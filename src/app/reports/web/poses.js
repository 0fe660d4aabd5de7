'use strict';
// Poses between recorded frames.

pb.Poses = class {
  constructor(replay) {
    this.replay = replay;
    this.position = new Float32Array(3 * replay.numBodies);
    this.orientation = new Float32Array(4 * replay.numBodies);  // w, x, y, z
  }

  // The fractional frame at a simulated time [s].
  frameAt(timeS) {
    const times = this.replay.timeS;
    let frame = 0;
    while (frame + 2 < times.length && times[frame + 1] <= timeS) ++frame;
    if (times.length < 2) return 0;
    const share = (timeS - times[frame]) / (times[frame + 1] - times[frame]);
    return frame + Math.min(1, Math.max(0, share));
  }

  timeAt(frame) {
    const times = this.replay.timeS;
    const low = Math.min(Math.floor(frame), times.length - 1);
    const high = Math.min(low + 1, times.length - 1);
    return times[low] + (frame - low) * (times[high] - times[low]);
  }

  // Fills position and orientation: linear in place, along the shorter great arc in orientation, in which
  // slerpFlat takes four numbers in any order.
  interpolate(frame) {
    const {numBodies, numFrames, position, orientation} = this.replay;
    const low = Math.min(Math.floor(frame), numFrames - 1);
    const high = Math.min(low + 1, numFrames - 1);
    const share = frame - low;
    let a = 3 * numBodies * low, b = 3 * numBodies * high;
    for (let i = 0; i < 3 * numBodies; ++i) {
      this.position[i] = position[a + i] + share * (position[b + i] - position[a + i]);
    }
    a = 4 * numBodies * low, b = 4 * numBodies * high;
    for (let i = 0; i < 4 * numBodies; i += 4) THREE.Quaternion.slerpFlat(this.orientation, i, orientation, a + i, orientation, b + i, share);
  }
};
