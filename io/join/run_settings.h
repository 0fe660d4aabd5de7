/// How a parameter of a run matters for its results.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::io {

enum class Matters {
  results,   ///< another value gives other results: scene, stepper, iterations ...
  seed,      ///< which sample of the same case it is
  estimate,  ///< changes FEEC's estimates, but no results
  nothing    ///< how results are computed and recorded: ranks, threads, build, number of frames ...
};

/// `name`: a dataset of /parameters.
Matters matters_for(std::string_view name);

/// A parameter whose value differs between two runs; "(none)" where a run does not have it.
struct ParameterDifference {
  std::string name, a, b;
};
using Parameters = std::map<std::string, std::string>;
/// The differences of this kind, by name.
std::vector<ParameterDifference> differences(const Parameters& a, const Parameters& b, Matters matters);

/// "iterations is 20 in a.h5 and 10 in b.h5"; for a long text only that it differs.
std::string text_of(const ParameterDifference& difference, const std::string& path_a,
                    const std::string& path_b);

}  // namespace pbmpi::io
