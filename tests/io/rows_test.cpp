#include "io/hdf5/rows.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pbmpi::io::test {
namespace {

Dataspace space_of(const std::vector<hsize_t>& dims) {
  return owned<Dataspace>(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                          "H5Screate_simple");
}

hssize_t num_selected(const Dataspace& space) { return H5Sget_select_npoints(space.id()); }

TEST(Ranges, merges_neighbours_and_drops_empty_ones) {
  std::vector<Range> ranges;
  append_range(ranges, 3, 2);
  append_range(ranges, 5, 0);
  append_range(ranges, 5, 4);
  append_range(ranges, 10, 1);
  EXPECT_EQ(ranges, (std::vector<Range>{{3, 6}, {10, 1}}));
  EXPECT_EQ(count_items(ranges), 7u);
}

TEST(SelectRanges, selects_the_ranges_and_all_that_is_in_their_items) {
  const Dataspace space = space_of({6, 3});
  select_ranges(space, {{0, 1}, {4, 2}});
  EXPECT_EQ(num_selected(space), 3 * 3);
  const hsize_t start[2] = {4, 0}, count[2] = {2, 3};
  ASSERT_GE(H5Sselect_hyperslab(space.id(), H5S_SELECT_AND, start, nullptr, count, nullptr), 0);
  EXPECT_EQ(num_selected(space), 2 * 3);
  select_ranges(space, {});
  EXPECT_EQ(num_selected(space), 0) << "a rank without items";
}

TEST(SelectRows, selects_whole_rows_and_returns_their_space_in_memory) {
  const Dataspace space = space_of({6, 3});
  const Dataspace in_memory = select_rows(space, {4, 2});
  EXPECT_EQ(num_selected(space), 2 * 3);
  EXPECT_EQ(extent_of(in_memory), (std::vector<hsize_t>{2, 3}));
  EXPECT_EQ(num_selected(select_rows(space, {})), 0) << "a rank without rows";
  EXPECT_EQ(num_selected(space), 0);
  EXPECT_EQ(num_selected(select_rows(space_of({}), {0, 1})), 1) << "a scalar counts as one row";
}

TEST(ShareOfRows, gives_each_row_to_exactly_one_rank_in_nearly_equal_shares) {
  for (const hsize_t num_rows : {0, 1, 2, 7, 1000}) {
    for (int num_ranks = 1; num_ranks <= 9; ++num_ranks) {
      const hsize_t fair = num_rows / static_cast<hsize_t>(num_ranks);
      hsize_t next = 0;
      for (int rank = 0; rank < num_ranks; ++rank) {
        const Range share = share_of_rows(num_rows, rank, num_ranks);
        EXPECT_EQ(share.first, next);
        EXPECT_GE(share.count, fair);
        EXPECT_LE(share.count, fair + 1);
        next += share.count;
      }
      EXPECT_EQ(next, num_rows);
    }
  }
}

class ChunkShape : public testing::TestWithParam<std::vector<hsize_t>> {};

TEST_P(ChunkShape, has_1_to_4_mebibytes_or_the_whole_dataset_and_wastes_less_than_a_row_a_chunk) {
  const std::vector<hsize_t>& dims = GetParam();
  const std::vector<hsize_t> chunk = chunk_shape(dims, 8);
  const auto product = [](const std::vector<hsize_t>& v) {
    return std::accumulate(v.begin(), v.end(), hsize_t{8}, std::multiplies<>());
  };
  for (std::size_t d = 0; d < dims.size(); ++d) EXPECT_LE(chunk[d], std::max<hsize_t>(dims[d], 1));
  if (product(dims) > (hsize_t{1} << 20)) {
    EXPECT_GE(product(chunk), hsize_t{1} << 20);
  }
  EXPECT_LE(product(chunk), hsize_t{4} << 20);
  const hsize_t num_chunks = (dims[0] + chunk[0] - 1) / chunk[0];
  EXPECT_LT(num_chunks * chunk[0], dims[0] + num_chunks);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ChunkShape,
                         testing::Values(std::vector<hsize_t>{8, 3700, 3},
                                         std::vector<hsize_t>{1000, 3700, 4}, std::vector<hsize_t>{1000000},
                                         std::vector<hsize_t>{1, 1, 3}, std::vector<hsize_t>{10, 1000000, 3},
                                         std::vector<hsize_t>{37, 9000, 3},
                                         std::vector<hsize_t>{100000, 100}));

}  // namespace
}  // namespace pbmpi::io::test
