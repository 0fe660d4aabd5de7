#include "app/pbreport/diff/diff_file.h"

#include <utility>

#include "app/common/version.h"

namespace pbmpi::app {
namespace {

using Columns = std::vector<io::TableColumn>;

using Summaries = std::vector<const analysis::ErrorSummary*>;

/// Adds columns of one error, e.g. body_position_rms, with one row for each of `rows`.
void add_error(const std::string& name, const std::string& unit, const Summaries& rows, Columns& columns) {
  const auto add = [&](const char* what, const std::string& of, auto member) {
    std::vector<std::decay_t<decltype(std::declval<analysis::ErrorSummary>().*member)>> values;
    for (const analysis::ErrorSummary* row : rows) values.push_back(row->*member);
    columns.push_back({name + "_" + what, of, std::move(values), 1});
  };
  add("rms", unit, &analysis::ErrorSummary::rms);
  add("p99", unit, &analysis::ErrorSummary::p99);
  add("max", unit, &analysis::ErrorSummary::max);
  add("count", "", &analysis::ErrorSummary::count);
  add("broken", "", &analysis::ErrorSummary::broken);
  std::vector<std::int64_t> bands;
  for (const analysis::ErrorSummary* row : rows)
    bands.insert(bands.end(), row->bands.begin(), row->bands.end());
  columns.push_back({name + "_bands", "", std::move(bands), analysis::num_bands});
}

void add_errors(const std::vector<analysis::ErrorTable>& tables, Columns& columns) {
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    Summaries rows;
    for (const analysis::ErrorTable& table : tables) rows.push_back(&(table.*named.summary));
    add_error(named.name, named.unit, rows, columns);
  }
}

/// Adds columns of constraints that were recorded, e.g. run_penetration_rms.
void add_constraints(const std::string& whose, const std::vector<ConstraintErrors>& errors,
                     Columns& columns) {
  for (const NamedConstraint& named : constraint_columns) {
    if (errors.empty() || named.summary(errors.front()) == nullptr) continue;
    Summaries rows;
    for (const ConstraintErrors& one : errors) rows.push_back(named.summary(one));
    add_error(whose + "_" + named.name, named.unit, rows, columns);
  }
}

/// Adds the columns of both runs; `part`: their frames or their actors.
void add_constraints(const RunComparison& comparison, std::vector<ConstraintErrors> RunConstraints::*part,
                     Columns& columns) {
  if (comparison.run_constraints) add_constraints("run", *comparison.run_constraints.*part, columns);
  if (comparison.reference_constraints)
    add_constraints("reference", *comparison.reference_constraints.*part, columns);
}

}  // namespace

io::TableFile diff_file(const RunComparison& comparison, const std::string& run,
                        const std::string& reference) {
  io::TableFile file;
  file.attributes = {{"pbmpi_version", program_version}, {"git_revision", git_revision}};
  file.parameters = {io::Parameter::of("run", run), io::Parameter::of("reference", reference)};
  Columns frames = {{"step", "", comparison.steps, 1}};
  add_errors(comparison.drift_by_frame, frames);
  add_constraints(comparison, &RunConstraints::by_frame, frames);
  file.tables["frames"] = std::move(frames);
  std::vector<std::int64_t> world;
  std::vector<std::string> name, kind;
  std::vector<analysis::ErrorTable> drift;
  for (const ActorErrors& actor : comparison.drift_by_actor) {
    world.push_back(actor.actor.world);
    name.push_back(actor.actor.name);
    kind.push_back(actor.actor.kind);
    drift.push_back(actor.drift);
  }
  Columns actors = {{"world", "", world, 1}, {"actor", "", name, 1}, {"kind", "", kind, 1}};
  add_errors(drift, actors);
  add_constraints(comparison, &RunConstraints::by_actor, actors);
  file.tables["actors"] = std::move(actors);
  return file;
}

}  // namespace pbmpi::app
