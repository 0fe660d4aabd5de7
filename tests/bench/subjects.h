/// The worlds that are measured.
#pragma once

#include <memory>
#include <string>

#include "bare_ode.h"

namespace pbmpi::bench {

struct Subject {
  std::string name;
  Models models;  ///< [num_worlds]
  double dt_s = 0.01;
  int iterations = 20;
  int steps_per_frame = 3;
  int warmup = 3;

  int num_bodies() const;
};

/// "crash" or "pile": the small models of tests/support, `num_worlds` times, or 100 times if it is 0.
/// Anything else is a scene of pbmpi or a path to one, with its own number of replicas unless `num_worlds` >
/// 0. Throws core::InputError.
Subject load_subject(const std::string& name, int num_worlds);

}  // namespace pbmpi::bench
