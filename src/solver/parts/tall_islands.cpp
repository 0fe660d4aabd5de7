#include "solver/parts/tall_islands.h"

#include <algorithm>
#include <limits>

#include "geometry/measures.h"
#include "solver/pack/step_settings.h"

namespace pbmpi::solver {
namespace {

/// Share of its bodies' size by which the top of an island may sink.
constexpr double most_sink = 0.01;
/// Factor by which the substeps of an island grow while it sinks too far.
constexpr double more_substeps = 1.25;
/// The level of a unit to which no contacts lead from the environment.
constexpr int unreached = std::numeric_limits<int>::max() / 2;

}  // namespace

TallIslands::TallIslands(const model::Model& model, const stepping::StepperSettings& settings)
    : model_(&model),
      settings_(settings),
      size_m_(geometry::sizes_of(model)),
      most_levels_(adds_substeps(settings) ? model.num_bodies() : 0),
      least_tall_(1) {
  // An island has at least as many bodies as levels, so that their mean size is not below that of the model's
  // smallest bodies.
  std::vector<double> sizes = size_m_;
  std::ranges::sort(sizes);
  double sum_m = 0;
  for (; can_be(); ++least_tall_) {
    sum_m += sizes[static_cast<std::size_t>(least_tall_ - 1)];
    if (sink_m(least_tall_, settings.substeps) > most_sink * sum_m / least_tall_) break;
  }
  if (can_be()) substeps_.resize(model.bodies.size());
}

double TallIslands::sink_m(int levels, double substeps) const {
  Spring spring = contact_spring(settings_);
  spring.frequency_hz *= substeps / settings_.substeps;
  return 0.5 * levels * levels * model_->gravity.norm() * spring.give_in(settings_.dt_s / substeps);
}

int TallIslands::substeps_for(int levels, double size_m) const {
  double substeps = settings_.substeps;
  while (substeps < settings_.law.most_substeps && sink_m(levels, substeps) > most_sink * size_m)
    substeps *= more_substeps;
  return std::min(static_cast<int>(substeps), settings_.law.most_substeps);
}

/// Passes levels from each unit to those that it touches, forth and back over the contacts until nothing
/// changes: they are mostly sorted from below.
int TallIslands::count_levels(std::span<const model::Contact> contacts, StepIslands& islands) {
  level_.assign(model_->bodies.size(), unreached);
  touching_.clear();
  for (const model::Contact& contact : contacts) {
    const int a = islands.unit_of(contact.body_a);
    if (contact.body_b == model::no_body) {
      level_[static_cast<std::size_t>(a)] = 1;
      continue;
    }
    const std::pair pair(a, islands.unit_of(contact.body_b));
    if (touching_.empty() || touching_.back() != pair) touching_.push_back(pair);
  }
  bool changes = true;
  const auto pass_on = [&](const std::pair<int, int>& pair) {
    int &a = level_[static_cast<std::size_t>(pair.first)], &b = level_[static_cast<std::size_t>(pair.second)];
    const int lower = std::min(a, b) + 1;
    if (std::max(a, b) <= lower) return;
    (a > b ? a : b) = lower;
    changes = true;
  };
  while (changes) {
    changes = false;
    std::ranges::for_each(touching_, pass_on);
    if (changes) std::for_each(touching_.rbegin(), touching_.rend(), pass_on);
  }
  int highest = 0;
  for (int& level : level_) {
    if (level >= unreached) level = 0;
    highest = std::max(highest, level);
  }
  return highest;
}

bool TallIslands::find(std::span<const int> bodies, std::span<const model::Contact> contacts,
                       std::span<const std::int32_t> broken_in, StepIslands& islands) {
  islands.connect_joints(broken_in);
  if (count_levels(contacts, islands) < least_tall_) return false;
  islands.connect(contacts, broken_in);
  islands_.assign(model_->bodies.size(), {});
  for (const int body : bodies) {
    Island& island = islands_[static_cast<std::size_t>(islands.find(body))];
    island.levels = std::max(island.levels, level_[static_cast<std::size_t>(islands.unit_of(body))]);
    island.size_m += size_m_[static_cast<std::size_t>(body)];
    ++island.num_bodies;
  }
  bool any = false;
  for (const int body : bodies) {
    const Island& island = islands_[static_cast<std::size_t>(islands.find(body))];
    const int substeps = island.levels < least_tall_
                             ? settings_.substeps
                             : substeps_for(island.levels, island.size_m / island.num_bodies);
    substeps_[static_cast<std::size_t>(body)] = substeps;
    any |= substeps > settings_.substeps;
  }
  return any;
}

}  // namespace pbmpi::solver
