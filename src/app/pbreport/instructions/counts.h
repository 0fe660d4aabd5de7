/// Instructions of a frame as jobs/figure3.py counts them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/pbreport/study/instruction_mix.h"

namespace pbmpi::app {

/// The key "filetype" in a file of counts.
inline constexpr const char* counts_filetype = "pbmpi-instructions";

/// Mean over the measured frames, inside the stepper.
struct InstructionCounts {
  double per_frame = 0;
  double collision_share = 0;
  InstructionMix mix{};
  int frames = 0;

  double solver() const { return per_frame * (1 - collision_share); }
};

struct CountedScene {
  std::string name;
  std::optional<InstructionCounts> quick, direct;
};

/// Is this a JSON document with this filetype?
bool has_counts(const std::string& path);

/// Throws core::InputError for another file, or if a number is missing.
std::vector<CountedScene> read_counts(const std::string& path);

}  // namespace pbmpi::app
