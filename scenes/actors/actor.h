/// What an actor builder is, and the registry of all of them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Where one actor of one world goes.
struct Placement {
  std::string name;              ///< unique in the world
  Pose pose;                     ///< of the actor's own frame: x forward, y left, z up
  Vec3 velocity = Vec3::Zero();  ///< of all its bodies, world frame [m/s]
  int space = 0;                 ///< index into Model::spaces
  int copy = 0;                  ///< 0-based number among the copies of one [[actor]]
};

/// What a builder must know of the scene around its actor.
struct SceneContext {
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  double dt_s = 0.01;         ///< turns times of a programme into steps
  /// Texts of the model files that actors name, and by which messages call them.
  const std::map<std::string, std::string>* files = nullptr;
  std::vector<std::string>* notes = nullptr;  ///< gets what a model file says that is taken otherwise
};

/// How deep actors begin in what they stand on, and blocks in each other. A contact needs some depth to
/// exist; ODE takes a fifth of it away each step, so that this little is gone before it shows.
inline constexpr double initial_depth_m = 1e-4;

/// Adds an actor to a model. Holds the parameters read from the file, so that building reads no TOML.
using ActorPlan = std::function<void(const Placement&, model::Model&)>;

struct ActorType {
  std::string_view name;  ///< as in `type = "car"`
  bool moves;  ///< false: static environment, for which velocity and variation of the velocity make no sense
  ActorPlan (*read)(TableReader&, const SceneContext&);
};

/// All types, by name.
const std::vector<ActorType>& actor_types();

/// Refuses an unknown type at the value of `type`, with the nearest known ones.
const ActorType& read_actor_type(TableReader& actor);

/// `material = { mu = 0.9, restitution = 0 }`, or `fallback` without the key.
model::Material read_material(TableReader& actor, const model::Material& fallback);

ActorPlan read_ground(TableReader& actor, const SceneContext& context);
ActorPlan read_ramp(TableReader& actor, const SceneContext& context);
ActorPlan read_car(TableReader& actor, const SceneContext& context);
ActorPlan read_centipede(TableReader& actor, const SceneContext& context);
ActorPlan read_tank(TableReader& actor, const SceneContext& context);
ActorPlan read_wall(TableReader& actor, const SceneContext& context);
ActorPlan read_projectile(TableReader& actor, const SceneContext& context);
ActorPlan read_human(TableReader& actor, const SceneContext& context);
ActorPlan read_box(TableReader& actor, const SceneContext& context);
ActorPlan read_sphere(TableReader& actor, const SceneContext& context);
ActorPlan read_capsule(TableReader& actor, const SceneContext& context);
ActorPlan read_cylinder(TableReader& actor, const SceneContext& context);
ActorPlan read_compound(TableReader& actor, const SceneContext& context);
ActorPlan read_model(TableReader& actor, const SceneContext& context);

}  // namespace pbmpi::scenes
