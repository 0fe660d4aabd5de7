/// The islands of a world in a step: bodies connected by unbroken joints and the step's contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/islands.h"
#include "model/model.h"

namespace pbmpi::solver {

class StepIslands {
 public:
  /// `model` is borrowed.
  explicit StepIslands(const model::Model& model);

  /// Connects bodies by unbroken joints. `broken_in`: State::broken_in.
  void connect_joints(std::span<const std::int32_t> broken_in);
  /// The lowest of the bodies that unbroken joints connect to this one, as of the last connect_joints().
  int unit_of(int body) { return jointed_.find(body); }
  /// Connects bodies by unbroken joints and by `contacts`, which are in canonical order.
  void connect(std::span<const model::Contact> contacts, std::span<const std::int32_t> broken_in);
  /// The lowest body of this body's island, as of the last connect().
  int find(int body) { return islands_.find(body); }

 private:
  const model::Model* model_;
  std::vector<std::int32_t> broken_in_;  ///< for which jointed_ holds
  model::DisjointSets jointed_;          ///< bodies that unbroken joints connect
  model::DisjointSets islands_;
};

/// A set of marked islands.
class IslandMarks {
 public:
  explicit IslandMarks(const model::Model& model) : marks_(model.bodies.size(), 0) {}

  /// Removes the marks of the islands of these bodies, which are whole islands.
  void clear(std::span<const int> bodies) {
    for (const int body : bodies) marks_[static_cast<std::size_t>(body)] = 0;
  }
  void mark(int body, StepIslands& islands) { marks_[static_cast<std::size_t>(islands.find(body))] = 1; }
  bool has(int body, StepIslands& islands) const {
    return marks_[static_cast<std::size_t>(islands.find(body))] != 0;
  }

 private:
  std::vector<char> marks_;  ///< [num_bodies] an island's mark is at its lowest body
};

}  // namespace pbmpi::solver
