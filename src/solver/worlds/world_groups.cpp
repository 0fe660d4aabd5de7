#include "solver/worlds/world_groups.h"

#include <algorithm>
#include <utility>

#include "solver/pack/simd.h"
#include "solver/worlds/group_plan.h"

namespace pbmpi::solver {

/// Worlds that may share a group.
struct WorldGroups::Kind {
  const PackLaws* laws = nullptr;
  std::vector<SorWorld*> loose;     ///< in no group, ascending by id
  std::vector<WorldGroup*> groups;  ///< their groups, each once
  int num_worlds = 0;               ///< in groups or loose
  std::int64_t num_bodies = 0;      ///< theirs
};

void WorldGroups::add(SorWorld& world) {
  members_[world.id()] = {&world, {}};
  is_complete_ = false;
}

void WorldGroups::remove(const SorWorld& world) {
  dissolve_group_of(world);
  members_.erase(world.id());
}

void WorldGroups::dissolve_group_of(const SorWorld& world) {
  if (const Place at = place(world); at.group != nullptr) dissolve(*at.group);
}

void WorldGroups::dissolve(const WorldGroup& group) {
  for (const SorWorld* world : group.worlds()) members_.at(world->id()).place = {};
  std::erase_if(groups_, [&](const auto& one) { return one.get() == &group; });
  is_complete_ = false;
}

/// Worlds whose rows keep their order may be at different steps.
void WorldGroups::part_steps() {
  if (!std::exchange(steps_changed_, false) || settings_->law.row_order == stepping::RowOrder::fixed) return;
  std::vector<const WorldGroup*> parted;
  for (const auto& group : groups_) {
    if (!group->stands_at_one_step()) parted.push_back(group.get());
  }
  for (const WorldGroup* group : parted) dissolve(*group);
}

void WorldGroups::complete() {
  part_steps();
  if (std::exchange(is_complete_, true)) return;
  std::map<std::int64_t, std::vector<Kind>> kinds;  // by step
  std::int64_t bodies_of_all = 0;
  for (auto& [id, member] : members_) {
    SorWorld& world = *member.world;
    const bool any_step = settings_->law.row_order == stepping::RowOrder::fixed;
    std::vector<Kind>& alike = kinds[any_step ? 0 : world.step()];
    auto kind = std::ranges::find_if(alike, [&](const Kind& one) { return *one.laws == world.laws(); });
    if (kind == alike.end()) kind = alike.insert(alike.end(), {&world.laws(), {}, {}, 0, 0});
    if (member.place.group == nullptr) {
      kind->loose.push_back(&world);
    } else if (member.place.index == 0) {
      kind->groups.push_back(member.place.group);
    }
    ++kind->num_worlds;
    kind->num_bodies += world.model().num_bodies();
    bodies_of_all += world.model().num_bodies();
  }
  for (auto& [step, alike] : kinds) {
    for (Kind& kind : alike) {
      if (!kind.loose.empty()) deal(kind, bodies_of_all);
    }
  }
}

/// Keeps groups that are as large as they would be if all were made anew.
void WorldGroups::deal(Kind& kind, std::int64_t bodies_of_all) {
  const double share = static_cast<double>(kind.num_bodies) / static_cast<double>(bodies_of_all);
  const int num_packs = packs_for(kind.num_bodies, share, settings_->precision, settings_->threads);
  const int lanes = num_lanes(settings_->simd, settings_->precision);
  const GroupPlan plan(kind.num_worlds, num_packs, lanes);
  int kept = 0;
  for (const WorldGroup* group : kind.groups) {
    const std::span<SorWorld* const> worlds = group->worlds();
    if (kept + 1 < plan.num_packs() && plan.contains(static_cast<int>(worlds.size()))) {
      ++kept;
      continue;
    }
    kind.loose.insert(kind.loose.end(), worlds.begin(), worlds.end());
    dissolve(*group);
  }
  std::ranges::sort(kind.loose, {}, &SorWorld::id);
  std::span<SorWorld* const> rest(kind.loose);
  for (const int size : GroupPlan(static_cast<int>(rest.size()), plan.num_packs() - kept, lanes).sizes()) {
    make_group(rest.first(static_cast<std::size_t>(size)));
    rest = rest.subspan(static_cast<std::size_t>(size));
  }
  is_complete_ = true;
}

void WorldGroups::make_group(std::span<SorWorld* const> worlds) {
  groups_.push_back(
      std::make_unique<WorldGroup>(std::vector<SorWorld*>(worlds.begin(), worlds.end()), *settings_));
  for (std::size_t i = 0; i < worlds.size(); ++i)
    members_.at(worlds[i]->id()).place = {groups_.back().get(), static_cast<int>(i)};
}

}  // namespace pbmpi::solver
