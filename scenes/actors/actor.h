/// The interface of actor builders, and the registry of all of them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// The place of one actor in one world.
struct Placement {
  std::string name;              ///< unique in the world
  Pose pose;                     ///< of the actor's own frame: x forward, y left, z up
  Vec3 velocity = Vec3::Zero();  ///< of all its bodies, world frame [m/s]
  int space = 0;                 ///< index into Model::spaces
  int copy = 0;                  ///< 0-based number among the copies of one [[actor]]
};

/// What a builder needs to know of the scene around its actor.
struct SceneContext {
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  double dt_s = 0.01;         ///< converts times of a programme into steps
  /// Texts of the model files that actors name, by their names in messages.
  const std::map<std::string, std::string>* files = nullptr;
  std::vector<std::string>* notes = nullptr;  ///< receives what pbmpi takes differently in a model file
};

/// Initial penetration depth of actors in what they stand on, and of blocks in each other. A contact needs
/// some depth to exist; ODE removes a fifth of it each step, so this small depth is gone before it shows.
inline constexpr double initial_depth_m = 1e-4;

/// Adds an actor to a model. Holds the parameters read from the file, so that building does not read TOML.
using ActorPlan = std::function<void(const Placement&, GrowingModel&)>;

struct ActorType {
  std::string_view name;  ///< as in `type = "car"`
  bool moves;  ///< false: static environment, for which velocity and variation of the velocity make no sense
  ActorPlan (*read)(TableReader&, const SceneContext&);
};

/// All types, by name: a type for each solid shape, and the others.
const std::vector<ActorType>& actor_types();

/// Reads the type; refuses an unknown one at the value of `type`, naming the nearest known types.
const ActorType& read_actor_type(TableReader& actor);

/// Reads `material = { mu = 0.9, restitution = 0 }`; returns `fallback` without the key.
model::Material read_material(TableReader& actor, const model::Material& fallback);

ActorPlan read_ground(TableReader& actor, const SceneContext& context);
ActorPlan read_mesh_actor(TableReader& actor, const SceneContext& context);
ActorPlan read_height_field_actor(TableReader& actor, const SceneContext& context);
ActorPlan read_ramp(TableReader& actor, const SceneContext& context);
ActorPlan read_car(TableReader& actor, const SceneContext& context);
ActorPlan read_centipede(TableReader& actor, const SceneContext& context);
ActorPlan read_tank(TableReader& actor, const SceneContext& context);
ActorPlan read_wall(TableReader& actor, const SceneContext& context);
ActorPlan read_projectile(TableReader& actor, const SceneContext& context);
ActorPlan read_human(TableReader& actor, const SceneContext& context);
/// A body of one shape, whose name is the type.
ActorPlan read_solid(TableReader& actor, const SceneContext& context);
ActorPlan read_compound(TableReader& actor, const SceneContext& context);
ActorPlan read_model(TableReader& actor, const SceneContext& context);

}  // namespace pbmpi::scenes
