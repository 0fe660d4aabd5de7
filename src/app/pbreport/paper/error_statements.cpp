#include <algorithm>
#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/paper/figure_scenes.h"
#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {
namespace {

double share_of_band(const analysis::ErrorSummary& errors, std::size_t band) {
  return errors.count == 0 ? 0 : static_cast<double>(errors.bands[band]) / static_cast<double>(errors.count);
}

/// Share of positions that are off by 1 cm or more, or not finite.
double share_beyond_1_cm(const analysis::ErrorSummary& errors) { return 1 - share_of_band(errors, 0); }

constexpr std::size_t worst_band = analysis::num_bands - 1;

double share_blown_up(const analysis::ErrorTable& errors) {
  double most = 0;
  for (const analysis::NamedSummary& column : analysis::error_columns)
    most = std::max(most, share_of_band(errors.*column.summary, worst_band));
  return most;
}

PaperStatement of_iteration_reduction(const PaperData& data) {
  PaperStatement statement{{"5.2.1", "fewer iterations drastically increase errors, which accumulate",
                            "one iteration has ten times the rms of 19 or more, in most scenes of Figure 9",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::counts,
                           by_figures,
                           "rms of positions against 20 iterations: 19; 1; another seed, on average"};
  SceneList rms;
  std::size_t drastic = 0;
  for (const FigureScene* scene : scenes_with(data, {"Iter19", "Iter1"})) {
    const double nineteen = scene->find("Iter19")->errors.body_position.rms,
                 one = scene->find("Iter1")->errors.body_position.rms;
    double floor = 0;
    for (const analysis::ErrorTable& seed : scene->floor)
      floor += seed.body_position.rms / static_cast<double>(scene->floor.size());
    rms.add(scene->name, format("%.3g; %.3g; %.3g mm", 1e3 * nineteen, 1e3 * one, 1e3 * floor));
    if (one >= 10 * nineteen) ++drastic;
  }
  statement.decide(2 * drastic > rms.size(), rms, figure_8_scenes.size());
  return statement;
}

PaperStatement of_19_iterations(const PaperData& data) {
  PaperStatement statement{
      {"5.4", "FEEC's errors are comparable to those of 19 iterations",
       "no category of positions differs by more than ten points, in most scenes of Figure 9",
       Finding::undecidable, not_measured},
      "-",
      Basis::counts,
      by_figures,
      "positions 1 cm or more off: FEEC's estimates, 19 iterations, other seeds. FEEC's are "
      "defects of a frame, those of 19 iterations drift, as large as another seed's"};
  SceneList shares;
  std::size_t comparable = 0;
  for (const FigureScene* scene : scenes_with(data, {"Iter19", feec_label})) {
    const analysis::ErrorSummary& feec = scene->find(feec_label)->errors.body_position;
    const analysis::ErrorSummary& nineteen = scene->find("Iter19")->errors.body_position;
    double most_apart = 0, floor = 0;
    for (std::size_t band = 0; band < analysis::num_bands; ++band)
      most_apart = std::max(most_apart, std::abs(share_of_band(feec, band) - share_of_band(nineteen, band)));
    for (const analysis::ErrorTable& seed : scene->floor)
      floor += share_beyond_1_cm(seed.body_position) / static_cast<double>(scene->floor.size());
    shares.add(scene->name, percent(share_beyond_1_cm(feec)) + ", " + percent(share_beyond_1_cm(nineteen)) +
                                ", " + (scene->floor.empty() ? "-" : percent(floor)));
    if (most_apart <= 0.1) ++comparable;
  }
  statement.decide(2 * comparable > shares.size(), shares, figure_8_scenes.size());
  return statement;
}

PaperStatement of_better_and_worse(const PaperData& data) {
  PaperStatement statement{
      {"5.4", "FEEC does sometimes better and sometimes worse than 19 iterations",
       "fewer positions 1 cm or more off in one scene of Figure 9 at least, more in another",
       Finding::undecidable, not_measured},
      "-",
      Basis::counts,
      by_figures,
      ""};
  SceneList better, worse;
  const auto scenes = scenes_with(data, {"Iter19", feec_label});
  for (const FigureScene* scene : scenes) {
    const double feec = share_beyond_1_cm(scene->find(feec_label)->errors.body_position),
                 nineteen = share_beyond_1_cm(scene->find("Iter19")->errors.body_position);
    if (feec < nineteen) better.add(scene->name, "");
    if (feec > nineteen) worse.add(scene->name, "");
  }
  if (scenes.empty()) return statement;
  statement.verdict.number = "better: " + (better.empty() ? "none" : better.text()) +
                             "; worse: " + (worse.empty() ? "none" : worse.text());
  statement.decide(!better.empty() && !worse.empty(), scenes.size(), figure_8_scenes.size());
  return statement;
}

PaperStatement of_few_blow_ups(const PaperData& data) {
  PaperStatement statement{{"5.4", "19 iterations and FEEC blow up in few cases",
                            "less than 1 % infinite or NaN in every category and scene of Figure 9",
                            Finding::undecidable, not_measured},
                           "few",
                           Basis::counts,
                           by_figures,
                           ""};
  double most = 0;
  const auto scenes = scenes_with(data, {"Iter19", feec_label});
  for (const FigureScene* scene : scenes) {
    for (const char* label : {"Iter19", feec_label})
      most = std::max(most, share_blown_up(scene->find(label)->errors));
  }
  if (scenes.empty()) return statement;
  statement.verdict.number = percent(most, 1) + " at most";
  statement.decide(most < 0.01, scenes.size(), figure_8_scenes.size());
  return statement;
}

PaperStatement of_one_iteration(const PaperData& data) {
  PaperStatement statement{
      {"5.4", "one iteration has a substantial number of the highest class of errors",
       "1 % or more infinite or NaN in most scenes of Figure 9", Finding::undecidable, not_measured},
      "substantial",
      Basis::counts,
      by_figures,
      "positions: infinite or NaN; more than 100 cm off"};
  SceneList shares;
  std::size_t blown_up = 0;
  for (const FigureScene* scene : scenes_with(data, {"Iter1"})) {
    const analysis::ErrorTable& errors = scene->find("Iter1")->errors;
    shares.add(scene->name, percent(share_of_band(errors.body_position, worst_band), 1) + "; " +
                                percent(share_of_band(errors.body_position, worst_band - 1), 1));
    if (share_blown_up(errors) >= 0.01) ++blown_up;
  }
  statement.decide(2 * blown_up > shares.size(), shares, figure_8_scenes.size());
  return statement;
}

}  // namespace

std::vector<PaperStatement> error_statements(const PaperData& data) {
  return {
      of_iteration_reduction(data),
      undecidable("5.4", "Figure 9: categories of errors", "printed without numbers",
                  "ours are in the page's figure; what the text says of them is judged below"),
      of_19_iterations(data),
      of_better_and_worse(data),
      of_few_blow_ups(data),
      of_one_iteration(data),
      undecidable("5.4", "images of one iteration are not usable", "-", "images are not judged here"),
  };
}

}  // namespace pbmpi::app
