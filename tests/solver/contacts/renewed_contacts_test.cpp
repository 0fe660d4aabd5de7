// The pieces of a step.
#include "solver/contacts/renewed_contacts.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace pbmpi::solver {
namespace {

TEST(SubstepsOfPiece, share_out_all_substeps_evenly) {
  for (int substeps = 1; substeps <= 40; ++substeps) {
    for (const int pieces : {2, 4, 8}) {
      int sum = 0, count = 0, least = substeps, most = 0;
      for (int substep = 0; substep < substeps; ++substep) {
        const int length = substeps_of_piece(substep, pieces, substeps);
        if (length == 0) continue;
        EXPECT_EQ(substep, sum) << "pieces follow each other";
        sum += length;
        ++count;
        least = std::min(least, length);
        most = std::max(most, length);
      }
      EXPECT_EQ(sum, substeps);
      EXPECT_EQ(count, std::min(pieces, substeps));
      EXPECT_LE(most - least, 1);
    }
  }
}

// Islands with half as many pieces get no contacts at other times.
TEST(SubstepsOfPiece, begin_together_where_numbers_divide) {
  for (int substep = 0; substep < 14; ++substep) {
    EXPECT_TRUE(substeps_of_piece(substep, 2, 14) == 0 || substeps_of_piece(substep, 4, 14) > 0);
    EXPECT_TRUE(substeps_of_piece(substep, 4, 14) == 0 || substeps_of_piece(substep, 8, 14) > 0);
  }
}

}  // namespace
}  // namespace pbmpi::solver
