/// What the parts of the harness cost: measured by "pbstudy calibrate".
#pragma once

namespace pbmpi::analysis {

/// Between two ranks, by LogGP: A. Alexandrov, M. Ionescu, K. Schauser and C. Scheiman, "LogGP: incorporating
/// long messages into the LogP model", SPAA 1995. A message of k bytes takes o + (k - 1) G + L + o.
struct LinkCosts {
  double latency_s = 0;   ///< L: on the way
  double overhead_s = 0;  ///< o: of the processor, to send or to receive a message
  double gap_s = 0;       ///< g: between two messages that a rank receives, at least
  double byte_s = 0;      ///< G: a byte of a long message
};

/// Seconds each.
struct HarnessCosts {
  LinkCosts link;
  double frame_s = 0;          ///< a frame of a rank, whatever it owns
  double world_frame_s = 0;    ///< and for each of its worlds, once a frame
  double world_step_s = 0;     ///< and for each step of a world, beside its engine
  double body_frame_s = 0;     ///< and for each body, once a frame: gather and observers
  double unpack_world_s = 0;   ///< root: a world of another rank, out of the message
  double unpack_body_s = 0;    ///< root: and each of its bodies
  double balance_world_s = 0;  ///< root: a world, when it decides whether worlds move
  double balance_rank_s = 0;   ///< root: and a rank
  double table_world_s = 0;    ///< every rank, at the start: a world of the table of all worlds
  double hash_world_s = 0;     ///< root, at the end: a world's hash in that of the run
  double hash_body_s = 0;      ///< the owner, at the end: a body
  double base_bytes = 0;       ///< memory of a rank that owns next to nothing
  double body_bytes = 0;       ///< and for each body of its own
};

}  // namespace pbmpi::analysis
