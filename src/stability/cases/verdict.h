/// Decides whether a run of a hard case came out right.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "stability/cases/case_watch.h"

namespace pbmpi::stability {

/// From best to worst; not_applicable: the setting cannot run the case.
enum class Verdict { pass, degraded, broken, not_applicable };
inline constexpr std::array<std::string_view, 4> verdict_names = {"pass", "degraded", "broken", "n/a"};

/// The verdict, and the number that decided it: among the numbers with the worst verdict, the one that
/// exceeds its limit by the largest share.
struct Judgement {
  Verdict verdict = Verdict::pass;
  std::string decided_by;  ///< name of a metric, or "BODY.QUANTITY"
  double value = 0;        ///< in `unit`
  Limits limits;
  std::string unit;
};

/// The verdict on one number; NaN is broken.
Verdict verdict_of(double value, const Limits& limits);

/// A run in which a body became NaN is broken, whatever its bounds. The case needs a bound or an expectation.
Judgement judge(const HardCase& hard_case, const CaseMeasurement& measured);

}  // namespace pbmpi::stability
