/// All statements of the paper, in its order. Each has its rule, even where nothing was measured.
#pragma once

#include <vector>

#include "app/pbreport/paper/paper_data.h"
#include "app/pbreport/paper/statement.h"

namespace pbmpi::app {

/// Sections 1 to 2.2: what such simulations demand of a machine.
std::vector<PaperStatement> load_statements(const PaperData& data);
/// Section 2.3: what ODE does, and what it costs.
std::vector<PaperStatement> engine_statements(const PaperData& data);
/// Section 3: the scenes, Table 1, and the mix of instructions.
std::vector<PaperStatement> suite_statements(const PaperData& data);
/// Section 4: Figure 3, shares of the time, Table 2.
std::vector<PaperStatement> performance_statements(const PaperData& data);
/// Section 4.2, and what sections 5 and 6 say about it: Figure 6, parallel islands and spaces.
std::vector<PaperStatement> parallel_statements(const PaperData& data);
/// Value prediction: section 5.1 and its part of 5.4.
std::vector<PaperStatement> prediction_statements(const PaperData& data);
/// FEEC: section 5.2, Figure 8.
std::vector<PaperStatement> estimate_statements(const PaperData& data);
/// Effects of few iterations on the result: sections 5.2.1 and 5.4, Figure 9.
std::vector<PaperStatement> error_statements(const PaperData& data);

/// A part of the paper with its statements.
struct Chapter {
  std::string name;  ///< one word, for a diagram
  std::string title;
  std::vector<PaperStatement> statements;
};
std::vector<Chapter> all_statements(const PaperData& data);

}  // namespace pbmpi::app
