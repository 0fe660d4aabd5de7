/// Which joints of a pack's worlds are broken (see also broken_lanes.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pbmpi::solver {

class BrokenJoints {
 public:
  void add_world();
  bool contains(int world, int joint) const;
  /// The joints that are broken there and whole here, ascending; until the next call. `broken_in`: as in
  /// model::State. Throws std::logic_error if one that is broken here is whole there: a pack cannot mend.
  std::span<const int> find_fresh(int world, std::span<const std::int32_t> broken_in);
  void set(int world, std::span<const std::int32_t> broken_in);

 private:
  std::vector<std::vector<std::int32_t>> worlds_;  ///< State::broken_in; none where nothing has broken
  std::vector<int> fresh_;
};

}  // namespace pbmpi::solver
