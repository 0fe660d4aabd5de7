/// A pair of geoms that touch.
#pragma once

#include <numeric>
#include <vector>

#include "model/model.h"

namespace pbmpi::stepping {

/// Two geoms that touch at one or more points.
struct Touch {
  int body_a = model::no_body;  ///< a real body
  int body_b = model::no_body;
  int num_contacts = 0;
  int rows_per_contact = 1;  ///< 3 with friction
  bool cross_space = false;  ///< two real bodies whose geoms lie in different collision spaces
};

inline int count_contacts(const std::vector<Touch>& touches) {
  return std::accumulate(touches.begin(), touches.end(), 0,
                         [](int sum, const Touch& touch) { return sum + touch.num_contacts; });
}

}  // namespace pbmpi::stepping
