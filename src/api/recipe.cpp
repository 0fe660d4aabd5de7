#include "api/recipe.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/system/seal.h"
#include "core/text.h"
#include "effects/effect_choices.h"
#include "engines/shared_scene.h"
#include "mpi/comm/agreement.h"
#include "stepping/names.h"
#include "stepping/option_values.h"

namespace pbmpi::api {
namespace {

/// The names of the settings that are not options of a step.
constexpr std::string_view effects_name = "effects", row_order_name = "row-order";

/// Throws core::InputError on every rank unless `given` is the same on all of them.
void require_same(const mpi::Communicator& comm, std::uint64_t given) {
  const std::vector<std::uint64_t> all = comm.allgather(given);
  core::require_input(std::count(all.begin(), all.end(), all.front()) == std::ssize(all),
                      "the ranks were given different options (scene text, settings, worlds, seed or "
                      "parameters); give all of them the same");
}

/// The scene that `options` name, or whose text they hold.
scenes::SceneSource source_of(const mpi::Communicator& comm, const BatchOptions& options) {
  require_same(comm, options.scene_text.empty() ? 0 : 1);  // or some ranks would wait for a scene's text
  if (!options.scene_text.empty()) {
    const std::string name = options.scene.empty() ? "scene_text" : options.scene;
    return {name, name, options.scene_text};
  }
  mpi::agree_on_errors(comm, [&] {
    core::require_input(!options.scene.empty(),
                        "the batch has no scene; name one, e.g. CrashSk, or give its text");
  });
  return engines::share_scene(comm, options.scene);
}

model::EffectChoices effects_of(const BatchOptions& options) {
  const auto chosen = options.settings.find(std::string(effects_name));
  if (chosen == options.settings.end()) return {};
  try {
    return effects::parse_effect_choices(chosen->second);
  } catch (const core::InputError& error) {
    throw core::InputError(std::string(effects_name) + ": " + error.what());
  }
}

/// Batches alone choose the order of the rows: a learner resets worlds one by one, and worlds at different
/// steps share lanes only in a fixed order.
stepping::StepChoices choices_of(const BatchOptions& options) {
  std::map<std::string, std::string> texts = options.settings;
  texts.erase(std::string(effects_name));
  const auto order = texts.extract(std::string(row_order_name));
  stepping::StepChoices choices = stepping::choose_step(texts, "");
  if (order.empty()) return choices;
  core::require_input(traits_of(choices.settings.kind).has_laws, "row-order is a setting of stepper sor");
  choices.settings.law.row_order = stepping::read_word<stepping::RowOrder>(
      order.mapped(), std::string(row_order_name), stepping::row_order_names);
  return choices;
}

void add_text(core::Checksum& checksum, std::string_view text) {
  const std::uint64_t size = text.size();
  checksum.add(std::as_bytes(std::span(&size, 1)));
  checksum.add(std::as_bytes(std::span(text)));
}

/// Checksum of everything that decides the worlds and their initial states.
std::uint64_t checksum_of(std::uint64_t recipe, const BatchOptions& options) {
  core::Checksum checksum;
  add_text(checksum, std::to_string(recipe));
  add_text(checksum, std::to_string(options.num_worlds) + " " + std::to_string(options.seed));
  for (const Parameters& parameters : options.parameters) {
    add_text(checksum, std::to_string(parameters.size()));
    for (const auto& [key, value] : parameters) {
      add_text(checksum, key);
      add_text(checksum, value);
    }
  }
  return checksum.value();
}

}  // namespace

Recipe::Recipe(const mpi::Communicator& comm, const BatchOptions& options)
    : source_(source_of(comm, options)) {
  mpi::agree_on_errors(comm, [&] {
    choices_ = choices_of(options);
    const std::optional<double> dt_s =
        choices_.has("dt") ? std::optional(choices_.settings.dt_s) : std::nullopt;
    scene_ = scenes::parse_scene(source_, dt_s, effects_of(options));
    settings(options.seed);
    core::require_input(options.num_worlds >= 0, "num_worlds " + std::to_string(options.num_worlds) +
                                                     ": it must be at least 1, or 0 for the scene's own");
    num_worlds_ = options.num_worlds > 0 ? options.num_worlds : scene_->defaults().replicas;
    core::require_input(options.parameters.empty() || std::ssize(options.parameters) == num_worlds_,
                        "there are parameters of " + std::to_string(options.parameters.size()) +
                            " worlds, and " + std::to_string(num_worlds_) +
                            " worlds; give each world its own, or none");
  });
  require_same(comm, checksum_of(scene_checksum() ^ settings_checksum(), options));
}

stepping::StepperSettings Recipe::settings(std::uint64_t seed) const {
  const scenes::RunDefaults& defaults = scene_->defaults();
  return settle_step(choices_, {defaults.dt_s, defaults.iterations, seed}, "");
}

std::uint64_t Recipe::solver_seed(std::uint64_t seed) const {
  const stepping::StepperSettings all = settings(seed);
  const bool draws = !traits_of(all.kind).has_laws || all.law.row_order == stepping::RowOrder::shuffled;
  return draws ? all.seed : 0;
}

std::shared_ptr<const model::Model> Recipe::build(int world, const WorldSeed& from) const {
  scenes::Overrides overrides;
  for (const auto& [key, value] : from.parameters)
    overrides.push_back(
        {key, value, "parameter " + core::in_quotes(key) + " of world " + std::to_string(world)});
  return scene_->build(world, from.seed, overrides);
}

std::uint64_t Recipe::scene_checksum() const {
  core::Checksum checksum;
  add_text(checksum, source_.text);
  for (const scenes::SceneSource& base : scenes::bases_of(source_)) add_text(checksum, base.text);
  return checksum.value();
}

std::uint64_t Recipe::settings_checksum() const {
  constexpr std::uint64_t any_seed = 0;  // the worlds' own seeds decide, unless one was chosen for the solver
  const stepping::StepperSettings all = settings(any_seed);
  core::Checksum checksum;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.is_physics) add_text(checksum, text_of(option, all));
  }
  add_text(checksum, name_of(all.law.row_order));
  add_text(checksum, choices_.has("solver-seed") ? "one solver seed" : "a solver seed a world");
  add_text(checksum, effects::to_text(scene_->defaults().effects));
  return checksum.value();
}

}  // namespace pbmpi::api
