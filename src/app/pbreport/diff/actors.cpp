#include "app/pbreport/diff/actors.h"

#include <map>
#include <utility>

namespace pbmpi::app {

RecordedActors actors_of(const io::BodyTable& bodies) {
  RecordedActors actors;
  std::map<std::pair<int, std::string>, std::size_t> known;
  for (std::size_t i = 0; i < bodies.id.size(); ++i) {
    const auto [entry, is_new] = known.try_emplace({bodies.world[i], bodies.actor[i]}, actors.list.size());
    if (is_new) actors.list.push_back({bodies.world[i], bodies.actor[i], bodies.kind[i]});
    actors.of_body.push_back(entry->second);
  }
  return actors;
}

}  // namespace pbmpi::app
