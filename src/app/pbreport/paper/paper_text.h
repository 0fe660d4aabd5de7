/// The paper's statements as text, Markdown and JSON.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {

/// Statements of a chapter, or of all, with each finding, in the order of finding_names.
std::array<int, finding_names.size()> count_findings(const std::vector<PaperStatement>& statements);

/// Header and cells of the table that Markdown and page show; the last two say what a number rests on and
/// why.
const std::vector<std::string>& statement_header();
std::vector<std::string> statement_cells(const PaperStatement& statement);

std::string paper_to_text(const std::vector<Chapter>& chapters);
/// A table a chapter, under its title.
std::string paper_to_markdown(const std::vector<Chapter>& chapters);
std::string paper_to_json(const std::vector<Chapter>& chapters);

}  // namespace pbmpi::app
