/// Options of all studies: the scenes, the window, how often each frame is measured; and how options that are
/// lists or counts are read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "app/pbstudy/study/study_scene.h"
#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// A study. Collective; `args` follow its name. Throws core::InputError and core::RunError, the same on every
/// rank.
using Study = core::ExitCode(const mpi::Communicator& comm, const std::vector<std::string>& args);

/// For the manuals.
inline constexpr const char* one_case_a_rank =
    "A rank works on one case at a time, and takes the next when it is done.";
inline constexpr const char* spoils_times = " More ranks than cores spoil the times.";

struct StudyOptions {
  std::vector<std::string> scenes;
  SceneOverrides overrides;
  int repeats = 1;      ///< how often each frame is timed
  int floor_seeds = 0;  ///< number of other solver seeds, for the noise floor
  std::uint64_t seed = 1;
  std::string output;
  bool resume = false;               ///< go on with the cases left by a stopped study
  std::optional<double> max_time_s;  ///< after which no further case is begun
  CommonOptions common;
  std::string command_line;
  std::vector<std::string> deciding;  ///< the arguments on which outcomes depend
};

template <class T>
auto list_of() {
  return boost::program_options::value<std::vector<T>>()->multitoken()->value_name("LIST");
}

/// Throws core::InputError, opening with `what`, if a value stands twice in a list.
template <class T>
void require_distinct(std::vector<T> values, const std::string& what) {
  std::ranges::sort(values);
  const auto twice = std::ranges::adjacent_find(values);
  if (twice == values.end()) return;
  std::ostringstream text;
  text << what << ' ' << *twice << ": it stands in the list twice; name it once";
  throw core::InputError(text.str());
}

/// The values given, or the fallback. Throws core::InputError for one that stands there twice.
template <class T>
std::vector<T> list(const boost::program_options::variables_map& values, const char* name,
                    std::vector<T> fallback) {
  if (values.count(name) == 0) return fallback;
  std::vector<T> given = values[name].as<std::vector<T>>();
  require_distinct(given, "--" + std::string(name));
  return given;
}

/// Throws core::InputError naming `option`.
void require_at_least(const std::vector<int>& given, int least, const char* option);

/// The number of an option without a default. Throws core::InputError if it is below `least`.
std::optional<int> given(const boost::program_options::variables_map& values, const char* name, int least);

/// Adds --scene.
void add_scene_option(boost::program_options::options_description& what);

/// "How to measure": --replicas, --frames, --warmup, and the options that each study describes in its own
/// words. A study adds its own options after them.
struct HowOptions {
  const char* seed = "";
  const char* repeats = "";
  int default_repeats = 1;
  const char* floor_seeds = "";
  int default_floor_seeds = 1;
};
boost::program_options::options_description how_to_measure(const HowOptions& says);

/// "What to write": --output, --resume, --max-time.
boost::program_options::options_description what_to_write(const char* default_output);

/// Throws core::InputError for an impossible number.
StudyOptions study_options(const boost::program_options::variables_map& values, const std::string& program,
                           const std::vector<std::string>& args);

}  // namespace pbmpi::app
