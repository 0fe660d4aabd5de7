#include "app/pbreport/diff/diff_file.h"

#include <utility>

#include "app/common/version.h"

namespace pbmpi::app {
namespace {

using Columns = std::vector<io::TableColumn>;

/// Columns of one error, e.g. body_position_rms, of all tables.
void add_errors(const std::vector<analysis::ErrorTable>& tables, Columns& columns) {
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    const auto add = [&](const char* what, const char* unit, auto value_of) {
      std::vector<decltype(value_of(tables.front().*named.summary))> values;
      for (const analysis::ErrorTable& table : tables) values.push_back(value_of(table.*named.summary));
      columns.push_back({std::string(named.name) + "_" + what, unit, std::move(values), 1});
    };
    add("rms", named.unit, [](const analysis::ErrorSummary& s) { return s.rms; });
    add("p99", named.unit, [](const analysis::ErrorSummary& s) { return s.p99; });
    add("max", named.unit, [](const analysis::ErrorSummary& s) { return s.max; });
    add("count", "", [](const analysis::ErrorSummary& s) { return s.count; });
    add("broken", "", [](const analysis::ErrorSummary& s) { return s.broken; });
    std::vector<std::int64_t> bands;
    for (const analysis::ErrorTable& table : tables) {
      const analysis::BandCounts& counts = (table.*named.summary).bands;
      bands.insert(bands.end(), counts.begin(), counts.end());
    }
    columns.push_back({std::string(named.name) + "_bands", "", std::move(bands), analysis::num_bands});
  }
}

}  // namespace

io::TableFile diff_file(const RunComparison& comparison, const std::string& run,
                        const std::string& reference) {
  io::TableFile file;
  file.attributes = {{"pbmpi_version", program_version}, {"git_revision", git_revision}};
  file.parameters = {io::Parameter::of("run", run), io::Parameter::of("reference", reference)};
  Columns frames = {{"step", "", comparison.steps, 1}};
  add_errors(comparison.drift_by_frame, frames);
  file.tables["frames"] = std::move(frames);
  std::vector<std::int64_t> world;
  std::vector<std::string> name, kind;
  std::vector<analysis::ErrorTable> drift;
  for (const ActorErrors& actor : comparison.drift_by_actor) {
    world.push_back(actor.world);
    name.push_back(actor.name);
    kind.push_back(actor.kind);
    drift.push_back(actor.drift);
  }
  Columns actors = {{"world", "", world, 1}, {"actor", "", name, 1}, {"kind", "", kind, 1}};
  add_errors(drift, actors);
  file.tables["actors"] = std::move(actors);
  return file;
}

}  // namespace pbmpi::app
