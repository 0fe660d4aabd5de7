#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "model/validate.h"
#include "scenes/actors/actor.h"
#include "scenes/actors/copies.h"
#include "scenes/actors/variation.h"
#include "scenes/format/case_reader.h"
#include "scenes/format/event_reader.h"
#include "scenes/format/interest.h"
#include "scenes/format/joint_reader.h"
#include "scenes/format/pair_reader.h"
#include "scenes/format/part_velocities.h"
#include "scenes/format/world_reader.h"
#include "scenes/lay_overrides.h"
#include "scenes/parts/at_rest.h"
#include "scenes/parts/overlap.h"
#include "scenes/scene_toml.h"

namespace pbmpi::scenes {
namespace {

/// "12 cm", "0.3 mm".
std::string length_text(double metres) {
  std::ostringstream text;
  text.precision(2);
  metres >= 0.01 ? text << std::lround(metres * 100) << " cm" : text << 1000 * metres << " mm";
  return text.str();
}

/// One [[actor]] of the file: one or more copies of one plan.
struct ActorEntry {
  std::string name;
  std::string where;
  ActorPlan plan;
  Vec3 position = Vec3::Zero();
  double heading_deg = 0;
  Vec3 velocity = Vec3::Zero();
  int space = 0;
  Copies copies;
  Variation variation;
  PartVelocities parts;
};

/// The defaults of the scene that the caller replaces.
struct Choices {
  std::optional<double> dt_s;
  model::EffectChoices effects;
};

class FileScene final : public Scene {
 public:
  /// `toml`: parse_with_base() of the source.
  FileScene(const SceneSource& source, const Choices& choices, toml::table toml)
      : source_(source), choices_(choices), toml_(std::move(toml)) {
    TableReader scene(toml_, "scene");
    title_ = scene.text("title");
    read_defaults(scene);
    if (choices.dt_s) defaults_.dt_s = *choices.dt_s;
    read_effects(scene);
    for (const auto& [name, on] : choices.effects) defaults_.effects[name] = on;
    read_world(scene, empty_);
    if (auto interest = scene.table("interest")) interest_.emplace(*interest);
    at_rest_ = scene.flag("at_rest", false);
    if (scene.has("overlap")) most_overlap_m_ = scene.number_or_infinity("overlap", Sign::non_negative);
    read_case(scene);
    read_files(scene);
    for (TableReader& actor : scene.tables("actor")) read_actor(actor);
    for (TableReader& pair : scene.tables("pair")) pairs_.emplace_back(pair);
    for (TableReader& joint : scene.tables("joint")) read_named_joint(joint);
    for (TableReader& event : scene.tables("event")) events_.push_back(read_event(event, defaults_.dt_s));
    scene.finish();
    core::require_input(!actors_.empty(), scene.where() + ": the scene has no [[actor]]; place one");
  }

  const std::string& name() const override { return source_.name; }
  const std::string& title() const override { return title_; }
  const std::string& text() const override { return source_.text; }
  const RunDefaults& defaults() const override { return defaults_; }
  const std::vector<std::string>& notes() const override { return notes_; }
  const std::optional<stability::HardCase>& hard_case() const override { return hard_case_; }

  std::shared_ptr<const model::Model> build(int world, std::uint64_t seed,
                                            const Overrides& overrides) const override {
    if (overrides.empty()) return build(world, seed);
    try {
      return with(overrides, toml_).build(world, seed);
    } catch (const core::InputError&) {
      // A copy of a table has lost its places in the file: an error is found again where the places are
      // known.
      return build_or_tell(world, seed, overrides);
    }
  }

  bool is_uniform() const override {
    return std::all_of(actors_.begin(), actors_.end(), [](const ActorEntry& actor) {
      return actor.variation.is_none() && actor.copies.are_as_many_everywhere();
    });
  }

 private:
  std::shared_ptr<const model::Model> build(int world, std::uint64_t seed) const {
    auto result = std::make_shared<model::Model>(empty_);
    if (in_one_space_) result->spaces.resize(1);
    for (std::size_t i = 0; i < actors_.size(); ++i) place_copies(i, world, seed, *result);
    for (const PairPlan& pair : pairs_) pair.put_into(*result);
    for (const JointPlan& joint : joints_) joint(*result);
    for (const EventPlan& event : events_) event(*result);
    std::stable_sort(result->events.begin(), result->events.end(),
                     [](const model::Event& a, const model::Event& b) { return a.step < b.step; });
    if (interest_) interest_->put_into(*result);
    if (case_reader_) case_reader_->require_bodies(*result);
    if (at_rest_) *result = at_rest(std::move(*result));
    leave_out_effects(*result);
    validate(*result, world);
    refuse_overlap(*result, world);
    return result;
  }

  /// The scene with the TOML in which `overrides` are laid over the file.
  FileScene with(const Overrides& overrides, toml::table toml) const {
    lay_overrides(toml, overrides);
    return {source_, choices_, std::move(toml)};
  }

  /// Reports an error of this world alone at the scene's place, and adds the source of the world's
  /// parameters.
  std::shared_ptr<const model::Model> build_or_tell(int world, std::uint64_t seed,
                                                    const Overrides& overrides) const {
    const FileScene scene = with(overrides, parse_with_base(source_));
    try {
      return scene.build(world, seed);
    } catch (const core::InputError& error) {
      const std::string& from = overrides.front().where;
      throw core::InputError(error.what() +
                             (from.empty() ? "" : " (parameters of this world: " + from + ")"));
    }
  }

  void read_defaults(TableReader& scene) {
    auto run = scene.table("run");
    if (!run) return;
    defaults_.replicas = run->integer("replicas", 1, defaults_.replicas);
    defaults_.warmup = run->integer("warmup", 0, defaults_.warmup);
    defaults_.frames = run->integer("frames", 1, defaults_.frames);
    defaults_.steps_per_frame = run->integer("steps_per_frame", 1, defaults_.steps_per_frame);
    defaults_.dt_s = run->number("dt", Sign::positive, defaults_.dt_s);
    defaults_.iterations = run->integer("iterations", 1, defaults_.iterations);
    const std::string form = run->text("spaces", "many");
    if (form != "one" && form != "many") run->fail("spaces", "'spaces' must be \"one\" or \"many\"");
    in_one_space_ = form == "one";
    run->finish();
  }

  /// Reads effects by name, true or false.
  void read_effects(TableReader& scene) {
    auto table = scene.table("effects");
    if (!table) return;
    for (const effects::Effect& effect : effects::effect_registry()) {
      const std::string name(effect.name);
      if (table->has(name)) defaults_.effects[name] = table->flag(name, true);
    }
    table->finish();
  }

  void read_case(TableReader& scene) {
    auto table = scene.table("case");
    if (!table) return;
    case_reader_.emplace(*table);
    hard_case_ = case_reader_->hard_case();
  }

  void read_files(TableReader& scene) {
    auto files = scene.table("files");
    if (!files) return;
    for (const std::string& name : files->keys()) {
      auto file = files->table(name);
      files_[name] = file->text("text");
      file->finish();
    }
  }

  void read_actor(TableReader& table) {
    ActorEntry actor;
    actor.name = table.text("name");
    actor.where = place_of(table);
    table.set_what("actor " + core::in_quotes(actor.name));
    if (!names_.insert("actor " + actor.name).second) {
      table.fail("name", "a second actor of this name; rename one");
    }
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
    actor.plan = type.read(table, {empty_.gravity, defaults_.dt_s, &files_, &notes_});
    table.finish();
    actors_.push_back(std::move(actor));
  }

  /// The place where the scene's own file mentions the actor, even if a base has placed it.
  std::string place_of(const TableReader& table) const {
    const std::string own = source_.file + ":";
    if (table.where().starts_with(own)) return table.where();
    for (const std::string& key : table.keys()) {
      if (table.where(key).starts_with(own)) return table.where(key);
    }
    return table.where();
  }

  int read_space(TableReader& table) const {
    const std::string name = table.text("space", empty_.spaces.front());
    const auto found = std::find(empty_.spaces.begin(), empty_.spaces.end(), name);
    if (found == empty_.spaces.end()) {
      table.fail("space", "unknown space " + core::in_quotes(name) + core::suggestion(name, empty_.spaces));
    }
    return static_cast<int>(found - empty_.spaces.begin());
  }

  void read_named_joint(TableReader& table) {
    joints_.push_back(read_joint(table));
    if (!names_.insert("joint " + table.text("name")).second) {
      table.fail("name", "a second joint of this name; rename one");
    }
  }

  void place_copies(std::size_t index, int world, std::uint64_t seed, model::Model& model) const {
    const ActorEntry& actor = actors_[index];
    const int copies = actor.copies.in(world);
    for (int copy = 0; copy < copies; ++copy) {
      // Each actor has keys for a million copies (the most that a file may ask for).
      const std::uint64_t key = (static_cast<std::uint64_t>(index) << 20) + static_cast<std::uint64_t>(copy);
      const Offset offset = draw(actor.variation, seed, world, key);
      Placement place;
      place.name = actor.copies.are_numbered() ? actor.name + "." + std::to_string(copy + 1) : actor.name;
      place.pose.position = actor.position + actor.copies.offset(copy) + offset.position;
      place.pose.orientation = rotation(radians(actor.heading_deg + offset.heading_deg), Vec3::UnitZ());
      place.velocity = actor.velocity + offset.velocity;
      place.space = in_one_space_ ? 0 : actor.space;
      place.copy = copy;
      try {
        actor.plan(place, model);
      } catch (const std::length_error& error) {
        throw core::InputError(actor.where + ": actor " + core::in_quotes(actor.name) + ": " + error.what());
      }
      actor.parts.put_into(model, place.name);
    }
  }

  void leave_out_effects(model::Model& model) const {
    model.effects = defaults_.effects;
    try {
      effects::leave_out_effects(model);
    } catch (const core::InputError& error) {
      throw core::InputError(source_.file + ": " + error.what());
    }
  }

  /// Checks what the readers cannot see; an error is reported at the place of the actor that it names.
  void validate(const model::Model& model, int world) const {
    try {
      model::validate(model, "world " + std::to_string(world));
    } catch (const core::InputError& error) {
      const std::string message = error.what();
      std::string where = source_.file;
      for (const ActorEntry& actor : actors_) {
        if (message.find(core::in_quotes(actor.name)) != std::string::npos ||
            message.find('\'' + actor.name + '.') != std::string::npos) {
          where = actor.where;
        }
      }
      throw core::InputError(where + ": " + message);
    }
  }

  void refuse_overlap(const model::Model& model, int world) const {
    const auto overlap = find_overlap(model, most_overlap_m_);
    if (!overlap) return;
    const std::string& a = model.actors[overlap->actor_a].name;
    const std::string& b = model.actors[overlap->actor_b].name;
    // The error is reported at the actor that the scene's own file mentions, if the other comes from a base.
    const std::string own = source_.file + ":";
    const bool at_b = where_of(b).starts_with(own) || !where_of(a).starts_with(own);
    throw core::InputError(where_of(at_b ? b : a) + ": actor " + core::in_quotes(b) + ": in world " +
                           std::to_string(world) + " it overlaps " + core::in_quotes(a) + " by " +
                           length_text(overlap->depth_m) +
                           " at the start (it would be thrown out in one step); move one of them, or allow "
                           "it with 'overlap'");
  }

  /// The place in the file of an actor or a copy of it.
  std::string where_of(const std::string& name) const {
    for (const ActorEntry& actor : actors_) {
      if (name == actor.name || (actor.copies.are_numbered() && name.starts_with(actor.name + ".")))
        return actor.where;
    }
    return source_.file;
  }

  SceneSource source_;
  Choices choices_;
  toml::table toml_;
  std::string title_;
  RunDefaults defaults_;
  bool in_one_space_ = false;  ///< all named spaces are one
  model::Model empty_;         ///< what every world has before its actors are added
  std::vector<ActorEntry> actors_;
  std::vector<PairPlan> pairs_;
  std::vector<JointPlan> joints_;
  std::vector<EventPlan> events_;
  std::set<std::string> names_;
  std::map<std::string, std::string> files_;  ///< texts of model files
  std::vector<std::string> notes_;
  std::optional<InterestPlan> interest_;
  bool at_rest_ = false;
  std::optional<double> most_overlap_m_;  ///< none: find_overlap() uses its own
  std::optional<CaseReader> case_reader_;
  std::optional<stability::HardCase> hard_case_;
};

}  // namespace

std::unique_ptr<Scene> parse_scene(const SceneSource& source, std::optional<double> dt_s,
                                   const model::EffectChoices& effects) {
  if (dt_s) {
    core::require_input(std::isfinite(*dt_s) && *dt_s > 0,
                        "dt is " + std::to_string(*dt_s) + " s; it must be finite and above 0");
  }
  auto scene = std::make_unique<FileScene>(source, Choices{dt_s, effects}, parse_with_base(source));
  scene->build(0, 0,
               {});  // detects early what only shows in a built world: joints to bodies that do not exist
  return scene;
}

}  // namespace pbmpi::scenes
