#include "app/pbreport/study/study_report.h"

#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/study/study_file.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options(const StudyReport& report) {
  po::options_description all("Options");
  add_scene_choice(all);
  add_output_options(report.page, all);
  add_print_options(report.table, all);
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

Manual manual_of(const StudyReport& report) {
  return {.name = "pbreport " + report.name,
          .about = "pbreport " + report.name + " shows " + report.shows + ": the file of pbstudy " +
                   report.name + ". The word " + report.name + " may be left out.",
          .usage = "pbreport [" + report.name + "] " + report.name + ".h5 [options]",
          .options = visible_options(report)};
}

ReportOfStudyOptions parse_options(const StudyReport& report, const std::vector<std::string>& args) {
  return report_of_study_options(parse_with_files(args, visible_options(report)), "a study of " + report.name,
                                 report.name + ".h5");
}

core::ExitCode run_study_report(const StudyReport& report, const std::vector<std::string>& args,
                                std::ostream& out, const ReadStudy& read) {
  const ReportOfStudyOptions options = parse_options(report, args);
  if (options.help) {
    out << help_of(manual_of(report));
    return core::ExitCode::done;
  }
  const io::TableFile file = read_study(options.file, report.name);
  const StudyViews views = read(file, options);
  if (options.csv) io::write_file(*options.csv, study_to_csv(file));
  if (options.html) views.write_page(*options.html);
  if (options.form == PrintForm::json) {
    out << views.json();
  } else if (options.form == PrintForm::markdown) {
    out << views.markdown();
  } else if (!options.quiet) {
    out << views.text();
  }
  require_printed(out, "the report");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
