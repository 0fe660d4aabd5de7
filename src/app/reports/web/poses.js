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

  // Fills position and orientation: linear in place, along the shorter great arc in orientation (slerp: Shoemake,
  // "Animating rotation with quaternion curves", SIGGRAPH 1985).
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
    for (let i = 0; i < 4 * numBodies; i += 4) this.slerp(orientation, a + i, b + i, share, i);
  }

  slerp(q, a, b, share, to) {
    let cosine = 0;
    for (let k = 0; k < 4; ++k) cosine += q[a + k] * q[b + k];
    const sign = cosine < 0 ? -1 : 1;
    const angle = Math.acos(Math.min(1, sign * cosine));
    const sine = Math.sin(angle);
    // Below 1e-4 rad the arc and its chord are the same to single precision.
    const wa = angle < 1e-4 ? 1 - share : Math.sin((1 - share) * angle) / sine;
    const wb = sign * (angle < 1e-4 ? share : Math.sin(share * angle) / sine);
    for (let k = 0; k < 4; ++k) this.orientation[to + k] = wa * q[a + k] + wb * q[b + k];
  }
};
