#include "app/pbmpi/options/saved_options.h"

#include <array>
#include <charconv>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "effects/effect_choices.h"
#include "model/names.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

/// Options of the run, in addition to those of the step, that decide the bits of its result.
constexpr std::array<std::string_view, 4> physics_of_the_run = {"replicas", "world-range", "steps-per-frame",
                                                                "seed"};

/// All options that decide the bits of a result, in the order in which they are compared.
std::vector<std::string> physics() {
  std::vector<std::string> names;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.is_physics) names.emplace_back(option.name);
  }
  names.insert(names.end(), physics_of_the_run.begin(), physics_of_the_run.end());
  return names;
}

class Lines {
 public:
  void add(std::string_view name, std::string_view value) {
    text_ += std::string(name) + " = " + std::string(value) + "\n";
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(std::string_view name, Number value) {
    std::array<char, 32> digits{};  // as many as it takes to read the number back
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    add(name, std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

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

void add_estimate(const EstimateSpec& estimate, Lines& lines) {
  lines.add("feec", "");
  for (const std::string_view name : estimate_options) {
    const stepping::StepOption& option = stepping::step_option(name);
    if (fits(option, estimate.stepper.kind))
      lines.add("estimate-" + std::string(name), text_of(option, estimate.stepper));
  }
  if (estimate.after > 0) lines.add("estimate-after", estimate.after);
  if (estimate.due_s) lines.add("estimate-by", *estimate.due_s);
}

[[noreturn]] void refuse(const std::string& path, const std::string& name, const std::string& before,
                         const std::string& now) {
  throw core::InputError("--" + name + " " + now + ": the run in " + path + " has " + name + " " +
                         (before.empty() ? "none" : before) +
                         " and would become another one; leave the option out, or begin without --resume");
}

/// Effects are chosen one by one; their order does not matter.
std::set<std::string> chosen(const std::string& effects) {
  std::set<std::string> names;
  std::istringstream list(effects);
  for (std::string name; std::getline(list, name, ',');) names.insert(name);
  return names;
}

}  // namespace

std::string saved_options(const RunSpec& spec, Decomposition asked) {
  Lines lines;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (fits(option, spec.stepper.kind)) lines.add(option.name, text_of(option, spec.stepper));
  }
  lines.add("replicas", spec.ensemble_worlds);
  if (spec.range) lines.add("world-range", to_text(*spec.range));
  lines.add("steps-per-frame", spec.steps_per_frame);
  lines.add("seed", spec.scene_seed);
  if (!spec.effects.empty()) lines.add("effects", effects::to_text(spec.effects));
  lines.add("warmup", spec.warmup);
  lines.add("frames", spec.frames);
  lines.add("record-every", spec.record_every);
  lines.add("budget", spec.budget_s);
  lines.add("decompose", decomposition_names[static_cast<std::size_t>(asked)]);
  lines.add("spaces", spaces_names[static_cast<std::size_t>(spec.spaces)]);
  lines.add("on-blowup", stability::on_blowup_names[static_cast<std::size_t>(spec.on_blowup)]);
  if (spec.estimate) add_estimate(*spec.estimate, lines);
  return lines.text();
}

void require_same_stepper(const std::string& path, const std::string& saved, stepping::StepperKind now) {
  const std::string before = parse(saved)["stepper"];
  if (before != name_of(now)) refuse(path, "stepper", before, std::string(name_of(now)));
}

void require_same_physics(const std::string& path, const std::string& saved, const std::string& now) {
  auto before = parse(saved), after = parse(now);
  for (const std::string& name : physics()) {
    if (before[name] != after[name]) refuse(path, name, before[name], after[name]);
  }
  if (chosen(before["effects"]) != chosen(after["effects"]))
    refuse(path, "effects", before["effects"], after["effects"]);
}

}  // namespace pbmpi::app
