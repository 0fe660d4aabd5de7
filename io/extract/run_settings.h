/// What a parameter of a run means for its results.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::io {

enum class Matters {
  results,   ///< another value gives other results: scene, stepper, iterations ...
  seed,      ///< which sample of the same it is
  estimate,  ///< what FEEC's estimates are, beside which results stay as they are
  nothing    ///< what results are computed and recorded with: ranks, threads, build, number of frames ...
};

/// `name`: of a dataset of /parameters.
Matters matters_for(std::string_view name);

/// A parameter of which two runs have other values; "(none)" where a run has none.
struct ParameterDifference {
  std::string name, a, b;
};
using Parameters = std::map<std::string, std::string>;
/// Those that matter so, by name.
std::vector<ParameterDifference> differences(const Parameters& a, const Parameters& b, Matters matters);

/// "iterations is 20 in a.h5 and 10 in b.h5"; of a long text only that it differs.
std::string text_of(const ParameterDifference& difference, const std::string& path_a,
                    const std::string& path_b);

}  // namespace pbmpi::io
