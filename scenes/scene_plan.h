/// A scene file as read: what each of its worlds is built from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "scenes/actors/actor.h"
#include "scenes/actors/copies.h"
#include "scenes/actors/variation.h"
#include "scenes/format/case_reader.h"
#include "scenes/format/event_reader.h"
#include "scenes/format/interest.h"
#include "scenes/format/joint_reader.h"
#include "scenes/format/pair_reader.h"
#include "scenes/format/part_velocities.h"
#include "scenes/scene.h"

namespace pbmpi::scenes {

/// One [[actor]] of the file: one or more copies of one plan.
struct ActorEntry {
  std::string name;
  std::string where;    ///< "file:line:column" at which the scene's own file mentions it, or else its base
  bool is_own = false;  ///< does the scene's own file mention it?
  ActorPlan plan;
  Vec3 position = Vec3::Zero();
  double heading_deg = 0;
  Vec3 velocity = Vec3::Zero();
  int space = 0;
  Copies copies;
  Variation variation;
  PartVelocities parts;
};

struct ScenePlan {
  std::string file;  ///< its name in messages
  std::string title;
  RunDefaults defaults;
  model::Model empty;         ///< what every world has before its actors are added
  bool in_one_space = false;  ///< all named spaces are one
  std::vector<ActorEntry> actors;
  std::vector<PairPlan> pairs;
  std::vector<JointPlan> joints;
  std::vector<EventPlan> events;
  std::optional<InterestPlan> interest;
  std::optional<CaseReader> hard_case;
  bool at_rest = false;
  std::optional<double> most_overlap_m;  ///< none: find_overlap() uses its own
  std::vector<std::string> notes;        ///< on model files
};

/// What the caller of parse_scene() has decided instead of the file.
struct SceneChoices {
  std::optional<double> dt_s;
  model::EffectChoices effects;
};

/// Reads a scene (scenes/FORMAT.md), which is in `file`, or has it as its base. The plan borrows nothing.
/// Throws core::InputError "file:line:column: ...".
ScenePlan read_scene(const std::string& file, const toml::table& scene, const SceneChoices& choices);

/// The validated model of one world. Throws core::InputError at the place of the actor that is the reason.
std::shared_ptr<const model::Model> build_world(const ScenePlan& plan, int world, std::uint64_t seed);

}  // namespace pbmpi::scenes
