#include "app/pbreport/paper/paper_text.h"

#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + (cell.empty() ? "-" : cell) + " |";
  return text + "\n";
}

/// How to measure a missing number, or why a number is as it is.
std::string remark_of(const PaperStatement& statement) {
  return statement.verdict.number == not_measured ? "measured by " + statement.command : statement.remark;
}

std::string counts_text(const std::vector<Chapter>& chapters) {
  std::array<int, finding_names.size()> all{};
  for (const Chapter& chapter : chapters) {
    const auto counts = count_findings(chapter.statements);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += counts[i];
  }
  return format("%d confirmed, %d refuted, %d not decidable here", all[0], all[1], all[2]);
}

}  // namespace

std::array<int, finding_names.size()> count_findings(const std::vector<PaperStatement>& statements) {
  std::array<int, finding_names.size()> counts{};
  for (const PaperStatement& statement : statements)
    ++counts[static_cast<std::size_t>(statement.verdict.finding)];
  return counts;
}

const std::vector<std::string>& statement_header() {
  static const std::vector<std::string> header = {"section",      "verdict", "the paper", "its value",
                                                  "confirmed if", "ours",    "rests on",  "remark"};
  return header;
}

std::vector<std::string> statement_cells(const PaperStatement& statement) {
  const PaperVerdict& verdict = statement.verdict;
  return {verdict.section, name_of(verdict.finding), verdict.statement,        statement.papers,
          verdict.rule,    verdict.number,           name_of(statement.basis), remark_of(statement)};
}

std::string paper_to_text(const std::vector<Chapter>& chapters) {
  std::string text;
  for (const Chapter& chapter : chapters) {
    text += chapter.title + "\n";
    for (const PaperStatement& statement : chapter.statements) {
      const PaperVerdict& verdict = statement.verdict;
      text += format("  %-6s %-18s ", verdict.section.c_str(), name_of(verdict.finding).c_str()) +
              verdict.statement + "\n" + format("  %-25s ", "") + "ours: " + verdict.number;
      if (statement.papers != "-" && !statement.papers.empty()) text += " (paper: " + statement.papers + ")";
      if (!remark_of(statement).empty()) text += "; " + remark_of(statement);
      text += "\n";
    }
    text += "\n";
  }
  return text + "statements: " + counts_text(chapters) + "\n";
}

std::string paper_to_markdown(const std::vector<Chapter>& chapters) {
  std::string text;
  for (const Chapter& chapter : chapters) {
    text += "## " + chapter.title + "\n\n" + markdown_row(statement_header()) +
            markdown_row(std::vector<std::string>(statement_header().size(), "---"));
    for (const PaperStatement& statement : chapter.statements)
      text += markdown_row(statement_cells(statement));
    text += "\n";
  }
  return text + counts_text(chapters) + "\n";
}

std::string paper_to_json(const std::vector<Chapter>& chapters) {
  Json json = {{"statements", Json::array()}};
  for (const Chapter& chapter : chapters) {
    for (const PaperStatement& statement : chapter.statements) {
      const PaperVerdict& verdict = statement.verdict;
      json["statements"].push_back({{"chapter", chapter.title},
                                    {"section", verdict.section},
                                    {"statement", verdict.statement},
                                    {"paper", statement.papers},
                                    {"rule", verdict.rule},
                                    {"ours", verdict.number},
                                    {"finding", name_of(verdict.finding)},
                                    {"rests_on", name_of(statement.basis)},
                                    {"measured_by", statement.command},
                                    {"remark", remark_of(statement)}});
    }
  }
  return json_text(json, 2) + "\n";
}

}  // namespace pbmpi::app
