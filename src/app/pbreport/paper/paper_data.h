/// The measurements of jobs/paper.sh, sorted by kind of file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/pbreport/figures/figures_data.h"
#include "app/pbreport/instructions/counts.h"
#include "app/pbreport/prediction/prediction_data.h"
#include "app/pbreport/stability/stability_data.h"
#include "app/pbreport/suite/characterise.h"
#include "app/pbreport/suite/island_work.h"
#include "io/html/provenance.h"

namespace pbmpi::app {

/// A run of quick with --record-islands.
struct SuiteRun {
  IslandSummary islands;
  std::vector<double> islands_by_frame;  ///< over the measured frames
  CoreSummary cores;
  IslandWork work;
  std::map<std::string, std::int64_t> events;  ///< kind -> number, in the whole run
  std::map<std::string, std::vector<int>>
      actor_bodies{};  ///< kind of actor -> the numbers of bodies that an actor has
};

/// A run without the effect fast_bodies.
struct PlainRun {
  std::string scene;
  std::int64_t passages = 0;  ///< bodies that a guard saw pass through something
};

struct PaperData {
  std::vector<SuiteRun> suite;              ///< 20 iterations
  std::vector<SuiteRun> one_iteration;      ///< the cost of FEEC's estimate
  std::vector<IslandWork> more_iterations;  ///< any other number
  std::vector<IslandWork> direct;
  std::vector<PlainRun> plain;
  std::vector<FigureScene> figures;  ///< from jobs/figure8_9.sh
  std::vector<CountedScene> counts;  ///< from jobs/figure3.sh
  std::optional<PredictionStudy> prediction;
  std::optional<StabilityMap> stability;
  std::vector<io::html::FileAttributes> files;  ///< all files read

  const SuiteRun* find(const std::string& scene) const;
  /// The islands of the suite's runs.
  std::vector<IslandWork> works() const;
};

/// Reads files, and all .h5 and .json files below folders, where other kinds are passed over. Several runs of
/// one scene and setting are repeats, of which each time is the least. Scenes come out in the order of the
/// paper's Table 1. Throws core::InputError for a file that is named but of no use, for different runs or
/// studies where one is wanted, and if nothing is found.
PaperData read_paper_data(const std::vector<std::string>& paths);

}  // namespace pbmpi::app
