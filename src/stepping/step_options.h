/// The options of a step, one row each. Command lines, files, checkpoints, and studies follow from
/// the rows: a new option takes a member of StepperSettings, its row, and the solver's use of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/quantity.h"
#include "stepping/stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::stepping {

/// The member of StepperSettings that an option sets.
using StepMember =
    std::variant<int StepperSettings::*, double StepperSettings::*, std::uint64_t StepperSettings::*,
                 StepperKind StepperSettings::*, SorLaw StepperSettings::*, Precision StepperSettings::*,
                 Simd StepperSettings::*>;

/// A value as HDF5 files store it.
using StepValue = std::variant<std::int64_t, double, std::string>;

struct StepOption {
  std::string_view name = {};  ///< on the command line, e.g. "solver-seed"
  StepMember member = &StepperSettings::iterations;
  std::string_view placeholder = {};  ///< for --help: "N", "double|single"
  std::string_view meaning = {};      ///< for --help
  std::string_view shown_default =
      {};  ///< applied and shown by --help; empty: the scene's or StepperSettings'

  bool StepperTraits::*needs = nullptr;    ///< the option is for steppers with this trait; null: for all
  bool (*allows)(double) = nullptr;        ///< which numbers are valid; null: all
  std::string_view limit = {};             ///< what allows() requires, for messages
  const core::Measure* measure = nullptr;  ///< of a quantity with a unit; null: a bare number

  bool is_physics = true;  ///< affects the bits of a result: a resumed run must keep it
  bool in_studies = true;  ///< part of pbstudy's settings: a column of the file, a line of a written config
  /// How a setting's short text names a value that is not the default: '*' stands for the value. Empty: the
  /// text treats this option specially, or leaves it out.
  std::string_view in_short = {};
  const char* unit = "";  ///< of the value in files
};

std::span<const StepOption> step_options();
/// The row with this name, which must be there.
const StepOption& step_option(std::string_view name);

/// An option's name in files, with '_' in place of '-'.
std::string file_name(std::string_view name);
inline std::string file_name(const StepOption& option) { return file_name(option.name); }

/// Does this kind of stepper use the option?
bool fits(const StepOption& option, StepperKind kind);
/// Does it change what this kind of stepper does? The iterations of one that solves exactly are taken, as
/// older checkpoints have them, and change nothing.
bool acts(const StepOption& option, StepperKind kind);

/// The value as text, without a unit.
std::string text_of(const StepOption& option, const StepperSettings& settings);
/// The value as text that set() reads back bit for bit.
std::string given_text(const StepOption& option, const StepperSettings& settings);
StepValue value_of(const StepOption& option, const StepperSettings& settings);
/// Does the option have the value of default_settings() of this stepper and law? That of the law itself is
/// Law::soft.
bool is_default(const StepOption& option, const StepperSettings& settings);

/// Sets the value that `text` names. Throws core::InputError, opening with `what` (e.g. "--precision"), if
/// there is no such value. A law brings none of its default_settings() but itself.
void set(const StepOption& option, std::string_view text, const std::string& what, StepperSettings& settings);

/// The stepper's name, and its precision where it has a choice: "quick", "sor single".
std::string stepper_text(const StepperSettings& settings);

/// "sor single, 2 x 3, tolerance 0.001 m": the stepper, substeps x iterations, and what differs from
/// default_settings().
std::string setting_text(const StepperSettings& settings);

}  // namespace pbmpi::stepping
