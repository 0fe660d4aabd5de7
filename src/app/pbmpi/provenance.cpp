#include "app/pbmpi/provenance.h"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "app/common/version.h"
#include "app/pbmpi/stepper_factory.h"
#include "core/utc.h"
#include "model/effects.h"
#include "model/names.h"
#include "mpi/session.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// SLURM_* and OMPI_* of this process, one a line.
std::string job_environment() {
  std::vector<std::string> lines;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string line = *entry;
    if (line.starts_with("SLURM_") || line.starts_with("OMPI_")) lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What the plan says of the effect "field_of_interest".
std::optional<std::string> interest_of(const model::Model& model) {
  const model::StepPlan plan(model);
  for (const model::Pass& pass : plan.passes()) {
    if (pass.effect->name == "field_of_interest") return pass.reason.text();
  }
  return std::nullopt;
}

}  // namespace

Provenance collect_provenance(const mpi::Communicator& comm, const std::string& command_line) {
  Provenance provenance;
  provenance.command_line = command_line;
  provenance.created = core::utc_now();
  std::string environment = job_environment();
  comm.bcast_string(provenance.created);
  comm.bcast_string(environment);
  provenance.environment = lines_of(environment);
  provenance.hosts = mpi::host_names(comm);
  return provenance;
}

std::vector<std::string> distinct(const std::vector<std::string>& values) {
  std::vector<std::string> result;
  for (const std::string& value : values) {
    if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
  }
  return result;
}

io::OptionalColumns optional_columns(const scenes::Scene& scene, const RunSpec& spec) {
  io::OptionalColumns columns;
  columns.profile = spec.record_islands;
  columns.estimate = spec.estimate.has_value();
  columns.residuals = spec.stepper.residuals;
  columns.interest = spec.stepper.kind != model::StepperKind::direct &&
                     interest_of(*scene.build(0, spec.scene_seed)).has_value();
  return columns;
}

std::vector<Parameter> run_attributes(const scenes::Scene& scene, const RunSpec& spec,
                                      const Provenance& provenance) {
  return {Parameter::of("pbmpi_version", program_version),
          Parameter::of("git_revision", git_revision),
          Parameter::of("created", provenance.created),
          Parameter::of("seed", static_cast<std::int64_t>(spec.scene_seed)),
          Parameter::of("scene", scene.name()),
          Parameter::of("command_line", provenance.command_line)};
}

std::vector<Parameter> run_parameters(const scenes::Scene& scene, const RunSpec& spec,
                                      const Provenance& provenance) {
  std::vector<Parameter> parameters = {
      Parameter::of("scene", scene.name()),
      Parameter::of("scene_text", scene.text()),
      Parameter::of("replicas", std::int64_t{spec.num_worlds}),
      Parameter::of("warmup", std::int64_t{spec.warmup}),
      Parameter::of("frames", std::int64_t{spec.frames}),
      Parameter::of("steps_per_frame", std::int64_t{spec.steps_per_frame}),
      Parameter::of("dt", spec.stepper.dt_s),
      Parameter::of("stepper", std::string(name_of(spec.stepper.kind))),
      Parameter::of("iterations", std::int64_t{spec.stepper.iterations}),
      Parameter::of("substeps", std::int64_t{spec.stepper.substeps}),
      Parameter::of("sor_factor", spec.stepper.sor_factor),
      Parameter::of("warm_start", spec.stepper.warm_start),
      Parameter::of("row_order", std::string(name_of(spec.stepper.row_order))),
      Parameter::of("precision", std::string(name_of(spec.stepper.precision))),
      Parameter::of("simd", simd_text(spec.stepper)),
      Parameter::of("colliders", std::string(name_of(spec.stepper.colliders))),
      Parameter::of("seed", static_cast<std::int64_t>(spec.scene_seed)),
      Parameter::of("solver_seed", static_cast<std::int64_t>(spec.stepper.seed)),
      Parameter::of("feec", std::int64_t{spec.estimate ? 1 : 0}),
      Parameter::of("decompose", spec.decomposition == Decomposition::spaces ? "spaces" : "worlds"),
      Parameter::of("spaces", spec.spaces == scenes::SpacesForm::one ? "one" : "many"),
      Parameter::of("effects", model::to_text(spec.effects)),
      Parameter::of("num_spaces", static_cast<std::int64_t>(scene.build(0, spec.scene_seed)->spaces.size())),
      Parameter::of("record_every", std::int64_t{spec.record_every}),
      Parameter::of("record_islands", std::int64_t{spec.record_islands ? 1 : 0}),
      Parameter::of("ranks", static_cast<std::int64_t>(provenance.hosts.size())),
      Parameter::of("build", build_description),
      Parameter::of("library_mpi", mpi::library_version()),
      Parameter::of("library_hdf5", hdf5_version),
      Parameter::of("library_ode", ode_version),
  };
  if (const auto interest = interest_of(*scene.build(0, spec.scene_seed)))
    parameters.push_back(Parameter::of("field_of_interest", *interest));
  if (spec.estimate) {
    parameters.push_back(Parameter::of("estimate_stepper", std::string(name_of(spec.estimate->kind))));
    parameters.push_back(Parameter::of("estimate_iterations", std::int64_t{spec.estimate->iterations}));
    parameters.push_back(Parameter::of("estimate_precision", std::string(name_of(spec.estimate->precision))));
    const auto source = static_cast<std::size_t>(spec.estimate_source);
    parameters.push_back(Parameter::of("estimate_source", std::string(estimate_source_names[source])));
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
