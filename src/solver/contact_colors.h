/// The order in which contacts are solved.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace pbmpi::solver {

/// Colours of contacts, such that no two of one colour share a body: each contact, in its given order, gets
/// the lowest colour that neither of its bodies has yet. The solver sweeps colour by colour, so that contacts
/// of one colour may be solved side by side, in any grouping, with the same bits.
class ContactColors {
 public:
  /// `bodies`: the two bodies of each contact (no_body = the environment, which blocks nothing). Colours go
  /// to `colors`, [contacts]; returns their number.
  int paint(int num_bodies, std::span<const std::pair<int, int>> bodies, std::vector<int>& colors);

 private:
  std::vector<unsigned long long> used_;  ///< [num_bodies] bit c = colour c is taken
  std::vector<int> next_;                 ///< [num_bodies] lowest free colour from 64 on
};

}  // namespace pbmpi::solver
