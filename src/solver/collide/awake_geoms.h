/// Which of a world's swept geoms belong to bodies that are awake, in chunks of lanes. Static geoms count as
/// asleep: pairs in which neither geom is awake are not tested.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "solver/layout/active_bodies.h"

namespace pbmpi::solver {

/// Geoms are indexed along the world's swept geoms.
class AwakeGeoms {
 public:
  /// `model` is borrowed, and so is `swept`, the world's swept geoms.
  AwakeGeoms(const model::Model& model, std::span<const int> swept, int num_lanes)
      : model_(&model), swept_(swept), num_lanes_(num_lanes) {}

  void find(const ActiveBodies& awake, int world);
  /// Appends the chunks of a pack's columns that hold awake geoms; worlds come in order. `first_column`: this
  /// world's.
  void add_chunks(int first_column, std::vector<int>& chunks) const;

  bool contains(int i) const { return (words_.data()[i / 32] >> (i % 32) & 1) != 0; }
  /// Bit b: is geom first + b awake? `first` is a multiple of num_lanes.
  std::uint32_t bits(int first) const { return words_.data()[first / 32] >> (first % 32); }
  /// The first geoms of the chunks that have an awake geom, ascending.
  std::span<const int> chunks() const { return {chunks_.data(), chunks_.size()}; }

 private:
  const model::Model* model_;
  std::span<const int> swept_;
  int num_lanes_;
  std::vector<std::uint32_t> words_;
  std::vector<int> chunks_;
};

}  // namespace pbmpi::solver
