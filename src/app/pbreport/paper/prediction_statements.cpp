#include "app/pbreport/paper/statements.h"
#include "app/pbreport/prediction/prediction_verdicts.h"

namespace pbmpi::app {
namespace {

constexpr const char* processor = "modelled processor of Table 3 (docs/prediction.md)";

std::string remark_of(const PaperVerdict& verdict) {
  return verdict.finding == Finding::undecidable
             ? "the study's default form with all nine scenes, or there is no room"
             : processor;
}

}  // namespace

std::vector<PaperStatement> prediction_statements(const PaperData& data) {
  std::vector<PaperStatement> statements = {
      undecidable("5.1", "an error of 1e-6 m is visually negligible", "1e-6 m", "no observers here")};
  // Without a study, the same statements, all of them undecided.
  for (PaperVerdict& verdict : judge_paper(data.prediction.value_or(PredictionStudy()))) {
    if (verdict.section == "3.3") continue;  // judged among those of the suite, as callgrind counts
    std::string remark = remark_of(verdict);
    if (!data.prediction) verdict.number = not_measured;
    statements.push_back(
        {std::move(verdict), "-", Basis::prediction, "jobs/paper.sh --prediction", std::move(remark)});
  }
  return statements;
}

}  // namespace pbmpi::app
