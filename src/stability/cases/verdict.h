/// Whether a run of a hard case came out right.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "stability/cases/case_watch.h"

namespace pbmpi::stability {

/// From best to worst; not_applicable: the setting cannot run the case.
enum class Verdict { pass, degraded, broken, not_applicable };
inline constexpr std::array<std::string_view, 4> verdict_names = {"pass", "degraded", "broken", "n/a"};

/// The verdict, with the number that decided it: of those with the worst verdict the one that is farthest
/// beyond its limit, as a share of it.
struct Judgement {
  Verdict verdict = Verdict::pass;
  std::string decided_by;  ///< name of a metric, or "BODY.QUANTITY"
  double value = 0;        ///< in `unit`
  Limits limits;
  std::string unit;
};

/// How right a number is: a NaN is broken.
Verdict verdict_of(double value, const Limits& limits);

/// A run that lost a body to NaN is broken, whatever its bounds. The case has a bound or an expectation.
Judgement judge(const HardCase& hard_case, const CaseMeasurement& measured);

}  // namespace pbmpi::stability
