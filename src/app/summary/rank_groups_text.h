/// Groups of ranks as text, in files and in words.
#pragma once

#include <string>

#include "mpi/spaces/plan/rank_groups.h"

namespace pbmpi::app {

/// "2:34,2:33,1:33": ranks and worlds of each group, as files have them.
std::string to_text(const mpi::RankGroups& groups);
/// No groups where the text has another form, as in files without groups.
mpi::RankGroups rank_groups_from_text(const std::string& text);

/// "3 groups of 1 to 2 ranks"
std::string in_words(const mpi::RankGroups& groups);

}  // namespace pbmpi::app
