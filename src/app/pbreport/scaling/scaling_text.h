/// Curves of scaling in words.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/scaling/scaling_curves.h"

namespace pbmpi::app {

std::string name_of(ScalingKind kind);
/// "100CrSk, 100 worlds, sor double: strong scaling, worlds over ranks".
std::string title_of(const ScalingCurve& curve);
/// The base of the curve, and the bound on its speed-up.
std::string base_text(const ScalingCurve& curve);
/// "3 of 5 repeats; 2 different hashes"; empty if nothing speaks against the point.
std::string doubts_text(const ScalingPoint& point);
double ideal_speed_up(const ScalingCurve& curve, const ScalingPoint& point);
/// The ideal speed-up or, for a cut world, the bound from its largest island if that is less.
double bound_of(const ScalingCurve& curve, const ScalingPoint& point);
/// Seconds of a phase in a frame: mean over the ranks, median over the runs.
double phase_s(const ScalingPoint& point, const std::string& phase);
/// "1.93 (1.90 to 1.95)".
std::string estimated_text(const Estimated& value);

/// Header and rows of the table of a curve's points.
std::vector<std::vector<std::string>> point_cells(const ScalingCurve& curve);

std::string scaling_text(const std::vector<ScalingCurve>& curves, const std::vector<std::string>& left_out);
std::string scaling_markdown(const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
