#include "app/pbreport/run_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/pbreport/commands.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

std::string refusal(const std::vector<std::string>& args) {
  try {
    parse_report_options(args);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReportOptions, takes_a_file_and_what_to_write) {
  const ReportOptions options = parse_report_options({"x.h5", "--html", "x.html", "--xdmf=x.xdmf", "--json"});
  EXPECT_EQ(options.file, "x.h5");
  EXPECT_EQ(options.html, "x.html");
  EXPECT_EQ(options.xdmf, "x.xdmf");
  EXPECT_TRUE(options.json);
  EXPECT_FALSE(options.quiet);
}

TEST(ReportOptions, refuses_what_it_does_not_know) {
  EXPECT_NE(refusal({}).find("no file given"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "b.h5"}).find("reads one file"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--htm", "x"}).find("unknown option"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--html", ""}).find("--html"), std::string::npos);
}

TEST(ReportOptions, never_writes_over_the_file_it_reads) {
  const std::string file = testing::TempDir() + "pbmpi_read.h5";
  std::ofstream(file) << "read";
  EXPECT_NE(refusal({file, "--html", file}).find("not written over"), std::string::npos);
  EXPECT_NE(refusal({file, "--xdmf", file}).find("not written over"), std::string::npos);
  std::filesystem::remove(file);
  EXPECT_EQ(refusal({file, "--html", file}), "") << "that it is missing is told when it is read";
}

TEST(ReportCommands, help_names_every_command_and_option) {
  std::ostringstream out;
  EXPECT_EQ(run_pbreport({"--help", "all"}, out), core::ExitCode::done);
  for (const ReportCommand& command : report_commands()) {
    EXPECT_NE(out.str().find("  " + std::string(command.name) + " "), std::string::npos);
  }
  for (const char* option : {"--html", "--xdmf", "--json", "--quiet", "--version"}) {
    EXPECT_NE(out.str().find(option), std::string::npos) << option;
  }
}

TEST(ReportCommands, the_first_word_may_name_the_command) {
  std::ostringstream named, bare;
  run_pbreport({"report", "--version"}, named);
  run_pbreport({"--version"}, bare);
  EXPECT_EQ(named.str(), bare.str());
  EXPECT_EQ(named.str().rfind("pbreport ", 0), 0u);
}

}  // namespace
}  // namespace pbmpi::app
