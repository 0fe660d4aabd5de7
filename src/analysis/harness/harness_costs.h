/// Costs of the parts of the harness, measured by "pbstudy calibrate".
#pragma once

namespace pbmpi::analysis {

/// Costs between two ranks, by LogGP: A. Alexandrov, M. Ionescu, K. Schauser and C. Scheiman, "LogGP:
/// incorporating long messages into the LogP model", SPAA 1995. A message of k bytes takes o + (k - 1) G + L
/// + o.
struct LinkCosts {
  double latency_s = 0;   ///< L: in transit
  double overhead_s = 0;  ///< o: processor time to send or to receive a message
  double gap_s = 0;       ///< g: least time between two messages that a rank receives
  double byte_s = 0;      ///< G: per byte of a long message
};

/// Costs in seconds, except memory.
struct HarnessCosts {
  LinkCosts link;
  double frame_s = 0;          ///< per frame of a rank, whatever it owns
  double world_frame_s = 0;    ///< plus once a frame for each of its worlds
  double world_step_s = 0;     ///< plus for each step of a world, without its engine
  double body_frame_s = 0;     ///< plus once a frame for each body: gather and observers
  double unpack_world_s = 0;   ///< root: a world of another rank, read from the message
  double unpack_body_s = 0;    ///< root: plus for each of its bodies
  double balance_world_s = 0;  ///< root: for each world, when it decides whether worlds move
  double balance_rank_s = 0;   ///< root: plus for each rank
  double table_world_s = 0;    ///< every rank, at the start: for each world in the table of all worlds
  double hash_world_s = 0;     ///< root, at the end: to add a world's hash to the run's
  double hash_body_s = 0;      ///< the owner, at the end: for each body
  double base_bytes = 0;       ///< memory of a rank that owns next to nothing
  double body_bytes = 0;       ///< plus for each body of its own
};

}  // namespace pbmpi::analysis
