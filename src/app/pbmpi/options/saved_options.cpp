#include "app/pbmpi/options/options.h"

#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/common/step_arguments.h"
#include "app/pbmpi/options/run_options.h"
#include "core/error.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

/// All options that decide the bits of a result, in the order in which they are compared.
std::vector<std::string> physics() {
  std::vector<std::string> names;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.is_physics) names.emplace_back(option.name);
  }
  for (const RunOption& option : run_options()) {
    if (option.saved == Saved::physics) names.emplace_back(option.name);
  }
  return names;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::map<std::string, std::string, std::less<>> parse(const std::string& options) {
  std::map<std::string, std::string, std::less<>> values;
  std::istringstream lines(options);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos)
      values[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  }
  return values;
}

[[noreturn]] void refuse(const std::string& path, const std::string& name, const std::string& before,
                         const std::string& now) {
  throw core::InputError("--" + name + " " + now + ": the run in " + path + " has " + name + " " +
                         (before.empty() ? "none" : before) +
                         " and would become another one; leave the option out, or begin without --resume");
}

/// The words of a value: effects are chosen one by one, and their order does not matter.
std::set<std::string> chosen(const std::string& value) {
  std::set<std::string> names;
  std::istringstream list(value);
  for (std::string name; std::getline(list, name, ',');) names.insert(name);
  return names;
}

}  // namespace

std::string saved_options(const RunSpec& spec) {
  std::string lines;
  const auto add = [&](const std::string& name, const std::string& value) {
    lines += name + " = " + value + "\n";
  };
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (fits(option, spec.stepper.kind)) add(std::string(option.name), given_text(option, spec.stepper));
  }
  for (const RunOption& option : run_options()) {
    const auto text = option.saved == Saved::no ? std::nullopt : text_of(option, spec);
    if (text) add(std::string(option.name), *text);
  }
  if (spec.estimate) add("feec", estimate_text(*spec.estimate));
  return lines;
}

void require_same_stepper(const std::string& path, const std::string& saved, stepping::StepperKind now) {
  const std::string before = parse(saved)["stepper"];
  if (before != name_of(now)) refuse(path, "stepper", before, std::string(name_of(now)));
}

void require_same_physics(const std::string& path, const std::string& saved, const std::string& now) {
  auto before = parse(saved), after = parse(now);
  for (const std::string& name : physics()) {
    if (chosen(before[name]) != chosen(after[name])) refuse(path, name, before[name], after[name]);
  }
}

}  // namespace pbmpi::app
