'use strict';
// What a page of a replay carries: arrays of numbers in base64 (little-endian).

pb.bytes = (base64) => {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
};
pb.floats = (base64) => new Float32Array(pb.bytes(base64).buffer);
pb.integers = (base64) => new Int32Array(pb.bytes(base64).buffer);

pb.about = pb.json('about-data');

// The replay's arrays. Frame 0 is the initial pose.
//   timeS, step, number [F], the last counting frames from the start of the simulation; position [F][N][3] m; orientation [F][N][4] (w, x, y, z); bodyWorld [N]
//   geoms: kind, shape, world, body (-1 = static) [G]; size [G][3] m; local [G][7] position, orientation;
//   hull: index into hulls, or -1 [G], null without hulls
//   hulls: of each the triangles, in the geom's frame [T][3 corners][3] m
pb.decodeReplay = (raw) => {
  return {
    note: raw.note,
    numWorlds: raw.num_worlds,
    numBodies: raw.num_bodies,
    numFrames: raw.time_s.length,
    timeS: raw.time_s,
    step: raw.step,
    number: raw.number,
    bodyNames: raw.body_names,
    bodyWorld: pb.integers(raw.body_world),
    position: pb.floats(raw.position),
    orientation: pb.floats(raw.orientation),
    kindNames: raw.kind_names,
    shapeNames: raw.shape_names,
    geoms: {
      kind: pb.bytes(raw.geoms.kind),
      shape: pb.bytes(raw.geoms.shape),
      world: pb.integers(raw.geoms.world),
      body: pb.integers(raw.geoms.body),
      size: pb.floats(raw.geoms.size),
      local: pb.floats(raw.geoms.local),
      hull: raw.geoms.hull ? pb.integers(raw.geoms.hull) : null,
    },
    hulls: (raw.geoms.hulls || []).map(pb.floats),
  };
};

// Kinds of actors, in colours that people with any colour vision can tell apart: Okabe and Ito, "Color
// Universal Design" (2008); neutral greys for what does not act.
pb.kindColour = {
  ground: '#c3ccd5', ramp: '#e6da6e', wall: '#cc79a7', car: '#0072b2', tank: '#009e73', human: '#e69f00',
  centipede: '#56b4e9', projectile: '#d55e00', prop: '#8a939c',
};
