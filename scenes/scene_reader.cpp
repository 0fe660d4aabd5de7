// Reads a scene's TOML into a plan.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "effects/effects.h"
#include "scenes/format/world_reader.h"
#include "scenes/scene_plan.h"

namespace pbmpi::scenes {
namespace {

void read_run(TableReader& scene, ScenePlan& plan) {
  RunDefaults& defaults = plan.defaults;
  auto run = scene.table("run");
  if (!run) return;
  defaults.replicas = run->integer("replicas", 1, defaults.replicas);
  defaults.warmup = run->integer("warmup", 0, defaults.warmup);
  defaults.frames = run->integer("frames", 1, defaults.frames);
  defaults.steps_per_frame = run->integer("steps_per_frame", 1, defaults.steps_per_frame);
  defaults.dt_s = run->number("dt", Sign::positive, defaults.dt_s);
  defaults.iterations = run->integer("iterations", 1, defaults.iterations);
  const std::string form = run->text("spaces", "many");
  if (form != "one" && form != "many") run->fail("spaces", "'spaces' must be \"one\" or \"many\"");
  plan.in_one_space = form == "one";
  run->finish();
}

/// Reads effects by name, true or false.
void read_effects(TableReader& scene, model::EffectChoices& choices) {
  auto table = scene.table("effects");
  if (!table) return;
  for (const effects::Effect& effect : effects::effect_registry()) {
    const std::string name(effect.name);
    if (table->has(name)) choices[name] = table->flag(name, true);
  }
  table->finish();
}

/// Texts of model files, by name.
std::map<std::string, std::string> read_files(TableReader& scene) {
  std::map<std::string, std::string> texts;
  auto files = scene.table("files");
  if (!files) return texts;
  for (const std::string& name : files->keys()) {
    auto file = files->table(name);
    texts[name] = file->text("text");
    file->finish();
  }
  return texts;
}

class SceneReader {
 public:
  SceneReader(const std::string& file, const toml::table& toml) : scene_(toml, "scene") { plan_.file = file; }

  ScenePlan read(const SceneChoices& choices) {
    plan_.title = scene_.text("title");
    read_defaults(choices);
    read_world(scene_, plan_.empty);
    for (const std::string& space : plan_.empty.spaces)
      space_index_.emplace(space, static_cast<int>(space_index_.size()));
    if (auto interest = scene_.table("interest")) plan_.interest.emplace(*interest);
    plan_.at_rest = scene_.flag("at_rest", false);
    if (scene_.has("overlap"))
      plan_.most_overlap_m = scene_.number_or_infinity("overlap", Sign::non_negative);
    if (auto hard_case = scene_.table("case")) plan_.hard_case.emplace(*hard_case);
    const std::map<std::string, std::string> files = read_files(scene_);
    context_ = {plan_.empty.gravity, plan_.defaults.dt_s, &files, &plan_.notes};
    for (TableReader& actor : scene_.tables("actor")) read_actor(actor);
    for (TableReader& pair : scene_.tables("pair")) plan_.pairs.emplace_back(pair);
    for (TableReader& joint : scene_.tables("joint")) read_named_joint(joint);
    for (TableReader& event : scene_.tables("event"))
      plan_.events.push_back(read_event(event, plan_.defaults.dt_s));
    scene_.finish();
    core::require_input(!plan_.actors.empty(), scene_.where() + ": the scene has no [[actor]]; place one");
    return std::move(plan_);
  }

 private:
  void read_defaults(const SceneChoices& choices) {
    RunDefaults& defaults = plan_.defaults;
    read_run(scene_, plan_);
    defaults.dt_s = choices.dt_s.value_or(defaults.dt_s);
    read_effects(scene_, defaults.effects);
    for (const auto& [name, on] : choices.effects) defaults.effects[name] = on;
  }

  void read_actor(TableReader& table) {
    ActorEntry actor;
    actor.name = table.text("name");
    place(table, actor);
    table.set_what("actor " + core::in_quotes(actor.name));
    if (!actor_names_.insert(actor.name).second)
      table.fail("name", "a second actor of this name; rename one");
    const ActorType& type = read_actor_type(table);
    actor.position = table.vector("position", Sign::any, Vec3(Vec3::Zero()));
    actor.heading_deg = table.number("heading", Sign::any, 0.0);
    actor.space = read_space(table);
    actor.copies = Copies(table);
    actor.variation = read_variation(table);
    actor.parts = PartVelocities(table);
    if (type.moves) {
      actor.velocity = table.vector("velocity", Sign::any, Vec3(Vec3::Zero()));
    } else if (!actor.variation.velocity.isZero()) {
      table.fail("variation", "this type does not move; a velocity cannot vary");
    }
    actor.plan = type.read(table, context_);
    table.finish();
    plan_.actors.push_back(std::move(actor));
  }

  /// Prefers the place where the scene's own file mentions the actor, even if a base has placed it.
  void place(const TableReader& table, ActorEntry& actor) const {
    const std::string own = plan_.file + ":";
    actor.where = table.where();
    for (const std::string& key : table.keys()) {
      if (actor.where.starts_with(own)) break;
      if (table.where(key).starts_with(own)) actor.where = table.where(key);
    }
    actor.is_own = actor.where.starts_with(own);
  }

  int read_space(TableReader& table) const {
    const std::vector<std::string>& spaces = plan_.empty.spaces;
    const std::string name = table.text("space", spaces.front());
    const auto found = space_index_.find(name);
    if (found == space_index_.end())
      table.fail("space", "unknown space " + core::in_quotes(name) + core::suggestion(name, spaces));
    return found->second;
  }

  void read_named_joint(TableReader& table) {
    plan_.joints.push_back(read_joint(table));
    if (!joint_names_.insert(table.text("name")).second)
      table.fail("name", "a second joint of this name; rename one");
  }

  TableReader scene_;
  ScenePlan plan_;
  SceneContext context_;
  std::map<std::string, int> space_index_;
  std::set<std::string> actor_names_, joint_names_;
};

}  // namespace

ScenePlan read_scene(const std::string& file, const toml::table& scene, const SceneChoices& choices) {
  return SceneReader(file, scene).read(choices);
}

}  // namespace pbmpi::scenes
