/// Which contacts may be solved side by side.
#pragma once

#include <vector>

namespace pbmpi::solver {

/// Colours of contacts, such that no two of one colour share a body: each contact, in its given order, gets
/// the lowest colour that neither of its bodies has yet. The solver sweeps colour by colour, so that contacts
/// of one colour may be solved side by side, in any grouping, with the same bits. All contacts of a world are
/// coloured together, those with the environment included: a kind of contacts that is always swept last would
/// lag behind the others.
class ContactColors {
 public:
  /// Starts anew; bodies are 0 to num_bodies - 1.
  void start(int num_bodies);
  /// The colour of the next contact, between a body and another one (no_body: the environment, which excludes
  /// no colour).
  int paint(int body_a, int body_b);

 private:
  std::vector<unsigned long long> used_;  ///< [num_bodies] bit c = colour c is taken
  std::vector<int> next_;                 ///< [num_bodies] next colour from 64 on; empty until needed
};

}  // namespace pbmpi::solver
