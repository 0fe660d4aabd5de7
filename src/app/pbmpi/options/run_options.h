/// The options of a run, one row each. Command line, help, files of --config, checkpoints and /parameters
/// follow from the rows: a new option takes a member of RunSpec, its row, and the run's use of it. Options of
/// a step have a table of their own (stepping/step_options.h).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <boost/program_options.hpp>

#include "app/pbmpi/options/run_spec.h"
#include "core/quantity.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

/// The member of RunSpec that an option sets. Real numbers are quantities with a unit.
using RunMember =
    std::variant<bool RunSpec::*, int RunSpec::*, double RunSpec::*, std::uint64_t RunSpec::*,
                 std::optional<int> RunSpec::*, std::optional<double> RunSpec::*,
                 std::optional<std::string> RunSpec::*, std::optional<WorldRange> RunSpec::*,
                 Records RunSpec::*, model::EffectChoices RunSpec::*, stability::OnBlowup RunSpec::*,
                 Decomposition RunSpec::*, ReportFormat RunSpec::*>;

/// The headings of --help.
enum class OptionGroup { scene, step, cut, output, stop };

/// What a checkpoint keeps of an option.
enum class Saved {
  no,
  value,    ///< for a resumed run that is not told otherwise
  physics,  ///< it decides the bits of the result: a resumed run must have the same
};

struct RunOption {
  std::string_view name;  ///< on the command line, e.g. "record-every"
  RunMember member;
  OptionGroup group = OptionGroup::scene;
  char letter = 0;                    ///< its short form, "-o"; 0: none
  std::string_view placeholder = {};  ///< for --help; empty: a flag
  std::string meaning = {};           ///< for --help
  bool shows_default = false;         ///< --help shows the value of RunSpec{}
  Saved saved = Saved::no;
  bool recorded = false;                                  ///< has a value in /parameters
  int scenes::RunDefaults::*of_scene = nullptr;           ///< what the scene proposes
  int least = 1, most = std::numeric_limits<int>::max();  ///< of whole numbers
  const core::Measure* measure = &core::run_time;         ///< of real numbers
};

const std::vector<RunOption>& run_options();

/// Adds the options of a group.
void add_run_options(OptionGroup group, boost::program_options::options_description& description);

/// Sets the value that `text` names. Throws core::InputError with one clear message.
void set(const RunOption& option, const std::string& text, RunSpec& spec);
/// Takes what the scene proposes, if it proposes anything.
void take_default(const RunOption& option, const scenes::RunDefaults& defaults, RunSpec& spec);

/// The value as text that set() reads back bit for bit. Nothing where the option is left out: an optional
/// member without a value, or a flag that is not set.
std::optional<std::string> text_of(const RunOption& option, const RunSpec& spec);
/// The value as files store it, likewise; flags are 0 or 1.
std::optional<stepping::StepValue> value_of(const RunOption& option, const RunSpec& spec);

}  // namespace pbmpi::app
