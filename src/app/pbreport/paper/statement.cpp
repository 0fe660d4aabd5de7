#include "app/pbreport/paper/statement.h"

#include <cmath>

#include "app/common/format.h"

namespace pbmpi::app {

void PaperStatement::decide(bool is_confirmed, std::size_t num_measured, std::size_t num_needed) {
  if (num_measured >= num_needed) {
    verdict.finding = finding_if(is_confirmed);
    return;
  }
  verdict.finding = Finding::undecidable;
  remark = format("%zu of %zu scenes; all: jobs/paper.sh", num_measured, num_needed) +
           (remark.empty() ? "" : "; " + remark);
}

void PaperStatement::decide(bool is_confirmed, const SceneList& measured, std::size_t num_needed,
                            const std::string& lead) {
  if (measured.empty()) return;
  verdict.number = lead + measured.text();
  decide(is_confirmed, measured.size(), num_needed);
}

bool is_near(double ours, double papers) { return std::abs(ours - papers) <= 0.1 * papers; }

PaperStatement undecidable(const std::string& section, const std::string& statement,
                           const std::string& papers, const std::string& reason) {
  return {{section, statement, "-", Finding::undecidable, "-"}, papers, Basis::nothing, "", reason};
}

void SceneList::add(const std::string& scene, const std::string& number) {
  text_ += (empty() ? "" : ", ") + scene + (number.empty() ? "" : " " + number);
  ++size_;
}

std::string percent(double share, int decimals) { return format("%.*f %%", decimals, 100 * share); }

std::string rate(double hz) { return format(hz < 100 ? "%.3g Hz" : "%.0f Hz", hz); }

}  // namespace pbmpi::app
