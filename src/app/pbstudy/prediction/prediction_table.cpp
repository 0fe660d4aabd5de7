#include "app/pbstudy/prediction/prediction_table.h"

#include "app/pbstudy/study/table_columns.h"

namespace pbmpi::app {
namespace {

void add_error_columns(const std::string& prefix, analysis::ErrorTable PredictionResult::*table,
                       const std::vector<PredictionResult>& results, std::vector<io::TableColumn>& columns) {
  std::vector<io::TableColumn> all;
  add_errors(prefix, table, results, all);
  for (io::TableColumn& one : all) {
    if (!one.name.ends_with("_p99")) columns.push_back(std::move(one));
  }
}

std::vector<io::TableColumn> frame_columns(const std::vector<PredictedFrame>& frames) {
  using Frame = const PredictedFrame&;
  std::vector<io::TableColumn> columns = {
      column<std::int64_t>("case", "", frames, [](Frame f) { return f.case_index; }),
      column<std::int64_t>("frame", "", frames, [](Frame f) { return f.frame; }),
      column<std::int64_t>("is_estimate", "", frames, [](Frame f) { return f.is_estimate; }),
      column<std::int64_t>("instructions", "", frames, [](Frame f) { return f.instructions; }),
      column<std::int64_t>("collision_instructions", "", frames,
                           [](Frame f) { return f.collision_instructions; }),
      column<std::int64_t>("micro_ops", "", frames, [](Frame f) { return f.micro_ops; }),
      column<std::int64_t>("cycles", "", frames, [](Frame f) { return f.cycles; }),
      column<std::int64_t>("predicted_cycles", "", frames, [](Frame f) { return f.predicted_cycles; }),
  };
  for (std::size_t i = 0; i < mix_classes.size(); ++i) {
    columns.push_back(column<std::int64_t>(std::string("mix_") + mix_classes[i], "", frames,
                                           [i](Frame f) { return f.mix[i]; }));
  }
  for (std::size_t i = 0; i < value_classes.size(); ++i) {
    const std::string prefix = std::string(value_classes[i]) + "_";
    const auto add_count = [&](const char* name, std::int64_t ClassHits::*number) {
      columns.push_back(
          column<std::int64_t>(prefix + name, "", frames, [=](Frame f) { return f.hits[i].*number; }));
    };
    add_count("executed", &ClassHits::executed);
    add_count("repeated", &ClassHits::repeated);
    add_count("exact", &ClassHits::exact);
    add_count("fuzzy", &ClassHits::fuzzy);
    add_count("wrong", &ClassHits::wrong);
    columns.push_back(
        column<double>(prefix + "error_sum", "", frames, [=](Frame f) { return f.hits[i].error_sum; }));
    columns.push_back(
        column<double>(prefix + "error_max", "", frames, [=](Frame f) { return f.hits[i].error_max; }));
  }
  return columns;
}

}  // namespace

std::vector<io::TableColumn> prediction_columns(const PredictionRows& rows) {
  using Case = const PredictionCase&;
  using Result = const PredictionResult&;
  const auto scene = [&](Case c) -> const StudyScene& {
    return rows.scenes[static_cast<std::size_t>(c.scene)];
  };
  const auto& cases = rows.cases;
  const auto& results = rows.results;
  std::vector<io::TableColumn> columns = {
      column<std::string>("scene", "", cases, [&](Case c) { return scene(c).source.name; }),
      column<std::string>("name", "", cases, [](Case c) { return c.name; }),
      column<std::int64_t>("worlds", "", cases, [&](Case c) { return scene(c).num_worlds; }),
      column<std::int64_t>("warmup", "", cases, [&](Case c) { return scene(c).warmup; }),
      column<std::int64_t>("frames", "", cases, [&](Case c) { return scene(c).frames; }),
      column<std::string>("stepper", "", cases, [](Case c) { return c.stepper; }),
      column<std::string>("precision", "", cases, [](Case c) { return c.precision; }),
      column<std::int64_t>("iterations", "", cases,
                           [](Case c) { return c.stepper == "quick" ? c.iterations : 0; }),
      column<std::int64_t>("feec", "", cases, [](Case c) { return c.feec ? 1 : 0; }),
      column<double>("threshold", "", cases, [](Case c) { return c.threshold; }),
      column<std::string>("scope", "", cases, [](Case c) { return c.scope; }),
      column<std::int64_t>("exit_code", "", results, [](Result r) { return r.exit_code; }),
      column<std::int64_t>("ended", "", results, [](Result r) { return r.ended; }),
      column<std::int64_t>("frames_done", "", results, [](Result r) { return r.num_frames; }),
      column<std::int64_t>("same_hash", "", results, [](Result r) { return r.same_hash; }),
      column<std::int64_t>("nonfinite_frame", "", results, [](Result r) { return r.nonfinite_frame; }),
      column<std::int64_t>("nonfinite_step", "", results, [](Result r) { return r.nonfinite_step; }),
      column<double>("islands_mean", "", results, [](Result r) { return r.islands_mean; }),
      column<double>("islands_max", "", results, [](Result r) { return r.islands_max; }),
      column<double>("base_islands_mean", "", results, [](Result r) { return r.base_islands_mean; }),
      column<std::int64_t>("errors_known", "", results, [](Result r) { return r.errors_known; }),
  };
  add_error_columns("defect", &PredictionResult::defect, results, columns);
  add_error_columns("drift", &PredictionResult::drift, results, columns);
  add_error_columns("floor", &PredictionResult::floor, results, columns);
  return columns;
}

std::map<std::string, std::vector<io::TableColumn>> prediction_tables(const PredictionRows& rows) {
  using Row = const VariantCycles&;
  const auto& variants = rows.variants;
  const auto variant = [](Row r) -> const ModelVariant& {
    return model_variants()[static_cast<std::size_t>(r.variant)];
  };
  std::map<std::string, std::vector<io::TableColumn>> tables;
  tables["frames"] = frame_columns(rows.frames);
  tables["sensitivity"] = {
      column<std::int64_t>("case", "", variants, [](Row r) { return r.case_index; }),
      column<std::string>("variant", "", variants, [&](Row r) { return variant(r).name; }),
      column<std::string>("settings", "", variants, [&](Row r) { return variant(r).settings; }),
      column<std::int64_t>("cycles", "", variants, [](Row r) { return r.cycles; }),
      column<std::int64_t>("predicted_cycles", "", variants, [](Row r) { return r.predicted_cycles; }),
  };
  return tables;
}

}  // namespace pbmpi::app
