/// Turns rows of results into columns of a study's file.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbstudy/study/study_scene.h"
#include "io/table/table_file.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

/// How a file stores values of a type: whole numbers (and yes or no), real numbers, or texts.
template <class Value>
using Stored = std::conditional_t<std::is_floating_point_v<Value>, double,
                                  std::conditional_t<std::is_integral_v<Value>, std::int64_t, std::string>>;

/// A column of what `get`, a function or a member, gives of each row.
template <class Rows, class Get>
io::TableColumn column(const std::string& name, const std::string& unit, const Rows& rows, Get&& get) {
  using Value = Stored<std::decay_t<std::invoke_result_t<Get&, const typename Rows::value_type&>>>;
  std::vector<Value> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(static_cast<Value>(std::invoke(get, row)));
  return {name, unit, std::move(values)};
}

/// A column of the arrays that `get` gives of each row.
template <class Rows, class Get>
io::TableColumn wide_column(const std::string& name, const std::string& unit, const Rows& rows, Get&& get) {
  using Numbers = std::decay_t<std::invoke_result_t<Get&, const typename Rows::value_type&>>;
  constexpr std::size_t width = std::tuple_size_v<Numbers>;
  std::vector<Stored<typename Numbers::value_type>> values;
  values.reserve(width * rows.size());
  for (const auto& row : rows) {
    const Numbers& numbers = std::invoke(get, row);
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  return {name, unit, std::move(values), width};
}

/// A column of what is known of each case's scene.
template <class Case, class Get>
io::TableColumn scene_column(const std::string& name, const std::vector<StudyScene>& scenes,
                             const std::vector<Case>& cases, Get&& get) {
  return column(name, "", cases, [&](const Case& one) {
    return std::invoke(get, scenes[static_cast<std::size_t>(one.scene)]);
  });
}

/// The value of a step option in the settings of each case.
template <class Case>
io::TableColumn step_column(const stepping::StepOption& option, const std::vector<Case>& cases) {
  const auto of_type = [&](auto type) {
    return column(file_name(option), option.unit, cases,
                  [&](const Case& one) { return std::get<decltype(type)>(value_of(option, one.stepper)); });
  };
  return std::visit(of_type, value_of(option, stepping::StepperSettings{}));
}

/// "--stepper sor --dt 0.01 ...": the words on pbmpi's command line that give this setting.
inline std::string options_text(const stepping::StepperSettings& settings) {
  std::string text;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.in_studies && fits(option, settings.kind))
      text += (text.empty() ? "--" : " --") + std::string(option.name) + " " + given_text(option, settings);
  }
  return text;
}

/// One column for each step option that is part of a setting (and the solver's seed), from the settings of
/// each case, then these settings in short, unless there is a column `setting`, and as options of pbmpi.
template <class Case>
void add_step_columns(const std::vector<Case>& cases, std::vector<io::TableColumn>& columns) {
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.in_studies || option.name == "solver-seed") columns.push_back(step_column(option, cases));
  }
  const auto is_setting = [](const io::TableColumn& one) { return one.name == "setting"; };
  if (std::ranges::none_of(columns, is_setting))
    columns.push_back(
        column("setting", "", cases, [](const Case& one) { return stepping::setting_text(one.stepper); }));
  columns.push_back(column("options", "", cases, [](const Case& one) { return options_text(one.stepper); }));
}

/// Columns "PREFIX_body_position_rms", _median, _p90, _p99, _max and so on, for the ErrorTable that `table`
/// points to in each result.
template <class Result>
void add_errors(const std::string& prefix, analysis::ErrorTable Result::*table,
                const std::vector<Result>& results, std::vector<io::TableColumn>& columns) {
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    const std::string name = prefix + "_" + named.name + "_";
    const auto add = [&](const char* what, double analysis::ErrorSummary::*number) {
      columns.push_back(column(name + what, named.unit, results,
                               [&](const Result& result) { return result.*table.*named.summary.*number; }));
    };
    add("rms", &analysis::ErrorSummary::rms);
    add("median", &analysis::ErrorSummary::median);
    add("p90", &analysis::ErrorSummary::p90);
    add("p99", &analysis::ErrorSummary::p99);
    add("max", &analysis::ErrorSummary::max);
    columns.push_back(wide_column(name + "bands", "", results, [&](const Result& result) {
      return (result.*table.*named.summary).bands;
    }));
    if (!std::string_view(named.name).starts_with("joint")) continue;
    columns.push_back(column(name + "broken", "", results,
                             [&](const Result& result) { return (result.*table.*named.summary).broken; }));
  }
}

}  // namespace pbmpi::app
