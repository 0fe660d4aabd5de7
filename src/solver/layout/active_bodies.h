/// Which bodies of a pack's worlds are active.
#pragma once

#include <span>
#include <vector>

namespace pbmpi::solver {

/// At the start all bodies are. Data derived from them must be derived anew when the revision changes.
class ActiveBodies {
 public:
  void add_world(int num_bodies);
  /// Makes exactly these bodies of this world active from now on.
  void set(int world, std::span<const int> bodies);

  std::span<const int> of(int world) const { return worlds_[static_cast<std::size_t>(world)].bodies; }
  bool contains(int world, int body) const {
    return worlds_[static_cast<std::size_t>(world)].is_active.data()[body] != 0;
  }
  long revision() const { return revision_; }  ///< rises with a change in any world; 0 at the start

 private:
  struct World {
    std::vector<int> bodies;
    std::vector<char> is_active;  ///< [num_bodies]
  };
  std::vector<World> worlds_;
  long revision_ = 0;
};

}  // namespace pbmpi::solver
