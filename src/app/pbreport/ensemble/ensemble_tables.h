/// The findings about an ensemble, as the tables of its HDF5 file, of CSV and of JSON.
#pragma once

#include "app/pbreport/ensemble/ensemble_bodies.h"
#include "app/pbreport/ensemble/ensemble_frames.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

inline constexpr const char* ensemble_filetype = "pbmpi-ensemble";

struct Ensemble {
  std::vector<QuantitySpread> quantities;
  EnsemblePositions positions;
  std::vector<WorldFacts> worlds;
};

/// Tables runs, frames, positions, bodies, worlds, and body_frames if the positions of bodies were kept
/// (io/SCHEMA.md).
io::TableFile ensemble_tables(const EnsembleRuns& runs, const Ensemble& found,
                              const EnsembleOptions& options);

/// "q5" for 0.05.
std::string quantile_name(double quantile);

}  // namespace pbmpi::app
