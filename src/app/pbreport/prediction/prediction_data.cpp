#include "app/pbreport/prediction/prediction_data.h"

#include <algorithm>

#include "app/common/format.h"
#include "app/pbreport/study/case_row.h"
#include "app/pbreport/study/study_file.h"

namespace pbmpi::app {
namespace {

constexpr std::array<const char*, 5> mix_columns = {"mix_floating_point", "mix_integer", "mix_branch",
                                                    "mix_store", "mix_load"};

/// Rows of /frames.
class Frames {
 public:
  explicit Frames(const io::TableFile& file) : file_(file) {}
  std::int64_t count(const std::string& name, std::size_t row) const {
    return file_.column<std::int64_t>("frames", name)[row];
  }
  double real(const std::string& name, std::size_t row) const {
    return file_.column<double>("frames", name)[row];
  }
  /// The frames of a case that count: measured ones, and with FEEC the estimates.
  std::vector<std::size_t> of(std::size_t index, int warmup, bool feec) const {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < file_.column<std::int64_t>("frames", "case").size(); ++i) {
      if (count("case", i) == static_cast<std::int64_t>(index) && count("frame", i) >= warmup &&
          (count("is_estimate", i) != 0) == feec)
        rows.push_back(i);
    }
    return rows;
  }

 private:
  const io::TableFile& file_;
};

HitCounts hits_of(const Frames& frames, const std::vector<std::size_t>& rows,
                  const std::string& value_class) {
  HitCounts hits;
  for (const std::size_t row : rows) {
    hits.executed += static_cast<double>(frames.count(value_class + "_executed", row));
    hits.exact += static_cast<double>(frames.count(value_class + "_exact", row));
    hits.fuzzy += static_cast<double>(frames.count(value_class + "_fuzzy", row));
    hits.wrong += static_cast<double>(frames.count(value_class + "_wrong", row));
    hits.error_sum += frames.real(value_class + "_error_sum", row);
    hits.error_max = std::max(hits.error_max, frames.real(value_class + "_error_max", row));
  }
  return hits;
}

FrameRate rate_of(const Frames& frames, const std::vector<std::size_t>& rows, const std::string& column,
                  double budget_s) {
  double time_s = 0, satisfied = 0;
  for (const std::size_t row : rows) {
    if (frames.count(column, row) < 0) return {};
    const double frame_s = static_cast<double>(frames.count(column, row)) / processor_hz;
    time_s += frame_s;
    if (frame_s <= budget_s) ++satisfied;
  }
  if (rows.empty()) return {};
  const auto num = static_cast<double>(rows.size());
  return {num / time_s, satisfied / num};
}

void count_instructions(const Frames& frames, const std::vector<std::size_t>& rows, PredictionRun& run) {
  double all = 0, collision = 0, operations = 0;
  for (const std::size_t row : rows) {
    all += static_cast<double>(frames.count("instructions", row));
    collision += static_cast<double>(frames.count("collision_instructions", row));
    for (std::size_t i = 0; i < run.mix.size(); ++i) {
      run.mix[i] += static_cast<double>(frames.count(mix_columns[i], row));
      operations += static_cast<double>(frames.count(mix_columns[i], row));
    }
  }
  if (rows.empty()) return;
  for (double& share : run.mix) share /= operations;
  run.instructions = all / static_cast<double>(rows.size());
  run.collision_share = collision / all;
}

PredictionRun read_run(const CaseRow& row, const Frames& frames, std::size_t index, double budget_s) {
  PredictionRun run;
  run.name = row.text("name");
  run.stepper = row.text("stepper");
  run.precision = row.has("precision") ? row.text("precision") : "double";
  run.scope = row.text("scope");
  run.threshold = row.real("threshold");
  run.feec = row.integer("feec") != 0;
  run.ended = row.integer("ended") != 0;
  run.same_hash = row.integer("same_hash") != 0;
  run.errors_known = row.integer("errors_known") != 0;
  run.exit_code = row.integer("exit_code");
  run.frames_done = row.integer("frames_done");
  run.nonfinite_frame = row.integer("nonfinite_frame");
  run.nonfinite_step = row.integer("nonfinite_step");
  run.islands = row.real("islands_mean");
  run.base_islands = row.real("base_islands_mean");
  const std::vector<std::size_t> rows = frames.of(index, row.integer("warmup"), run.feec);
  run.measured = static_cast<int>(rows.size());
  count_instructions(frames, rows, run);
  run.loads = hits_of(frames, rows, "fp_load");
  run.operations = hits_of(frames, rows, "fp_operation");
  run.unpredicted = rate_of(frames, rows, "cycles", budget_s);
  run.predicted = rate_of(frames, rows, "predicted_cycles", budget_s);
  run.defect_rms = row.real("defect_body_position_rms");
  run.drift_rms = row.real("drift_body_position_rms");
  run.floor_rms = row.real("floor_body_position_rms");
  run.defect_bands = row.bands("defect_body_position_bands");
  run.drift_bands = row.bands("drift_body_position_bands");
  run.floor_bands = row.bands("floor_body_position_bands");
  return run;
}

double real_parameter(const io::TableFile& file, const std::string& name) {
  const std::string text = text_parameter(file, name, "");
  core::require_input(!text.empty(),
                      "the study has no parameter " + name + "; make it anew with this version");
  return std::stod(text);
}

std::vector<Sensitivity> read_sensitivity(const io::TableFile& file, const std::vector<std::string>& names) {
  std::vector<Sensitivity> all;
  const auto& cases = file.column<std::int64_t>("sensitivity", "case");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseRow row(file, static_cast<std::size_t>(cases[i]));
    if (!names.empty() && std::ranges::find(names, row.text("scene")) == names.end()) continue;
    all.push_back({row.text("scene"), row.text("name"), file.column<std::string>("sensitivity", "variant")[i],
                   static_cast<double>(file.column<std::int64_t>("sensitivity", "cycles")[i]),
                   static_cast<double>(file.column<std::int64_t>("sensitivity", "predicted_cycles")[i])});
  }
  return all;
}

}  // namespace

HitCounts PredictionRun::all() const {
  return {loads.executed + operations.executed,   loads.exact + operations.exact,
          loads.fuzzy + operations.fuzzy,         loads.wrong + operations.wrong,
          loads.error_sum + operations.error_sum, std::max(loads.error_max, operations.error_max)};
}

const PredictionRun* PredictionScene::find(const std::string& run) const {
  const auto found = std::ranges::find(runs, run, &PredictionRun::name);
  return found == runs.end() ? nullptr : &*found;
}

PredictionStudy prediction_study(const io::TableFile& file, const std::vector<std::string>& names) {
  PredictionStudy study;
  study.budget_s = real_parameter(file, "budget_s");
  const Frames frames(file);
  for (std::size_t i = 0; i < file.column<std::string>("cases", "scene").size(); ++i) {
    const CaseRow row(file, i);
    auto scene = std::ranges::find(study.scenes, row.text("scene"), &PredictionScene::name);
    if (scene == study.scenes.end()) {
      scene = study.scenes.insert(
          scene,
          {row.text("scene"), row.integer("worlds"), row.integer("warmup"), row.integer("frames"), {}});
    }
    scene->runs.push_back(read_run(row, frames, i, study.budget_s));
    if (study.fvp.empty() && row.text("name").starts_with("FEEC+")) study.fvp = row.text("name").substr(5);
  }
  study.scenes = chosen_scenes(study.scenes, names);
  study.sensitivity = read_sensitivity(file, names);
  return study;
}

std::vector<EngineHits> engine_hits(const PredictionScene& scene, const std::string& fvp) {
  std::vector<EngineHits> all;
  const auto add = [&](const std::string& engine, const PredictionRun* exact, const PredictionRun* fuzzy) {
    if (exact != nullptr && fuzzy != nullptr)
      all.push_back({engine, exact->all(), fuzzy->all(), fuzzy->measured});
  };
  add("quick single", scene.find("single"), scene.find("single " + fvp));
  add("quick double", &scene.base(), scene.find(fvp));
  add("sor", scene.find("sor"), scene.find("sor " + fvp));
  return all;
}

std::vector<Bar> figure_8(const PredictionScene& scene, const std::string& fvp) {
  const PredictionRun &base = scene.base(), &less = scene.runs.at(1);
  std::vector<Bar> bars = {{base.name, base.unpredicted, &base}, {less.name, less.unpredicted, &less}};
  const auto add = [&](const std::string& name, bool is_predicted) {
    const PredictionRun* run = scene.find(name);
    bars.push_back({name,
                    run == nullptr ? FrameRate{}
                    : is_predicted ? run->predicted
                                   : run->unpredicted,
                    run});
  };
  add("FEEC", false);
  add(fvp, true);
  bars.push_back({"EVP", base.predicted, &base});
  add("FEEC+" + fvp, true);
  return bars;
}

}  // namespace pbmpi::app
