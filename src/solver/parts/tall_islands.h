/// Which islands of a world are so tall that they get more substeps than others.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "solver/parts/step_islands.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Contacts of sor are springs of a frequency w / 2 pi, which give by g / w^2 under a body's own weight, and
/// by n times that under n bodies. So the top of a pile of n levels sinks by about n^2 / 2 g / w^2, by
/// default by 0.2 mm at ten levels and by 20 mm at a hundred. The springs of more substeps are stiffer.
/// Islands that would sink by more than a hundredth of their bodies get a quarter more substeps, and again,
/// until they do not, or have the most that a run gives.
///
/// A unit (what whole joints hold together) stands as many levels high as there are contacts between it and
/// the environment, by the shortest way. So what an island gets depends on its contacts alone.
class TallIslands {
 public:
  /// `model` is borrowed.
  TallIslands(const model::Model& model, const stepping::StepperSettings& settings);

  /// Can there be a tall island in a world of this model, by its number of bodies?
  bool can_be() const { return least_tall_ <= most_levels_; }

  /// Finds the islands of these bodies, which are whole islands, that are tall; is any?
  /// `contacts` in canonical order; `broken_in`: as State has it.
  bool find(std::span<const int> bodies, std::span<const model::Contact> contacts,
            std::span<const std::int32_t> broken_in, StepIslands& islands);
  /// After a find() that found any: the substeps of the body's island.
  int substeps(int body) const { return substeps_[static_cast<std::size_t>(body)]; }

 private:
  /// [m] By how much the top of so many levels sinks with the springs of so many substeps.
  double sink_m(int levels, double substeps) const;
  int substeps_for(int levels, double size_m) const;
  /// Sets the level of each unit, 0 where no contacts lead to it; returns the highest.
  int count_levels(std::span<const model::Contact> contacts, StepIslands& islands);

  const model::Model* model_;
  stepping::StepperSettings settings_;
  std::vector<double> size_m_;  ///< [num_bodies]
  int most_levels_;             ///< that the model's bodies can have
  int least_tall_;              ///< levels of which the model's smallest bodies would sink too far
  std::vector<int> substeps_;   ///< [num_bodies]

  struct Island {
    int levels = 0, num_bodies = 0;
    double size_m = 0;  ///< of all bodies
  };
  // Scratch. A unit or an island is kept at its lowest body.
  std::vector<std::pair<int, int>> touching_;  ///< units
  std::vector<int> level_;
  std::vector<Island> islands_;
};

}  // namespace pbmpi::solver
