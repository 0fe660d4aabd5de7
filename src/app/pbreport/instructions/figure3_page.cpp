#include "app/pbreport/instructions/figure3_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

constexpr double million = 1e6;

std::string percent(double share) { return format("%.0f %%", 100 * share); }

std::string millions(double instructions) { return format("%.4g", instructions / million); }

/// "40 (20 to 80), extrapolated" in millions, or the count.
std::string direct_text(const std::optional<DirectCost>& cost) {
  if (!cost) return "not counted";
  if (cost->is_counted) return millions(cost->middle);
  return millions(cost->middle) + " (" + millions(cost->least) + " to " + millions(cost->most) +
         "), extrapolated";
}

std::string law_text(const std::optional<CubicCost>& cost) {
  if (!cost) return "";
  return format(
      "Where direct was not counted its solver is taken to need %.3g instructions (%.3g to %.3g, by %d "
      "counted "
      "scenes with an island of at least %d rows) for each cubed row of an island, over all islands of a "
      "frame's steps, from their recorded rows; collision detection is quick's.",
      cost->middle, cost->least, cost->most, cost->num_scenes, leading_rows);
}

io::html::Chart bars(const std::vector<CountedScene>& scenes, const std::vector<IslandWork>& works) {
  const auto cost = counted_cost(scenes, works);
  ChartJson labels = ChartJson::array(), quick = ChartJson::array(), direct = ChartJson::array(),
            extrapolated = ChartJson::array();
  for (const CountedScene& scene : scenes) {
    labels.push_back(scene.name);
    quick.push_back(scene.quick ? ChartJson(scene.quick->per_frame / million) : ChartJson());
    const auto of_direct = direct_cost(scene, cost, works);
    const ChartJson value = of_direct ? ChartJson(of_direct->middle / million) : ChartJson();
    direct.push_back(of_direct && of_direct->is_counted ? value : ChartJson());
    extrapolated.push_back(of_direct && !of_direct->is_counted ? value : ChartJson());
  }
  ChartJson datasets = {{{"label", "quick"}, {"data", quick}, {"backgroundColor", "#0072b2"}},
                        {{"label", "direct"}, {"data", direct}, {"backgroundColor", "#d55e00"}}};
  if (std::ranges::any_of(extrapolated, [](const ChartJson& value) { return !value.is_null(); }))
    datasets.push_back(
        {{"label", "direct, extrapolated"}, {"data", extrapolated}, {"backgroundColor", "#e69f00"}});
  const ChartJson config = {
      {"type", "bar"},
      {"data", {{"labels", labels}, {"datasets", datasets}}},
      {"options",
       {{"scales",
         {{"y",
           {{"type", "logarithmic"}, {"title", {{"display", true}, {"text", "million instructions"}}}}}}}}}};
  return {"Instructions of a frame", "Millions, logarithmic; mean of the measured frames.",
          json_text(config)};
}

std::vector<std::string> mix_cells(const InstructionMix& mix) {
  std::vector<std::string> cells;
  for (const double share : mix) cells.push_back(percent(share));
  return cells;
}

std::vector<std::string> row_of(const std::string& scene, const std::string& stepper,
                                const std::string& instructions, const InstructionMix& mix,
                                const std::string& collision) {
  std::vector<std::string> row = {scene, stepper, instructions};
  for (std::string& cell : mix_cells(mix)) row.push_back(std::move(cell));
  row.push_back(collision);
  return row;
}

std::vector<std::string> row_of(const CountedScene& scene, const char* stepper,
                                const InstructionCounts& counts) {
  return row_of(scene.name, stepper, millions(counts.per_frame), counts.mix, percent(counts.collision_share));
}

io::html::TextTable table_of(const std::vector<CountedScene>& scenes, const std::vector<IslandWork>& works) {
  io::html::TextTable table{"Numbers", {"scene", "stepper", "millions"}, {}};
  for (const char* name : mix_names) table.header.emplace_back(name);
  table.header.emplace_back("collision");
  const auto cost = counted_cost(scenes, works);
  std::vector<InstructionMix> mixes;
  std::vector<double> shares;
  for (const CountedScene& scene : scenes) {
    if (scene.quick) {
      table.rows.push_back(row_of(scene, "quick", *scene.quick));
      mixes.push_back(scene.quick->mix);
      shares.push_back(scene.quick->collision_share);
    }
    if (scene.direct) {
      table.rows.push_back(row_of(scene, "direct", *scene.direct));
    } else {
      std::vector<std::string> row(table.header.size());
      row[0] = scene.name;
      row[1] = "direct";
      row[2] = direct_text(direct_cost(scene, cost, works));
      table.rows.push_back(std::move(row));
    }
  }
  table.rows.push_back(row_of("all", "quick", "", mean_mix(mixes), percent(core::summarize(shares).mean)));
  table.rows.push_back(row_of("paper", "", "", paper_mix, "7 % (2 to 20 %)"));
  return table;
}

}  // namespace

io::html::PageSection figure3_section(const std::vector<CountedScene>& scenes,
                                      const std::vector<IslandWork>& works) {
  io::html::PageSection section;
  section.title = "Figure 3: instructions of a frame";
  section.text =
      "Inside the stepper, counted by callgrind. An instruction counts as what it computes, its access to "
      "memory "
      "besides as a load or a store. The paper prints the figure without numbers; its text says that quick "
      "takes "
      "far fewer instructions than direct. It counts single-precision code of 2006, this is double "
      "precision.";
  const std::string law = law_text(counted_cost(scenes, works));
  if (!law.empty()) section.text += "\n\n" + law;
  section.charts = {bars(scenes, works)};
  section.tables = {table_of(scenes, works)};
  return section;
}

std::string figure3_text(const std::vector<CountedScene>& scenes, const std::vector<IslandWork>& works) {
  std::string text;
  const auto cost = counted_cost(scenes, works);
  const auto add = [&](const CountedScene& scene, const char* stepper, const InstructionCounts& counts) {
    text += format("%-8s %-6s %10.2f M a frame;", scene.name.c_str(), stepper, counts.per_frame / million);
    for (std::size_t i = 0; i < mix_names.size(); ++i)
      text += format("%s %s %s", i == 0 ? "" : ",", mix_names[i], percent(counts.mix[i]).c_str());
    text += "; collision " + percent(counts.collision_share) + "\n";
  };
  for (const CountedScene& scene : scenes) {
    if (scene.quick) add(scene, "quick", *scene.quick);
    if (scene.direct) {
      add(scene, "direct", *scene.direct);
    } else if (const auto estimated = direct_cost(scene, cost, works)) {
      text += format("%-8s %-6s ", scene.name.c_str(), "direct") + direct_text(estimated) + " M a frame\n";
    }
  }
  const std::string law = law_text(cost);
  return law.empty() ? text : text + law + "\n";
}

}  // namespace pbmpi::app
