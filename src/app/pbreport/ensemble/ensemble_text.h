/// An ensemble for people and for other programs.
#pragma once

#include <string>

#include "app/pbreport/ensemble/ensemble_tables.h"

namespace pbmpi::app {

/// Runs, and the values in the last frame that all runs have.
std::string ensemble_text(const EnsembleRuns& runs, const Ensemble& found, const EnsembleOptions& options);
std::string ensemble_markdown(const EnsembleRuns& runs, const Ensemble& found,
                              const EnsembleOptions& options);

}  // namespace pbmpi::app
