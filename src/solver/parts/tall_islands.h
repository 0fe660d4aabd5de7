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
/// by n times as much under n bodies. The top of a pile of n levels thus sinks by about n^2 / 2 g / w^2, by
/// default by 0.2 mm at ten levels and by 20 mm at a hundred. With more substeps the springs are stiffer.
/// Islands that would sink by more than a hundredth of their bodies' size get a quarter more substeps,
/// repeatedly, until they no longer do, or have the most that the run allows.
///
/// The level of a unit (bodies connected by unbroken joints) is the number of contacts on the shortest path
/// from it to the environment. An island's substeps thus depend on its contacts alone.
class TallIslands {
 public:
  /// `model` is borrowed.
  TallIslands(const model::Model& model, const stepping::StepperSettings& settings);

  /// Can a world of this model have a tall island, given its number of bodies?
  bool can_be() const { return least_tall_ <= most_levels_; }

  /// Finds the tall islands among these bodies, which make up whole islands. True if there are any.
  /// `contacts` in canonical order; `broken_in`: State::broken_in.
  bool find(std::span<const int> bodies, std::span<const model::Contact> contacts,
            std::span<const std::int32_t> broken_in, StepIslands& islands);
  /// After a find() that found any: the substeps of the body's island.
  int substeps(int body) const { return substeps_[static_cast<std::size_t>(body)]; }

 private:
  /// [m] By how much the top of `levels` levels sinks with the springs of `substeps` substeps.
  double sink_m(int levels, double substeps) const;
  int substeps_for(int levels, double size_m) const;
  /// Sets the level of each unit, 0 where no contacts lead to it from the environment; returns the highest.
  int count_levels(std::span<const model::Contact> contacts, StepIslands& islands);

  const model::Model* model_;
  stepping::StepperSettings settings_;
  std::vector<double> size_m_;  ///< [num_bodies]
  int most_levels_;             ///< most levels that the model's bodies can form
  int least_tall_;              ///< fewest levels at which the model's smallest bodies would sink too far
  std::vector<int> substeps_;   ///< [num_bodies]

  struct Island {
    int levels = 0, num_bodies = 0;
    double size_m = 0;  ///< sum over its bodies
  };
  // Scratch. Values of a unit or an island are at its lowest body.
  std::vector<std::pair<int, int>> touching_;  ///< pairs of units
  std::vector<int> level_;
  std::vector<Island> islands_;
};

}  // namespace pbmpi::solver
