#include "app/pbmpi/run_parameters.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "app/common/engine_texts.h"
#include "app/common/json_text.h"
#include "app/common/step_arguments.h"
#include "app/common/version.h"
#include "app/pbmpi/options/run_options.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "mpi/comm/session.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "stepping/step_options.h"

namespace pbmpi::effects {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PassTally, worlds, idle_worlds, counts)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunPlan, num_worlds, tallies)
}  // namespace pbmpi::effects

namespace pbmpi::app {
namespace {

using io::Parameter;

/// What the plan says of the effect "field_of_interest".
std::optional<std::string> interest_of(const model::Model& model) {
  const effects::StepPlan plan(model);
  for (const effects::Pass& pass : plan.passes()) {
    if (pass.effect->id == effects::EffectId::field_of_interest) return pass.reason.text();
  }
  return std::nullopt;
}

Parameter parameter_of(const std::string& name, stepping::StepValue value) {
  return std::visit([&](auto held) { return Parameter::of(name, std::move(held)); }, std::move(value));
}

Parameter step_parameter(const std::string& prefix, const stepping::StepOption& option,
                         const stepping::StepperSettings& settings) {
  return parameter_of(prefix + file_name(option), value_of(option, settings));
}

}  // namespace

effects::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const stepping::LocalWorld> own) {
  effects::RunPlan mine;
  for (const stepping::LocalWorld& world : own) mine.add(*world.model);
  const std::string line = json_text(nlohmann::json(mine)) + "\n";
  const std::vector<char> lines = comm.allgatherv(std::span<const char>(line));
  std::istringstream stream(std::string(lines.begin(), lines.end()));
  effects::RunPlan plan;
  for (std::string one; std::getline(stream, one);)
    plan.add(nlohmann::json::parse(one).get<effects::RunPlan>());
  return plan;
}

io::OptionalColumns optional_columns(const Work& work, const effects::RunPlan& plan) {
  const RunSpec& spec = work.spec;
  io::OptionalColumns columns;
  columns.profile = spec.records.has(Record::islands);
  columns.estimate = spec.estimate.has_value();
  columns.residuals = spec.stepper.residuals;
  columns.contacts = spec.stepper.contacts;
  const auto any_world_has = [&plan](effects::EffectId id) {
    return std::ranges::any_of(plan.passes(), [id](const auto& pass) { return pass.effect->id == id; });
  };
  columns.breaks = any_world_has(effects::EffectId::breakable_joints);
  columns.interest =
      traits_of(spec.stepper.kind).has_field && any_world_has(effects::EffectId::field_of_interest);
  return columns;
}

std::vector<io::WorldParameter> world_parameters(const Work& work) {
  std::vector<io::WorldParameter> columns;
  if (!work.parameters) return columns;
  const auto values = work.parameters->values();
  for (std::size_t key = 0; key < work.parameters->keys().size(); ++key) {
    io::WorldParameter& column = columns.emplace_back();
    column.key = work.parameters->keys()[key];
    // The whole table decides, so that the files of an ensemble's parts have columns of one type.
    const bool are_numbers = std::ranges::all_of(values, [key](const std::vector<std::string>& row) {
      return row[key].empty() || scenes::number_in(row[key]);
    });
    for (int world = 0; world < work.spec.num_worlds; ++world) {
      const std::string& value = values[static_cast<std::size_t>(work.spec.first_world() + world)][key];
      if (are_numbers)
        column.numbers.push_back(scenes::number_in(value).value_or(std::numeric_limits<double>::quiet_NaN()));
      else
        column.texts.push_back(value);
    }
  }
  return columns;
}

std::vector<Parameter> run_attributes(const Work& work, const Provenance& provenance,
                                      const effects::RunPlan& plan) {
  std::string passes;
  for (const effects::RunPass& pass : plan.passes())
    passes += std::string(pass.effect->name) + ": " + pass.reason + "\n";
  return {Parameter::of("pbmpi_version", program_version),
          Parameter::of("git_revision", git_revision),
          Parameter::of("created", provenance.created),
          Parameter::of("seed", static_cast<std::int64_t>(work.spec.seed)),
          Parameter::of("scene", work.scene->name()),
          Parameter::of("command_line", provenance.command_line),
          Parameter::of("step_plan", passes)};
}

std::vector<Parameter> run_parameters(const Work& work, const Provenance& provenance) {
  const RunSpec& spec = work.spec;
  std::vector<Parameter> parameters = {
      Parameter::of("scene", work.scene->name()),
      Parameter::of("scene_text", work.scene->text()),
      Parameter::of("num_spaces", static_cast<std::int64_t>(work.first_world->spaces.size())),
      Parameter::of("ranks", static_cast<std::int64_t>(provenance.hosts.size())),
      Parameter::of("processors", std::int64_t{provenance.processors}),
      Parameter::of("build", build_description),
      Parameter::of("library_mpi", mpi::library_version()),
      Parameter::of("library_hdf5", hdf5_version),
      Parameter::of("library_ode", ode_text()),
  };
  if (const auto engine = optional_engine_text(spec.stepper.kind))
    parameters.push_back(Parameter::of(engine->first, engine->second));
  for (const stepping::StepOption& option : stepping::step_options()) {
    const bool is_simd = option.name == "simd";  // the file says what was used, not what was asked for
    parameters.push_back(is_simd ? Parameter::of("simd", simd_text(spec.stepper))
                                 : step_parameter("", option, spec.stepper));
  }
  for (const RunOption& option : run_options()) {
    if (!option.recorded) continue;
    if (auto value = value_of(option, spec))
      parameters.push_back(parameter_of(stepping::file_name(option.name), *std::move(value)));
  }
  for (std::size_t i = 0; i < record_names.size(); ++i)
    parameters.push_back(Parameter::of("record_" + std::string(record_names[i]),
                                       std::int64_t{spec.records.chosen[i] ? 1 : 0}));
  const scenes::SceneSource scene{work.scene->name(), work.scene->name(), work.scene->text()};
  for (const scenes::SceneSource& base : scenes::bases_of(scene))
    parameters.push_back(Parameter::of(scene_text_parameter(base.name), base.text));
  if (spec.decomposition == Decomposition::spaces && spec.num_worlds > 1)
    parameters.push_back(Parameter::of("rank_groups", to_text(spec.groups)));
  if (work.parameters) {
    parameters.push_back(Parameter::of("parameters_file", work.parameters->file()));
    parameters.push_back(Parameter::of("parameters_text", work.parameters->text()));
  }
  if (const auto interest = interest_of(*work.first_world))
    parameters.push_back(Parameter::of("field_of_interest", *interest));
  parameters.push_back(Parameter::of("feec", std::int64_t{spec.estimate ? 1 : 0}));
  if (spec.estimate) {
    for (const std::string_view name : estimate_options)
      parameters.push_back(step_parameter("estimate_", stepping::step_option(name), *spec.estimate));
  }
  if (!spec.checkpoint.resumed_from.empty())
    parameters.push_back(Parameter::of("resumed_from", spec.checkpoint.resumed_from));
  for (const std::string& line : provenance.environment) {
    const std::size_t equals = line.find('=');
    parameters.push_back(Parameter::of("env_" + line.substr(0, equals), line.substr(equals + 1)));
  }
  return parameters;
}

}  // namespace pbmpi::app
