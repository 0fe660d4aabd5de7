/// The actors of a recorded run.
#pragma once

#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::app {

struct RecordedActor {
  int world = 0;
  std::string name, kind;
};

struct RecordedActors {
  std::vector<RecordedActor> list;   ///< in the order of their first bodies
  std::vector<std::size_t> of_body;  ///< [N] row of `list`
};

RecordedActors actors_of(const io::BodyTable& bodies);

}  // namespace pbmpi::app
