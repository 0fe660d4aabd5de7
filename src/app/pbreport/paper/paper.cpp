#include "app/pbreport/paper/paper.h"

#include <ostream>

#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/paper/paper_page.h"
#include "app/pbreport/paper/paper_text.h"
#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  all.add_options()("html", po::value<std::string>()->value_name("OUT"),
                    "one self-contained page: verdicts, and Figures 3, 6, 8 and 9");
  add_print_options("print a table for each part of the paper instead", all);
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

Manual paper_manual() {
  return {.name = "pbreport paper",
          .about =
              "pbreport paper puts every statement, table and figure of the paper beside what was measured: "
              "confirmed, refuted, or not decidable here, by a rule that stands beside it. jobs/paper.sh "
              "makes the files.",
          .usage = "pbreport paper FOLDER|FILE... [options]",
          .options = visible_options()};
}

core::ExitCode run_paper(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, visible_options());
  if (values.count("help") != 0) {
    out << help_of(paper_manual());
    return core::ExitCode::done;
  }
  const PrintForm form = print_form(values);
  const std::vector<std::string> paths = given_files(values);
  core::require_input(!paths.empty(), "paper: no file given; name the folder of jobs/paper.sh");
  const PaperData data = read_paper_data(paths);
  const std::vector<Chapter> chapters = all_statements(data);
  if (const auto html = output_path(values, "html")) {
    io::html::ChartPage page = paper_page(chapters, data);
    page.provenance = io::html::provenance_of(data.files, version_line("pbreport"));
    io::html::write_chart_page(*html, page);
  }
  if (form == PrintForm::json) {
    out << paper_to_json(chapters);
  } else if (form == PrintForm::markdown) {
    out << paper_to_markdown(chapters);
  } else if (values.count("quiet") == 0) {
    out << paper_to_text(chapters);
  }
  require_printed(out, "the statements");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
