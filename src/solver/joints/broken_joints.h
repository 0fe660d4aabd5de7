/// Which joints of a pack's worlds are broken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pbmpi::solver {

class BrokenJoints {
 public:
  void add_world();
  bool contains(int world, int joint) const;
  /// The joints that are broken in `broken_in` (State::broken_in) and unbroken here, ascending; valid until
  /// the next call. Throws std::logic_error if a joint that is broken here is unbroken there: a pack cannot
  /// mend joints.
  std::span<const int> find_fresh(int world, std::span<const std::int32_t> broken_in);
  void set(int world, std::span<const std::int32_t> broken_in);

 private:
  std::vector<std::vector<std::int32_t>> worlds_;  ///< State::broken_in; empty where nothing has broken
  std::vector<int> fresh_;
};

}  // namespace pbmpi::solver
