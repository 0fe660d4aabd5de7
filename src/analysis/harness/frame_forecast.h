/// Forecasts the time of a frame on any number of ranks from the costs of its parts.
#pragma once

#include <array>
#include <string_view>

#include "analysis/harness/harness_costs.h"
#include "analysis/harness/harness_load.h"

namespace pbmpi::analysis {

/// Parts of a frame, in order.
enum class FramePart { step, harness, agreement, gather, unpack, balance, verdict };
inline constexpr std::array<std::string_view, 7> frame_part_names = {
    "step", "harness", "agreement", "gather", "unpack", "balance", "verdict"};

struct FrameForecast {
  std::array<double, frame_part_names.size()> seconds{};

  double& operator[](FramePart part) { return seconds[static_cast<std::size_t>(part)]; }
  double operator[](FramePart part) const { return seconds[static_cast<std::size_t>(part)]; }
  double total_s() const;
  /// The most expensive part of the harness, that is, of all parts except step.
  FramePart wall() const;
};

/// step: the rank with the most work. Where costs vary, the largest work of R ranks with n worlds each
/// exceeds the mean by sqrt(2 ln R / n) standard deviations (C. Kruskal and A. Weiss, "Allocating independent
/// subtasks on parallel processors", IEEE TSE 11, 1985), as long as worlds do not move. agreement and
/// verdict: rounds of L + 2 o, by recursive doubling and by a binomial tree. gather: until root has the last
/// byte, see gather_s().
FrameForecast frame_forecast(const HarnessLoad& load, const HarnessCosts& costs,
                             const GatherShape& shape = {});

/// Seconds from the moment when all ranks have packed their poses until root has received the last byte. The
/// messages of the tree are followed one rank after the other: a rank takes its children's streams in order,
/// each message for the longer of o and g, and each byte for G; it forwards a piece as soon as it is full.
double gather_s(const HarnessLoad& load, const LinkCosts& link, const GatherShape& shape);

}  // namespace pbmpi::analysis
