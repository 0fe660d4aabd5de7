#include "app/pbreport/paper/paper_page.h"

#include <nlohmann/json.hpp>

#include "app/common/json_text.h"
#include "app/pbreport/figures/figures_page.h"
#include "app/pbreport/instructions/figure3_page.h"
#include "app/pbreport/paper/paper_text.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

constexpr std::array<const char*, finding_names.size()> finding_colours = {"#009e73", "#d55e00", "#8a949e"};

io::html::Chart findings_chart(const std::vector<Chapter>& chapters) {
  ChartJson labels = ChartJson::array(), datasets = ChartJson::array();
  for (const Chapter& chapter : chapters) labels.push_back(chapter.name);
  for (std::size_t i = 0; i < finding_names.size(); ++i) {
    ChartJson counts = ChartJson::array();
    for (const Chapter& chapter : chapters) counts.push_back(count_findings(chapter.statements)[i]);
    datasets.push_back(
        {{"label", finding_names[i]}, {"data", counts}, {"backgroundColor", finding_colours[i]}});
  }
  const ChartJson config = {
      {"type", "bar"},
      {"data", {{"labels", labels}, {"datasets", datasets}}},
      {"options",
       {{"scales",
         {{"x", {{"stacked", true}}},
          {"y", {{"stacked", true}, {"title", {{"display", true}, {"text", "statements"}}}}}}}}}};
  return {"Verdicts", "Statements of each part of the paper.", json_text(config)};
}

io::html::PageSection overview(const std::vector<Chapter>& chapters) {
  io::html::PageSection section;
  section.title = "Verdicts";
  section.text =
      "Each statement of the paper with the rule by which it counts as confirmed, which was set before the "
      "number "
      "was known, and what was measured. What rests on a clock is of the machine and the day in the foot of "
      "this "
      "page; what rests on counts is the same in each run.\n\nThe scenes are built to the paper's "
      "description, "
      "which has no parameters, and their islands to its Table 1: that this table is met says that such "
      "scenes "
      "exist. ODE here is version 0.16 in double precision, with a simple or a sweep-and-prune space; the "
      "paper "
      "ran it in single precision with a hash space on a Pentium 4 Xeon of 2.4 GHz, and on a modelled "
      "processor "
      "of 3 GHz. A car's wheels hang on hinge2 joints with a suspension instead of four sliders.";
  section.charts = {findings_chart(chapters)};
  return section;
}

io::html::PageSection section_of(const Chapter& chapter) {
  io::html::PageSection section;
  section.title = chapter.title;
  io::html::TextTable table{"Statements", statement_header(), {}};
  for (const PaperStatement& statement : chapter.statements) table.rows.push_back(statement_cells(statement));
  section.tables = {std::move(table)};
  return section;
}

/// Figure 6: serial rate, and the rate with a core for each island, then also for each space.
io::html::PageSection rates_section(const std::vector<SuiteRun>& suite) {
  struct Bar {
    const char* label;
    Rate CoreSummary::*rate;
    const char* colour;
  };
  constexpr std::array<Bar, 3> bars = {{{"serial", &CoreSummary::serial, "#0072b2"},
                                        {"islands in parallel", &CoreSummary::islands_parallel, "#e69f00"},
                                        {"and spaces", &CoreSummary::spaces_parallel, "#009e73"}}};
  ChartJson labels = ChartJson::array(), datasets = ChartJson::array();
  for (const SuiteRun& run : suite) labels.push_back(run.islands.scene);
  for (const Bar& bar : bars) {
    ChartJson rates = ChartJson::array();
    for (const SuiteRun& run : suite) rates.push_back((run.cores.*bar.rate).harmonic_mean_hz);
    datasets.push_back({{"label", bar.label}, {"data", rates}, {"backgroundColor", bar.colour}});
  }
  const ChartJson budget = {{{"from", 300}, {"to", 300}, {"label", "budget [Hz]"}, {"colour", "#d55e00"}}};
  const ChartJson config = {
      {"type", "bar"},
      {"data", {{"labels", labels}, {"datasets", datasets}}},
      {"options",
       {{"plugins", {{"pbmpi", {{"bands", budget}}}}},
        {"scales", {{"y", {{"type", "logarithmic"}, {"title", {{"display", true}, {"text", "Hz"}}}}}}}}}};
  io::html::PageSection section;
  section.title = "Figure 6: frame rates";
  section.text =
      "One core; an unlimited number of cores for islands, then also for spaces, without overheads.";
  section.charts = {
      {"Frame rate", "Harmonic mean of the measured frames [Hz], logarithmic.", json_text(config)}};
  return section;
}

}  // namespace

io::html::ChartPage paper_page(const std::vector<Chapter>& chapters, const PaperData& data) {
  io::html::ChartPage page{"The paper, statement by statement",
                           "Yeh, Faloutsos, Reinman: Enabling Real-Time Physics Simulation in Future "
                           "Interactive Entertainment, 2006",
                           {overview(chapters)}};
  for (const Chapter& chapter : chapters) page.sections.push_back(section_of(chapter));
  if (!data.counts.empty()) page.sections.push_back(figure3_section(data.counts, data.works()));
  if (!data.suite.empty()) page.sections.push_back(rates_section(data.suite));
  if (!data.figures.empty()) {
    for (io::html::PageSection& section : figures_page(data.figures).sections)
      page.sections.push_back(std::move(section));
  }
  return page;
}

}  // namespace pbmpi::app
