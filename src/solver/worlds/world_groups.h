/// Which worlds are stepped together.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "solver/worlds/sor_world.h"
#include "solver/worlds/world_group.h"

namespace pbmpi::solver {

/// Worlds share a group if they have equal laws and, where the order of rows follows from the step, are at
/// the same step. When worlds come, go or change step, only the groups that held them, and groups that are
/// not full, are made anew.
class WorldGroups {
 public:
  struct Place {
    WorldGroup* group = nullptr;  ///< null: in no group until complete()
    int index = 0;                ///< among its worlds
  };

  /// Borrows the settings.
  explicit WorldGroups(const stepping::StepperSettings& settings) : settings_(&settings) {}

  /// Borrows the world, whose id must be unique.
  void add(SorWorld& world);
  void remove(const SorWorld& world);
  Place place(const SorWorld& world) const { return members_.at(world.id()).place; }

  /// Notes that a world has changed step.
  void note_step() { steps_changed_ = true; }
  /// Marks a world's group to be made anew from the states of its worlds.
  void dissolve_group_of(const SorWorld& world);

  /// Puts every world into a group.
  void complete();
  std::span<const std::unique_ptr<WorldGroup>> all() const { return groups_; }

 private:
  struct Member {
    SorWorld* world = nullptr;
    Place place;
  };
  struct Kind;

  void dissolve(const WorldGroup& group);
  void part_steps();
  void deal(Kind& kind, std::int64_t bodies_of_all);
  void make_group(std::span<SorWorld* const> worlds);

  const stepping::StepperSettings* settings_;
  std::map<int, Member> members_;  ///< by id
  std::vector<std::unique_ptr<WorldGroup>> groups_;
  bool steps_changed_ = false;  ///< has a world changed step since complete()?
  bool is_complete_ = true;
};

}  // namespace pbmpi::solver
