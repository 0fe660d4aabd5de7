#include "app/common/options.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "app/common/version.h"
#include "app/manual/manual.h"
#include "core/error.h"
#include "core/system/input_file.h"
#include "core/system/mounts.h"
#include "core/text.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

namespace po = boost::program_options;

namespace {

/// The long option names of a description, for suggestions.
std::vector<std::string> option_names(const po::options_description& description) {
  std::vector<std::string> names;
  for (const auto& option : description.options()) names.push_back(option->long_name());
  return names;
}

std::string unknown_option_message(const std::string& option, const po::options_description& description) {
  const std::string bare = option.substr(std::min(option.find_first_not_of('-'), option.size()));
  const std::string nearest = core::nearest_name(bare, option_names(description));
  return "unknown option '" + option + "'; " +
         (nearest.empty() ? "see --help" : "did you mean --" + nearest + "?");
}

constexpr const char* stray_words = "(word)";  // no word of a command line is an option of this name

/// Takes what is in `description`, and as stray_words each word that has no option before it.
po::variables_map take(const std::vector<std::string>& args, const po::options_description& description,
                       po::positional_options_description positional) {
  po::options_description all;
  all.add(description).add_options()(stray_words, po::value<std::vector<std::string>>());
  if (positional.max_total_count() == 0) positional.add(stray_words, -1);
  po::variables_map values;
  po::store(po::command_line_parser(args)
                .options(all)
                .positional(positional)
                .style(po::command_line_style::unix_style & ~po::command_line_style::allow_guessing)
                .run(),
            values);
  return values;
}

void require_no_stray_word(const po::variables_map& values, const po::options_description& description) {
  if (values.count(stray_words) == 0) return;
  const std::string word = values[stray_words].as<std::vector<std::string>>().front();
  const bool lacks_scene = description.find_nothrow("scene", false) != nullptr && values.count("scene") == 0;
  throw core::InputError("the word " + core::in_quotes(word) + " stands alone on the command line; " +
                         (lacks_scene ? "did you mean --scene " + word + "?" : "see --help"));
}

}  // namespace

po::options_description common_options_description() {
  po::options_description common("General");
  common.add_options()                  //
      ("help,h", "print this help")     //
      ("version", "print the version")  //
      ("config", po::value<std::string>()->value_name("FILE"),
       "read options from FILE, one 'name = value' a line; the command line wins")  //
      ("quiet,q", "print nothing but errors and what --report json asks for")       //
      ("progress", po::value<std::string>()->default_value("auto")->value_name("auto|always|never"),
       "progress on stderr; auto: a bar on a terminal, elsewhere a line every 10 s; always: a bar");
  return common;
}

po::variables_map parse_command_line(const std::vector<std::string>& args,
                                     const po::options_description& description,
                                     const po::positional_options_description& positional,
                                     const std::string& last) {
  po::variables_map values;
  const std::string in_checkpoint = "the options in the checkpoint: ";
  std::string where;  // what is being read, with ": "; empty for the command line
  try {
    values = take(help_arguments(args).args, description, positional);
    require_no_stray_word(values, description);
    if (values.count("config") != 0) {  // boost keeps the first value stored
      const auto file = values["config"].as<std::string>();
      core::require_answers(std::array{core::NamedPath{"--config", file, false}});
      where = file + ": ";
      std::istringstream lines(core::read_input_file(file, "--config wants a file of 'name = value' lines"));
      po::store(po::parse_config_file(lines, description), values);
      where = "";
    }
    where = in_checkpoint;
    std::istringstream lines(last);
    po::store(po::parse_config_file(lines, description), values);
    where = "";
    po::notify(values);
  } catch (const po::unknown_option& error) {
    throw core::InputError(
        where + unknown_option_message(error.get_option_name(), description) +
        (where == in_checkpoint ? " (another version of pbmpi wrote it, and can go on from it)" : ""));
  } catch (const po::error& error) {
    throw core::InputError(where + error.what() + "; see --help");
  }
  core::require_separate(named_paths(values));
  return values;
}

std::string place_of(const std::string& option, const std::vector<std::string>& args,
                     const po::variables_map& values) {
  const std::string word = "--" + option;
  const bool is_given = std::ranges::any_of(
      args, [&](const std::string& arg) { return arg == word || arg.starts_with(word + "="); });
  return is_given || values.count("config") == 0 ? "" : values["config"].as<std::string>() + ": ";
}

std::vector<core::NamedPath> named_paths(const po::variables_map& values) {
  std::vector<core::NamedPath> paths;
  const auto add = [&](const std::string& option, bool written) {
    if (values.count(option) == 0) return;
    const boost::any& value = values[option].value();
    std::vector<std::string> names;
    if (const auto* one = boost::any_cast<std::string>(&value)) names = {*one};
    if (const auto* many = boost::any_cast<std::vector<std::string>>(&value)) names = *many;
    for (const std::string& name : names) {
      if (!name.empty()) paths.push_back({option == "file" ? "the file" : "--" + option, name, written});
    }
  };
  for (const char* option : {"file", "scene", "config", "parameters"}) add(option, false);
  for (const char* option : {"output", "checkpoint", "html", "xdmf"}) add(option, true);
  return paths;
}

po::variables_map parse_with_files(const std::vector<std::string>& args,
                                   po::options_description description) {
  description.add_options()("file", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("file", -1);
  return parse_command_line(args, description, positional);
}

std::vector<std::string> given_files(const po::variables_map& values) {
  return values.count("file") == 0 ? std::vector<std::string>{}
                                   : values["file"].as<std::vector<std::string>>();
}

void add_help_options(po::options_description& description) {
  description.add_options()("help,h", "print this help")("quiet,q", "print nothing but errors");
}

void add_seed_option(const std::string& meaning, po::options_description& description) {
  // As text: Boost would take -1 for 2^64 - 1.
  description.add_options()("seed", po::value<std::string>()->default_value("1")->value_name("N"),
                            meaning.c_str());
}

std::uint64_t given_seed(const po::variables_map& values) {
  stepping::StepperSettings settings;
  set(stepping::step_option("solver-seed"), values["seed"].as<std::string>(), "--seed", settings);
  return settings.seed;
}

std::optional<std::string> output_path(const po::variables_map& values, const char* option) {
  if (values.count(option) == 0) return std::nullopt;
  const std::string path = values[option].as<std::string>();
  core::require_input(!path.empty(),
                      std::string("--") + option + ": the file name is empty; name a file to write");
  return path;
}

CommonOptions common_options(const po::variables_map& values) {
  CommonOptions common;
  common.quiet = values.count("quiet") != 0;
  const std::string progress = values["progress"].as<std::string>();
  if (progress == "always") {
    common.progress = ProgressMode::always;
  } else if (progress == "never") {
    common.progress = ProgressMode::never;
  } else {
    core::require_input(progress == "auto", "--progress " + progress + ": it must be auto, always or never");
  }
  return common;
}

std::vector<std::string> arguments(int argc, char** argv) { return {argv + 1, argv + argc}; }

std::string version_line(const std::string& program) {
  return program + " " + program_version + " (" + git_revision + "; " + build_description + ")";
}

}  // namespace pbmpi::app
