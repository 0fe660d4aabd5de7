#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "scenes/scene_plan.h"
#include "scenes/scene_toml.h"

namespace pbmpi::scenes {
namespace {

class FileScene final : public Scene {
 public:
  FileScene(const SceneSource& source, const SceneChoices& choices)
      : source_(source),
        choices_(choices),
        toml_(parse_with_base(source)),
        plan_(read_scene(source.file, toml_, choices)) {
    if (plan_.hard_case) hard_case_ = plan_.hard_case->hard_case();
  }

  const std::string& name() const override { return source_.name; }
  const std::string& title() const override { return plan_.title; }
  const std::string& text() const override { return source_.text; }
  const RunDefaults& defaults() const override { return plan_.defaults; }
  const std::vector<std::string>& notes() const override { return plan_.notes; }
  const std::optional<stability::HardCase>& hard_case() const override { return hard_case_; }

  std::shared_ptr<const model::Model> build(int world, std::uint64_t seed,
                                            const Overrides& overrides) const override {
    if (overrides.empty()) return build_world(plan_, world, seed);
    try {
      return build_world(plan_with(overrides, toml_), world, seed);
    } catch (const core::InputError&) {
      // A copy of a table has lost its places in the file: an error is found again where the places are
      // known.
      return build_or_tell(world, seed, overrides);
    }
  }

  bool is_uniform() const override {
    return std::ranges::all_of(plan_.actors, [](const ActorEntry& actor) {
      return actor.variation.is_none() && actor.copies.are_as_many_everywhere();
    });
  }

 private:
  /// The plan of `toml` with `overrides` laid over it.
  ScenePlan plan_with(const Overrides& overrides, toml::table toml) const {
    lay_overrides(toml, overrides);
    return read_scene(source_.file, toml, choices_);
  }

  /// Reports an error of this world alone at the scene's place, and adds the source of the world's
  /// parameters.
  std::shared_ptr<const model::Model> build_or_tell(int world, std::uint64_t seed,
                                                    const Overrides& overrides) const {
    const ScenePlan plan = plan_with(overrides, parse_with_base(source_));
    try {
      return build_world(plan, world, seed);
    } catch (const core::InputError& error) {
      const std::string& from = overrides.front().where;
      throw core::InputError(error.what() +
                             (from.empty() ? "" : " (parameters of this world: " + from + ")"));
    }
  }

  SceneSource source_;
  SceneChoices choices_;
  toml::table toml_;
  ScenePlan plan_;
  std::optional<stability::HardCase> hard_case_;
};

}  // namespace

std::unique_ptr<Scene> parse_scene(const SceneSource& source, std::optional<double> dt_s,
                                   const model::EffectChoices& effects) {
  if (dt_s) {
    core::require_input(std::isfinite(*dt_s) && *dt_s > 0,
                        "dt is " + std::to_string(*dt_s) + " s; it must be finite and above 0");
  }
  auto scene = std::make_unique<FileScene>(source, SceneChoices{dt_s, effects});
  // Detects early what only shows in a built world: joints to bodies that do not exist.
  scene->build(0, 0, {});
  return scene;
}

}  // namespace pbmpi::scenes
