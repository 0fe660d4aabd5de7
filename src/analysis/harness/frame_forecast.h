/// How long a frame takes on any number of ranks: computed from what the parts cost.
#pragma once

#include <array>
#include <string_view>

#include "analysis/harness/harness_costs.h"
#include "analysis/harness/harness_load.h"

namespace pbmpi::analysis {

/// Parts of a frame, in their order.
enum class FramePart { step, harness, agreement, gather, unpack, balance, verdict };
inline constexpr std::array<std::string_view, 7> frame_part_names = {
    "step", "harness", "agreement", "gather", "unpack", "balance", "verdict"};

struct FrameForecast {
  std::array<double, frame_part_names.size()> seconds{};

  double& operator[](FramePart part) { return seconds[static_cast<std::size_t>(part)]; }
  double operator[](FramePart part) const { return seconds[static_cast<std::size_t>(part)]; }
  double total_s() const;
  /// The part of the harness, that is all but step, that takes longest.
  FramePart wall() const;
};

/// step: the rank with the most work. Where costs vary, that of R ranks with n worlds each exceeds the mean
/// by sqrt(2 ln R / n) standard deviations (C. Kruskal and A. Weiss, "Allocating independent subtasks on
/// parallel processors", IEEE TSE 11, 1985), as far as worlds do not move. agreement and verdict: rounds of L
/// + 2 o, by recursive doubling and by a binomial tree. gather: until root has the last byte, see gather_s().
FrameForecast frame_forecast(const HarnessLoad& load, const HarnessCosts& costs,
                             const GatherShape& shape = {});

/// Seconds from the moment in which all ranks have packed their poses until root has received the last byte.
/// The messages of the tree are followed one rank after the other: a rank takes its children's streams in
/// order, each message for the longer of o and g, and each byte for G; it hands a piece on as soon as it is
/// full.
double gather_s(const HarnessLoad& load, const LinkCosts& link, const GatherShape& shape);

}  // namespace pbmpi::analysis
