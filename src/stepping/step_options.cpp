#include "stepping/step_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "core/error.h"
#include "stepping/names.h"
#include "stepping/option_values.h"

namespace pbmpi::stepping {
namespace {

using Settings = StepperSettings;
using Traits = StepperTraits;

bool at_least_1(double value) { return value >= 1; }
bool is_thread_count(double value) { return value >= 1 && value <= 1024; }

constexpr std::array<StepOption, 11> options = {{
    {.name = "stepper",
     .member = &Settings::kind,
     .placeholder = "sor|quick|direct|bullet|mujoco",
     .meaning =
         "sor: pbmpi's own projected SOR, worlds side by side in vector lanes; quick: ODE's iterative "
         "dWorldQuickStep; direct: ODE's big-matrix dWorldStep; bullet, mujoco: the engines Bullet and "
         "MuJoCo, where the build has them",
     .shown_default = "sor"},
    {.name = "law",
     .member = &Settings::law,
     .placeholder = "soft|ode|coulomb",
     .meaning =
         "sor: soft: soft constraints in many substeps, with a memory of forces; ode: ODE's equations, each "
         "step solved from nothing, for references and comparisons; coulomb: these with Coulomb's cones of "
         "friction, islands of up to 400 rows of contacts, limits and motors solved to rounding by Newton's "
         "method after the sweeps, for references; default: soft",
     .needs = &Traits::has_laws,
     .in_short = "law *"},
    {.name = "dt",
     .member = &Settings::dt_s,
     .placeholder = "SECONDS",
     .meaning = "length of a step, e.g. 10ms (us, ms, s); default: the scene's, 0.01 s",
     .measure = &core::step_time,
     .unit = "s"},
    {.name = "iterations",
     .member = &Settings::iterations,
     .placeholder = "N",
     .meaning =
         "sweeps of the iterative solver, in each substep; default: the scene's (20) with quick and --law "
         "ode or coulomb, 1 with --law soft, 10 with bullet; with mujoco the most of Newton's method, 100",
     .allows = at_least_1,
     .limit = "it must be at least 1"},
    {.name = "substeps",
     .member = &Settings::substeps,
     .placeholder = "N",
     .meaning =
         "sor: parts of a step that share its collision detection; default: 14, with --law ode or coulomb 1",
     .needs = &Traits::has_substeps,
     .allows = at_least_1,
     .limit = "it must be at least 1"},
    {.name = "tolerance",
     .member = &Settings::tolerance_m,
     .placeholder = "LENGTH",
     .meaning =
         "sor: an island in which nothing moves farther than this in a step gets one substep, e.g. 0.01mm; "
         "0: none does; default: 0",
     .needs = &Traits::has_substeps,
     .measure = &core::tolerance,
     .in_short = "tolerance * m",
     .unit = "m"},
    {.name = "approach",
     .member = &Settings::approach_m,
     .placeholder = "LENGTH",
     .meaning =
         "sor: islands in which bodies come nearer to each other by more than this in a step take it in up "
         "to eight pieces, with collision detection in each, e.g. 5cm; 0: none does; default: 10cm",
     .needs = &Traits::has_substeps,
     .measure = &core::length_with_unit,
     .in_short = "approach * m",
     .unit = "m"},
    {.name = "precision",
     .member = &Settings::precision,
     .placeholder = "double|single",
     .meaning = "sor: number type of the solver",
     .shown_default = "double",
     .needs = &Traits::has_precision},
    {.name = "simd",
     .member = &Settings::simd,
     .placeholder = "auto|sse2|avx2|avx512|off",
     .meaning = "sor: vector instructions; the result is the same with all",
     .shown_default = "auto",
     .needs = &Traits::has_lanes,
     .is_physics = false,
     .in_studies = false},
    {.name = "threads",
     .member = &Settings::threads,
     .placeholder = "N",
     .meaning = "sor: threads of a rank, each of which steps worlds of its own; the result is the same with "
                "any number",
     .shown_default = "1",
     .needs = &Traits::has_lanes,
     .allows = is_thread_count,
     .limit = "it must be from 1 to 1024",
     .is_physics = false,
     .in_studies = false},
    {.name = "solver-seed",
     .member = &Settings::seed,
     .placeholder = "N",
     .meaning = "of the solver's row order alone: runs that differ in it show the noise floor; default: "
                "--seed",
     .in_studies = false},
}};

constexpr const auto& names_of(StepperKind) { return stepper_kind_names; }
constexpr const auto& names_of(Law) { return law_names; }
constexpr const auto& names_of(Precision) { return precision_names; }
constexpr const auto& names_of(Simd) { return simd_names; }

template <class Enum>
requires std::is_enum_v<Enum> Enum parse(std::string_view text, const std::string& what, const StepOption&,
                                         Enum) {
  return read_word<Enum>(text, what, names_of(Enum{}));
}

SorLaw parse(std::string_view text, const std::string& what, const StepOption&, const SorLaw&) {
  return law_named(read_word<Law>(text, what, names_of(Law{})));
}

template <class Number>
requires std::is_arithmetic_v<Number> Number parse(std::string_view text, const std::string& what,
                                                   const StepOption& option, Number) {
  if (option.measure != nullptr) return static_cast<Number>(core::read_quantity(text, what, *option.measure));
  const auto value = read_number<Number>(text, what);
  core::require_input(option.allows == nullptr || option.allows(static_cast<double>(value)),
                      what + " " + std::string(text) + ": " + std::string(option.limit));
  return value;
}

/// An option whose values are words.
template <class Value>
constexpr bool is_word = std::is_enum_v<Value> || std::is_same_v<Value, SorLaw>;

std::string_view name_of(const SorLaw& law) { return stepping::name_of(law.name); }

}  // namespace

std::span<const StepOption> step_options() { return options; }

const StepOption& step_option(std::string_view name) {
  const auto found = std::ranges::find(options, name, &StepOption::name);
  core::require_invariant(found != options.end(), "a step option has a row in the table");
  return *found;
}

std::string file_name(std::string_view name) {
  std::string in_files(name);
  std::ranges::replace(in_files, '-', '_');
  return in_files;
}

bool fits(const StepOption& option, StepperKind kind) {
  return option.needs == nullptr || traits_of(kind).*option.needs;
}

bool acts(const StepOption& option, StepperKind kind) {
  return fits(option, kind) && (option.name != "iterations" || traits_of(kind).iterates);
}

StepValue value_of(const StepOption& option, const StepperSettings& settings) {
  return std::visit(
      [&](auto member) -> StepValue {
        const auto value = settings.*member;
        if constexpr (is_word<std::remove_const_t<decltype(value)>>)
          return std::string(name_of(value));
        else if constexpr (std::is_integral_v<std::remove_const_t<decltype(value)>>)
          return static_cast<std::int64_t>(value);
        else
          return value;
      },
      option.member);
}

std::string text_of(const StepOption& option, const StepperSettings& settings) {
  return std::visit(
      [&](auto member) -> std::string {
        const auto value = settings.*member;
        if constexpr (is_word<std::remove_const_t<decltype(value)>>)
          return std::string(name_of(value));
        else
          return written(value);
      },
      option.member);
}

std::string given_text(const StepOption& option, const StepperSettings& settings) {
  return option.measure == nullptr
             ? text_of(option, settings)
             : core::quantity_text(settings.*std::get<double StepperSettings::*>(option.member),
                                   *option.measure);
}

bool is_default(const StepOption& option, const StepperSettings& settings) {
  const Law law = option.name == "law" ? Law::soft : settings.law.name;
  return text_of(option, settings) == text_of(option, default_settings(settings.kind, law));
}

void set(const StepOption& option, std::string_view text, const std::string& what,
         StepperSettings& settings) {
  std::visit([&](auto member) { settings.*member = parse(text, what, option, settings.*member); },
             option.member);
}

std::string stepper_text(const StepperSettings& settings) {
  std::string text(name_of(settings.kind));
  if (traits_of(settings.kind).has_precision) text += " " + std::string(name_of(settings.precision));
  return text;
}

std::string setting_text(const StepperSettings& settings) {
  std::string text = stepper_text(settings);
  if (traits_of(settings.kind).iterates)
    text += ", " + std::to_string(settings.substeps) + " x " + std::to_string(settings.iterations);
  for (const StepOption& option : options) {
    if (option.in_short.empty() || !fits(option, settings.kind) || is_default(option, settings)) continue;
    std::string words(option.in_short);
    text += ", " + words.replace(words.find('*'), 1, text_of(option, settings));
  }
  return text;
}

}  // namespace pbmpi::stepping
