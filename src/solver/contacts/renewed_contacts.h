/// Contacts that are found anew within a step.
#pragma once

#include <span>

#include "model/step_memory.h"

namespace pbmpi::solver {

/// A step may have islands whose contacts do not serve all its substeps: it is cut into pieces for them, and
/// each piece begins with contacts of its own. Such islands form groups by their number of pieces. Worlds are
/// those of the pack.
class RenewedContacts {
 public:
  RenewedContacts() = default;
  RenewedContacts(const RenewedContacts&) = delete;
  RenewedContacts& operator=(const RenewedContacts&) = delete;
  virtual ~RenewedContacts() = default;

  /// The number of pieces of each group: ascending, each above 1.
  virtual std::span<const int> pieces() const = 0;
  /// The bodies of a world in a group.
  virtual std::span<const int> bodies(std::size_t group, int world) const = 0;
  /// The bodies of a world that approach others in this step, or are approached.
  virtual std::span<const int> approaching(int world) const = 0;
  /// [num_worlds] The contacts of a group, in canonical order, and the forces with which they start and end;
  /// valid until its next find().
  virtual std::span<const model::SolvedContacts> contacts(std::size_t group) const = 0;
  /// Finds the contacts of a group at the present poses, for a piece of `piece_s`.
  virtual void find(std::size_t group, double piece_s) = 0;
};

/// The number of substeps of the piece that begins with a substep; 0 if none does. Pieces are as equally long
/// as whole substeps allow; with fewer substeps than pieces each substep is a piece.
constexpr int substeps_of_piece(int substep, int pieces, int substeps) {
  // Piece k begins with substep floor(k substeps / pieces).
  const auto begins = [&](int at) {
    const int first = (at * pieces + substeps - 1) / substeps;
    return first * substeps < (at + 1) * pieces;
  };
  if (!begins(substep)) return 0;
  int end = substep + 1;
  while (end < substeps && !begins(end)) ++end;
  return end - substep;
}

}  // namespace pbmpi::solver
