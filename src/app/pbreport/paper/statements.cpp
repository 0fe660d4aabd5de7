#include "app/pbreport/paper/statements.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pbmpi::app {
namespace {

std::vector<PaperStatement> joined(std::vector<PaperStatement> first, std::vector<PaperStatement> second) {
  std::ranges::move(second, std::back_inserter(first));
  return first;
}

}  // namespace

std::vector<Chapter> all_statements(const PaperData& data) {
  return {{"load", "What such simulations ask for (sections 1 and 2)",
           joined(load_statements(data), engine_statements(data))},
          {"suite", "The suite (section 3)", suite_statements(data)},
          {"performance", "Performance (section 4)",
           joined(performance_statements(data), parallel_statements(data))},
          {"prediction", "Value prediction (section 5.1)", prediction_statements(data)},
          {"FEEC", "Fast estimation with error control (section 5.2)",
           joined(estimate_statements(data), error_statements(data))}};
}

}  // namespace pbmpi::app
