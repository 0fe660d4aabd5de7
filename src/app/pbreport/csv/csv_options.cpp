#include "app/pbreport/csv/csv_options.h"

#include <charconv>

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description visible_options() {
  po::options_description what("What to write");
  what.add_options()  //
      ("table", po::value<std::string>()->default_value("bodies")->value_name("NAME"),
       "which table of the file")                     //
      ("list", "print the tables that the file has")  //
      ("frames", po::value<std::string>()->value_name("FIRST:LAST[:EVERY]"),
       "these frames only, both ends included, counted from 0 at the start of the first run; either end may "
       "be left out")                                                                                  //
      ("measured", "no warm-up frames")                                                                //
      ("world", po::value<std::vector<int>>()->multitoken()->value_name("N..."), "these worlds only")  //
      ("body", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
       "bodies of these names only, e.g. car.chassis")  //
      ("actor", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
       "bodies of these actors only, e.g. human1")  //
      ("output,o", po::value<std::string>()->value_name("FILE"),
       "write into FILE instead of standard output");
  po::options_description general("General");
  add_help_options(general);
  po::options_description all;
  all.add(what).add(general);
  return all;
}

std::int64_t frame_number(const std::string& part, const std::string& text) {
  std::int64_t number = 0;
  const char* end = part.data() + part.size();
  const auto [rest, error] = std::from_chars(part.data(), end, number);
  require_input(error == std::errc() && rest == end && number >= 0,
                "--frames " + text + ": '" + part + "' is no number of a frame; give FIRST:LAST, e.g. 10:20");
  return number;
}

template <class Value>
std::vector<Value> many(const po::variables_map& values, const char* option) {
  return values.count(option) == 0 ? std::vector<Value>() : values[option].as<std::vector<Value>>();
}

}  // namespace

FrameRange parse_frames(const std::string& text) {
  std::vector<std::string> parts = {""};
  for (const char c : text) {
    if (c == ':') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  require_input(parts.size() <= 3 && !text.empty(),
                "--frames " + text + ": give FIRST:LAST or FIRST:LAST:EVERY, e.g. 10:20");
  FrameRange range;
  if (!parts[0].empty()) range.first = frame_number(parts[0], text);
  if (parts.size() == 1) range.last = range.first;
  if (parts.size() > 1 && !parts[1].empty()) range.last = frame_number(parts[1], text);
  if (parts.size() > 2) range.every = frame_number(parts[2], text);
  require_input(range.every >= 1, "--frames " + text + ": every 0th frame is none; give 1 or more");
  require_input(range.first <= range.last, "--frames " + text + ": the last frame is before the first");
  return range;
}

Manual csv_manual() {
  return {.name = "pbreport csv",
          .about =
              "pbreport csv writes a table of a run as comma-separated values, units in the first line: "
              "poses and velocities of bodies, observables, joints, contacts, timings, events. Numbers have "
              "as many digits as it takes to read them back to the same bits.",
          .usage = "pbreport csv RUN.h5 [options]",
          .options = visible_options(),
          .examples = {"pbreport csv 100CrSk.h5 --body car.chassis --world 0 --output chassis.csv",
                       "pbreport csv 100CrSk.h5 --table observables --measured > observables.csv",
                       "pbreport csv 100CrSk.h5 --list"}};
}

CsvOptions parse_csv_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  CsvOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  const auto files = given_files(values);
  require_input(files.size() == 1,
                "csv: " + std::to_string(files.size()) +
                    " files are given; name the HDF5 file of one run (names of --body, --actor "
                    "and numbers of --world come after it)");
  options.file = files.front();
  options.list = values.count("list") != 0;
  options.table = values["table"].as<std::string>();
  if (values.count("frames") != 0) options.frames = parse_frames(values["frames"].as<std::string>());
  options.measured_only = values.count("measured") != 0;
  options.worlds = many<int>(values, "world");
  options.bodies = many<std::string>(values, "body");
  options.actors = many<std::string>(values, "actor");
  options.output = output_path(values, "output");
  return options;
}

}  // namespace pbmpi::app
