/// Forecasts from a calibration for numbers of ranks and worlds, with a flat gather and with a tree of ranks.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/harness/frame_forecast.h"
#include "analysis/harness/frame_traffic.h"
#include "analysis/harness/memory_forecast.h"
#include "app/pbreport/calibrate/calibration.h"

namespace pbmpi::app {

/// The question that a forecast answers.
struct ForecastQuestion {
  std::vector<std::int64_t> ranks = {2, 64, 1024, 16384, 131072};
  std::vector<std::int64_t> worlds = {100, 10000, 1000000, 100000000};
  std::int64_t bodies = 37;  ///< per world
  double step_s = 0;         ///< per world, in its engine; 0: the harness alone
  double budget_s = 0;       ///< per frame
};

/// How data reach root: by messages straight to it, with results on every rank, or by the tree.
enum class Way { flat, tree };
inline constexpr std::array<std::string_view, 2> way_names = {"flat", "tree"};

struct Forecast {
  analysis::HarnessLoad load;
  Way way = Way::tree;
  analysis::FrameTraffic traffic;
  analysis::FrameForecast frame;
  analysis::MemoryForecast memory;
  bool within_budget = true;
};

/// Both ways for each number of worlds and ranks with no fewer worlds than ranks.
std::vector<Forecast> forecasts_of(const ForecastQuestion& question, const analysis::HarnessCosts& costs);

/// The power of two of ranks at which a part of the frame alone takes longer than the budget; 0: none up to
/// 131,072, or up to as many ranks as worlds.
struct Wall {
  std::int64_t worlds = 0;
  analysis::FramePart part = analysis::FramePart::gather;
  std::int64_t flat_ranks = 0, tree_ranks = 0;
};
std::vector<Wall> walls_of(const ForecastQuestion& question, const analysis::HarnessCosts& costs);

/// A frame of several ranks, measured and forecast.
struct ForecastCheck {
  analysis::TimedCase measured;
  double forecast_s = 0;
};
std::vector<ForecastCheck> checks_of(const Calibration& calibration);

/// Tables costs, forecasts, walls and checks.
io::TableFile forecast_tables(const Calibration& calibration, const ForecastQuestion& question);

}  // namespace pbmpi::app
