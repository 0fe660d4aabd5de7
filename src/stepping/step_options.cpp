#include "stepping/step_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/error.h"
#include "core/quantity.h"
#include "stepping/names.h"
#include "stepping/option_values.h"

namespace pbmpi::stepping {
namespace {

using Settings = StepperSettings;
using Traits = StepperTraits;

bool at_least_1(double value) { return value >= 1; }
bool is_length(double value) { return std::isfinite(value) && value > 0; }
bool is_count(double value) { return value >= 0; }
bool is_frequency(double value) { return value >= 0; }
bool is_magnitude(double value) { return std::isfinite(value) && value >= 0; }
bool converges(double factor) { return factor > 0 && factor < 2; }
bool is_thread_count(double value) { return value >= 1 && value <= 1024; }
bool is_share(double value) { return value >= 0 && value <= 1; }

constexpr std::array<StepOption, 24> options = {{
    {.name = "stepper",
     .member = &Settings::kind,
     .placeholder = "sor|quick|direct|bullet|mujoco",
     .meaning =
         "sor: pbmpi's own projected SOR, worlds side by side in vector lanes; quick: ODE's iterative "
         "dWorldQuickStep; direct: ODE's big-matrix dWorldStep; bullet, mujoco: the engines Bullet and "
         "MuJoCo, where the build has them",
     .shown_default = "sor"},
    {.name = "dt",
     .member = &Settings::dt_s,
     .placeholder = "SECONDS",
     .meaning = "length of a step [s]; default: the scene's, 0.01",
     .allows = is_length,
     .limit = "a step must be finite and above 0 s",
     .unit = "s"},
    {.name = "iterations",
     .member = &Settings::iterations,
     .placeholder = "N",
     .meaning =
         "sweeps of the iterative solver, in each substep; default: the scene's (20) with quick, 1 with sor, "
         "10 with bullet; with mujoco the most iterations of its --constraint-solver, 100",
     .allows = at_least_1,
     .limit = "it must be at least 1"},
    {.name = "substeps",
     .member = &Settings::substeps,
     .placeholder = "N",
     .meaning = "sor: parts of a step that share its collision detection; default: 14",
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
     .allows = is_magnitude,
     .limit = "a tolerance is a length, e.g. 0.1mm, or 0",
     .in_short = "tolerance * m",
     .unit = "m"},
    {.name = "most-substeps",
     .member = &Settings::most_substeps,
     .placeholder = "N",
     .meaning = "sor: the most substeps of an island that is so tall that its top would sink by more than a "
                "hundredth "
                "of a body; default: 32",
     .needs = &Traits::has_substeps,
     .allows = at_least_1,
     .limit = "it must be at least 1"},
    {.name = "sor-factor",
     .member = &Settings::sor_factor,
     .placeholder = "X",
     .meaning = "sor: over-relaxation, above 0 and below 2 (ODE's is 1.3); default: 1",
     .needs = &Traits::tunes_sweeps,
     .allows = converges,
     .limit = "the iteration converges above 0 and below 2 only",
     .in_short = "factor *"},
    {.name = "warm-start",
     .member = &Settings::warm_start,
     .placeholder = "X",
     .meaning =
         "sor: share of the last step's and substep's forces with which joints and contacts start, 0 to "
         "1; 0: a step without memory; default: 1",
     .needs = &Traits::tunes_sweeps,
     .allows = is_share,
     .limit = "the share of the impulses to take over is 0 to 1",
     .in_short = "warm *"},
    {.name = "relax",
     .member = &Settings::relax,
     .placeholder = "N",
     .meaning =
         "sor: sweeps at the end of a substep that take back the speed which pushed errors of position "
         "out; default: 1",
     .needs = &Traits::tunes_sweeps,
     .allows = is_count,
     .limit = "it must be at least 0",
     .in_short = "relax *"},
    {.name = "contact-frequency",
     .member = &Settings::contact_frequency,
     .placeholder = "HZ",
     .meaning = "sor: contacts are springs of this frequency, at most 0.18 periods a substep; inf: as stiff "
                "as that; "
                "0: they have the scene's ERP and CFM; default: inf",
     .needs = &Traits::tunes_sweeps,
     .allows = is_frequency,
     .limit = "a frequency is 0 or more, or inf",
     .in_short = "contacts * Hz",
     .unit = "Hz"},
    {.name = "contact-damping",
     .member = &Settings::contact_damping,
     .placeholder = "RATIO",
     .meaning = "sor: damping ratio of contacts that are springs; default: 20",
     .needs = &Traits::tunes_sweeps,
     .allows = is_length,
     .limit = "a damping ratio is above 0, and finite",
     .in_short = "damping *"},
    {.name = "contact-margin",
     .member = &Settings::contact_margin,
     .placeholder = "X",
     .meaning =
         "sor: contacts are found between bodies that are no farther apart than X g dt^2, in units of twice "
         "what falls in a step from rest; 0: where bodies touch; default: 1",
     .needs = &Traits::tunes_sweeps,
     .allows = is_magnitude,
     .limit = "it must be 0 or more, and finite",
     .in_short = "margin *"},
    {.name = "joint-frequency",
     .member = &Settings::joint_frequency,
     .placeholder = "HZ",
     .meaning = "sor: as --contact-frequency, of joints; rows that hold a place have up to 0.2 periods "
                "a substep, those that hold a turn 0.25; default: inf",
     .needs = &Traits::tunes_sweeps,
     .allows = is_frequency,
     .limit = "a frequency is 0 or more, or inf",
     .in_short = "joints * Hz",
     .unit = "Hz"},
    {.name = "joint-damping",
     .member = &Settings::joint_damping,
     .placeholder = "RATIO",
     .meaning =
         "sor: damping ratio of joints that are springs, of those solved exactly at most 0.7; default: 3",
     .needs = &Traits::tunes_sweeps,
     .allows = is_length,
     .limit = "a damping ratio is above 0, and finite",
     .in_short = "damping *"},
    {.name = "joint-solver",
     .member = &Settings::joint_solver,
     .placeholder = "sweeps|hanging|tree",
     .meaning =
         "sor: in a sweep joints are solved one after the other, or all of an articulation exactly, but "
         "for limits, motors and what closes loops; hanging: exactly where joints hold an articulation to "
         "what does not move; default: hanging",
     .needs = &Traits::tunes_sweeps,
     .in_short = "joints by *"},
    {.name = "constraint-solver",
     .member = &Settings::constraint_solver,
     .placeholder = "newton|pgs|cg",
     .meaning =
         "mujoco: Newton's method, projected Gauss-Seidel, or conjugate gradients, of which --iterations "
         "are the most steps, sweeps or steps; default: newton",
     .needs = &Traits::has_constraint_solvers,
     .in_short = "*"},
    {.name = "friction",
     .member = &Settings::friction,
     .placeholder = "patch|cone|pyramid",
     .meaning =
         "sor: patch: the same in all directions, shared by the contacts of two bodies in a plane, which "
         "also "
         "resist a twist about their middle; cone: the same in all directions, at each contact; pyramid: as "
         "ODE's, which holds more along the diagonals of two axes; default: patch",
     .needs = &Traits::tunes_sweeps,
     .in_short = "*"},
    {.name = "finish",
     .member = &Settings::finish,
     .placeholder = "none|newton",
     .meaning =
         "sor: newton: after the sweeps over rigid rows (--relax 0, no springs; --friction is then cone by "
         "default) islands of up to 400 rows of contacts, limits and motors are solved to rounding, for "
         "references; default: none",
     .needs = &Traits::tunes_sweeps,
     .in_short = "by *"},
    {.name = "row-order",
     .member = &Settings::row_order,
     .placeholder = "shuffled|fixed",
     .meaning =
         "sor: the order of joints and contacts in the sweeps: drawn anew (joints every 8 iterations), "
         "or always the model's",
     .shown_default = "shuffled",
     .needs = &Traits::tunes_sweeps,
     .in_short = "* order"},
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
    {.name = "colliders",
     .member = &Settings::colliders,
     .placeholder = "lanes|ode",
     .meaning = "sor: what collides pairs of geoms; lanes: kernels over vector lanes, ode: dCollide",
     .shown_default = "lanes",
     .needs = &Traits::has_lanes,
     .in_studies = false},
    {.name = "solver-seed",
     .member = &Settings::seed,
     .placeholder = "N",
     .meaning = "of the solver's row order alone: runs that differ in it show the noise floor; default: "
                "--seed",
     .in_studies = false},
}};

constexpr const auto& names_of(StepperKind) { return stepper_kind_names; }
constexpr const auto& names_of(RowOrder) { return row_order_names; }
constexpr const auto& names_of(JointSolver) { return joint_solver_names; }
constexpr const auto& names_of(ConstraintSolver) { return constraint_solver_names; }
constexpr const auto& names_of(Friction) { return friction_names; }
constexpr const auto& names_of(Finish) { return finish_names; }
constexpr const auto& names_of(Precision) { return precision_names; }
constexpr const auto& names_of(Simd) { return simd_names; }
constexpr const auto& names_of(Colliders) { return colliders_names; }

template <class Enum>
requires std::is_enum_v<Enum> Enum parse(std::string_view text, const std::string& what, const StepOption&,
                                         Enum) {
  return read_word<Enum>(text, what, names_of(Enum{}));
}

template <class Number>
requires std::is_arithmetic_v<Number> Number parse(std::string_view text, const std::string& what,
                                                   const StepOption& option, Number) {
  if (option.unit == std::string_view("m")) {
    if (const auto length = core::quantity(text, core::lengths())) return static_cast<Number>(*length);
  }
  const auto value = read_number<Number>(text, what);
  core::require_input(option.allows == nullptr || option.allows(static_cast<double>(value)),
                      what + " " + std::string(text) + ": " + std::string(option.limit));
  return value;
}

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

StepValue value_of(const StepOption& option, const StepperSettings& settings) {
  return std::visit(
      [&](auto member) -> StepValue {
        const auto value = settings.*member;
        if constexpr (std::is_enum_v<std::remove_const_t<decltype(value)>>)
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
        if constexpr (std::is_enum_v<std::remove_const_t<decltype(value)>>)
          return std::string(name_of(value));
        else
          return written(value);
      },
      option.member);
}

StepperSettings default_settings(StepperKind kind) {
  StepperSettings settings;
  settings.kind = kind;
  if (traits_of(kind).own_iterations > 0) settings.iterations = traits_of(kind).own_iterations;
  if (!traits_of(kind).tunes_sweeps) return settings;
  settings.substeps = 14;
  settings.relax = 1;
  settings.sor_factor = 1;
  settings.warm_start = 1;
  settings.contact_frequency = settings.joint_frequency = std::numeric_limits<double>::infinity();
  settings.contact_margin = 1;
  settings.friction = Friction::patch;
  settings.joint_solver = JointSolver::hanging;
  return settings;
}

int default_iterations(StepperKind kind, int scene_iterations) {
  return traits_of(kind).own_iterations > 0 ? traits_of(kind).own_iterations : scene_iterations;
}

bool is_default(const StepOption& option, const StepperSettings& settings) {
  return text_of(option, settings) == text_of(option, default_settings(settings.kind));
}

void set(const StepOption& option, std::string_view text, const std::string& what,
         StepperSettings& settings) {
  std::visit([&](auto member) { settings.*member = parse(text, what, option, settings.*member); },
             option.member);
}

void restore(const StepOption& option, const StepValue& value, StepperSettings& settings) {
  const auto put = [&](auto member) {
    using Member = std::remove_reference_t<decltype(settings.*member)>;
    if constexpr (std::is_enum_v<Member>)
      settings.*member = parse(std::get<std::string>(value), std::string(option.name), option, Member{});
    else if constexpr (std::is_integral_v<Member>)
      settings.*member = static_cast<Member>(std::get<std::int64_t>(value));
    else
      settings.*member = std::get<double>(value);
  };
  std::visit(put, option.member);
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
