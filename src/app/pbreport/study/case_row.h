/// Reads the cases of a study's file for its report.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "analysis/error_table.h"
#include "core/error.h"
#include "io/table/table_file.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

/// Row `index` of /cases.
class CaseRow {
 public:
  CaseRow(const io::TableFile& file, std::size_t index) : file_(&file), index_(index) {}
  bool has(const std::string& name) const { return file_->has_column("cases", name); }
  double real(const std::string& name) const { return file_->column<double>("cases", name)[index_]; }
  int integer(const std::string& name) const {
    return static_cast<int>(file_->column<std::int64_t>("cases", name)[index_]);
  }
  std::string text(const std::string& name) const {
    return file_->column<std::string>("cases", name)[index_];
  }
  /// The settings of a step, as far as the file has columns for them.
  stepping::StepperSettings step_settings() const {
    // Files without a law have its parts, of which relaxing sweeps tell the two laws apart; files of the
    // first versions had neither, and steps of ODE's equations only.
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::quick);
    if (has("relax") && integer("relax") > 0) settings.law = {};
    for (const stepping::StepOption& option : stepping::step_options()) {
      const std::string name = file_name(option);
      if (!has(name)) continue;
      const auto of_type = [&]<class Value>(const Value&) -> stepping::StepValue {
        return file_->column<Value>("cases", name)[index_];
      };
      restore(option, std::visit(of_type, value_of(option, settings)), settings);
    }
    return settings;
  }
  analysis::BandCounts bands(const std::string& name) const {
    analysis::BandCounts counts{};
    const auto& all = file_->column<std::int64_t>("cases", name);
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(index_ * counts.size()), counts.size(),
                counts.begin());
    return counts;
  }
  analysis::ErrorTable errors(const std::string& prefix) const {
    analysis::ErrorTable table;
    for (const analysis::NamedSummary& named : analysis::error_columns) {
      const std::string name = prefix + "_" + named.name + "_";
      analysis::ErrorSummary& summary = table.*named.summary;
      summary.rms = real(name + "rms");
      summary.p99 = real(name + "p99");
      summary.max = real(name + "max");
      summary.bands = bands(name + "bands");
      if (has(name + "broken"))  // since version 1.4
        summary.broken = file_->column<std::int64_t>("cases", name + "broken")[index_];
      summary.count = std::accumulate(summary.bands.begin(), summary.bands.end(), summary.broken);
    }
    return table;
  }

 private:
  const io::TableFile* file_;
  std::size_t index_;
};

/// The scenes (each has a `name`) in the order of `names`; empty: all. Throws core::InputError for a scene
/// that is not in the study.
template <class Scene>
std::vector<Scene> chosen_scenes(const std::vector<Scene>& scenes, const std::vector<std::string>& names) {
  if (names.empty()) return scenes;
  std::vector<Scene> chosen;
  std::string known;
  for (const Scene& scene : scenes) {
    if (known.find(" " + scene.name + ",") == std::string::npos) known += " " + scene.name + ",";
  }
  known.pop_back();
  for (const std::string& name : names) {
    const std::size_t before = chosen.size();
    std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(chosen),
                 [&](const Scene& scene) { return scene.name == name; });
    core::require_input(chosen.size() > before, "--scene " + name + ": the study has" + known);
  }
  return chosen;
}

}  // namespace pbmpi::app
