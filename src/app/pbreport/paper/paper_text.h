/// The paper's statements as text, Markdown and JSON.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {

/// Number of statements with each finding, in a chapter or in all, in the order of finding_names.
std::array<int, finding_names.size()> count_findings(const std::vector<PaperStatement>& statements);

/// Header and cells of the table in Markdown and on the page; the last two columns give a number's basis and
/// remark.
const std::vector<std::string>& statement_header();
std::vector<std::string> statement_cells(const PaperStatement& statement);

std::string paper_to_text(const std::vector<Chapter>& chapters);
/// One table per chapter, under its title.
std::string paper_to_markdown(const std::vector<Chapter>& chapters);
std::string paper_to_json(const std::vector<Chapter>& chapters);

}  // namespace pbmpi::app
