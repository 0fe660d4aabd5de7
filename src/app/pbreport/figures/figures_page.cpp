#include "app/pbreport/figures/figures_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/common/format.h"
#include "app/common/json_text.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

constexpr std::array<const char*, 7> method_colours = {"#3d4650", "#0072b2", "#56b4e9", "#009e73",
                                                       "#e69f00", "#cc79a7", "#d55e00"};
constexpr std::array<const char*, analysis::num_bands> band_colours = {"#009e73", "#f0e442", "#e69f00",
                                                                       "#d55e00", "#000000"};

std::vector<std::string> scene_names(const std::vector<FigureScene>& scenes) {
  std::vector<std::string> names;
  names.reserve(scenes.size());
  for (const FigureScene& scene : scenes) names.push_back(scene.name);
  return names;
}

/// One number per scene; null where a scene lacks the method.
template <class Number>
ChartJson per_scene(const std::vector<FigureScene>& scenes, const std::string& label, Number&& number) {
  ChartJson values = ChartJson::array();
  for (const FigureScene& scene : scenes) {
    const FigureMethod* method = scene.find(label);
    values.push_back(method == nullptr ? ChartJson() : ChartJson(number(*method)));
  }
  return values;
}

io::html::Chart bars(const std::vector<FigureScene>& scenes, const char* title, const char* text,
                     const char* axis, bool logarithmic, double (*number)(const FigureMethod&)) {
  ChartJson datasets = ChartJson::array();
  std::size_t colour = 0;
  for (const std::string& label : method_labels(scenes)) {
    datasets.push_back({{"label", label},
                        {"data", per_scene(scenes, label, number)},
                        {"backgroundColor", method_colours[colour++ % method_colours.size()]}});
  }
  ChartJson y = {{"type", logarithmic ? "logarithmic" : "linear"},
                 {"title", {{"display", true}, {"text", axis}}}};
  if (std::string_view(axis) == "%") y["max"] = 100;
  const ChartJson config = {{"type", "bar"},
                            {"data", {{"labels", scene_names(scenes)}, {"datasets", datasets}}},
                            {"options", {{"scales", {{"y", y}}}}}};
  return {title, text, json_text(config)};
}

double share(const analysis::ErrorSummary& errors, std::size_t band) {
  return errors.count == 0
             ? 0
             : 100 * static_cast<double>(errors.bands[band]) / static_cast<double>(errors.count);
}

/// The mean share over the floor runs.
double floor_share(const FigureScene& scene, const analysis::NamedSummary& column, std::size_t band) {
  double sum = 0;
  for (const analysis::ErrorTable& table : scene.floor) sum += share(table.*column.summary, band);
  return scene.floor.empty() ? 0 : sum / static_cast<double>(scene.floor.size());
}

/// One stack of five categories per method and scene. Iter20 is left out: it is the reference.
io::html::Chart panel(const std::vector<FigureScene>& scenes, const char* title,
                      const analysis::NamedSummary& column,
                      const std::array<std::string_view, analysis::num_bands>& names) {
  std::vector<std::string> labels = method_labels(scenes);
  std::erase(labels, "Iter20");
  std::string order;
  for (const std::string& label : labels) order += label + ", ";
  ChartJson datasets = ChartJson::array();
  const auto add = [&](const std::string& stack, std::size_t band, ChartJson data) {
    datasets.push_back({{"label", stack + ": " + std::string(names[band])},
                        {"data", std::move(data)},
                        {"stack", stack},
                        {"backgroundColor", band_colours[band]}});
  };
  for (std::size_t band = 0; band < names.size(); ++band) {
    for (const std::string& label : labels) {
      add(label, band, per_scene(scenes, label, [&](const FigureMethod& m) {
            return share(m.errors.*column.summary, band);
          }));
    }
    ChartJson floor = ChartJson::array();
    for (const FigureScene& scene : scenes) floor.push_back(floor_share(scene, column, band));
    add("noise floor", band, std::move(floor));
  }
  ChartJson key = ChartJson::array();
  for (std::size_t band = 0; band < names.size(); ++band)
    key.push_back({{"label", names[band]}, {"shape", "bar"}, {"colour", band_colours[band]}});
  const ChartJson config = {
      {"type", "bar"},
      {"data", {{"labels", scene_names(scenes)}, {"datasets", datasets}}},
      {"options",
       {{"plugins", {{"legend", {{"display", false}}}, {"pbmpi", {{"key", std::move(key)}}}}},
        {"scales",
         {{"x", {{"stacked", true}}},
          {"y",
           {{"stacked", true}, {"max", 100}, {"title", {{"display", true}, {"text", "% of entries"}}}}}}}}}};
  return {title, "Bars of a scene, in this order: " + order + "noise floor.", json_text(config)};
}

io::html::TextTable rate_table(const std::vector<FigureScene>& scenes) {
  io::html::TextTable table{
      "Numbers",
      {"scene", "method", "frame rate Hz", "satisfied %", "ms", "Iter20 / delivery", "precise state", "runs"},
      {}};
  for (const FigureScene& scene : scenes) {
    for (const FigureMethod& method : scene.methods) {
      table.rows.push_back(
          {scene.name, method.label, format("%.1f", method.frame_rate_hz),
           format("%.0f", 100 * method.satisfied_fraction), format("%.3f", 1e3 * method.mean_frame_s),
           method.is_estimate ? format("%.2f", scene.ratio(method)) : "",
           method.same_hash ? "equal to Iter20's" : "another", std::to_string(method.num_runs)});
    }
  }
  return table;
}

io::html::TextTable error_table(const std::vector<FigureScene>& scenes, const analysis::NamedSummary& column,
                                const char* title,
                                const std::array<std::string_view, analysis::num_bands>& names) {
  io::html::TextTable table{title,
                            {"scene", "method", std::string("rms ") + column.unit,
                             std::string("p99 ") + column.unit, std::string("max ") + column.unit},
                            {}};
  for (const std::string_view name : names) table.header.emplace_back(name);
  const auto add = [&](const std::string& scene, const std::string& label,
                       const analysis::ErrorSummary& errors) {
    std::vector<std::string> row = {scene, label, format("%.3g", errors.rms), format("%.3g", errors.p99),
                                    format("%.3g", errors.max)};
    for (const std::int64_t count : errors.bands) row.push_back(std::to_string(count));
    table.rows.push_back(std::move(row));
  };
  for (const FigureScene& scene : scenes) {
    for (const FigureMethod& method : scene.methods) {
      if (method.label != "Iter20") add(scene.name, method.label, method.errors.*column.summary);
    }
    for (const analysis::ErrorTable& floor : scene.floor)
      add(scene.name, "another seed", floor.*column.summary);
  }
  return table;
}

std::string ratio_text(const std::vector<FigureScene>& scenes) {
  std::string text;
  for (const std::string& label : method_labels(scenes)) {
    const double ratio = mean_ratio(scenes, label);
    if (ratio > 0) {
      text +=
          (text.empty() ? "" : " ") + format("%s: %.2f (%+.0f %%).", label.c_str(), ratio, 100 * (ratio - 1));
    }
  }
  return "Mean over the scenes of the time of an Iter20 frame over the time until its estimate is "
         "delivered: " +
         text + " The paper: +220 %, i.e. 3.2.";
}

}  // namespace

std::vector<std::string> method_labels(const std::vector<FigureScene>& scenes) {
  std::vector<std::string> labels;
  for (const FigureScene& scene : scenes) {
    for (const FigureMethod& method : scene.methods) {
      if (std::find(labels.begin(), labels.end(), method.label) == labels.end())
        labels.push_back(method.label);
    }
  }
  return labels;
}

double mean_ratio(const std::vector<FigureScene>& scenes, const std::string& label) {
  double sum = 0;
  int count = 0;
  for (const FigureScene& scene : scenes) {
    const FigureMethod* method = scene.find(label);
    if (method == nullptr || !method->is_estimate) continue;
    sum += scene.ratio(*method);
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

io::html::ChartPage figures_page(const std::vector<FigureScene>& scenes) {
  io::html::PageSection rates;
  rates.title = "Figure 8: frame rate, and frames within the budget of 3.33 ms";
  rates.text = ratio_text(scenes) +
               "\n\nThe rate of an estimate is that of its deliveries: what consumers see. The "
               "precise result follows later in the same frame.";
  rates.charts = {bars(scenes, "Frame rate", "Harmonic mean of the measured frames [Hz], logarithmic.", "Hz",
                       true, [](const FigureMethod& m) { return m.frame_rate_hz; }),
                  bars(scenes, "Satisfied", "Frames, or deliveries, within the budget [%].", "%", false,
                       [](const FigureMethod& m) { return 100 * m.satisfied_fraction; })};
  rates.tables = {rate_table(scenes)};

  io::html::PageSection errors;
  errors.title = "Figure 9: errors against 20 iterations";
  errors.text =
      "Iter19 and Iter1: drift. FEEC: of the delivered estimates; since their precise run is Iter20's bit "
      "for bit, this "
      "is the defect of the estimator, and the drift of what FEEC goes on from is zero. The last bar is the "
      "noise floor: "
      "20 iterations with other solver seeds. A method whose bar looks like that one is as good as can be "
      "told.\n\n"
      "The shortest rotation is at most half "
      "a turn, so that the orientation category beyond 50 % stays empty.";
  const auto& columns = analysis::error_columns;
  errors.charts = {
      panel(scenes, "Geometric, position", columns[0], analysis::position_band_names),
      panel(scenes, "Geometric, orientation", columns[1], analysis::orientation_band_names),
      panel(scenes, "Constraint, position", columns[2], analysis::position_band_names),
      panel(scenes, "Constraint, orientation", columns[3], analysis::orientation_band_names),
  };
  errors.tables = {
      error_table(scenes, columns[0], "Geometric, position", analysis::position_band_names),
      error_table(scenes, columns[1], "Geometric, orientation", analysis::orientation_band_names),
      error_table(scenes, columns[2], "Constraint, position (anchor gap)", analysis::position_band_names),
      error_table(scenes, columns[3], "Constraint, orientation (axis angle)",
                  analysis::orientation_band_names),
  };
  return {"Fast estimation with error control",
          "Figures 8 and 9 of Yeh, Faloutsos, Reinman 2006",
          {rates, errors}};
}

}  // namespace pbmpi::app
