/// main() of the tests that run on ranks: every rank runs every test, and the program fails if one rank
/// fails.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>

#include "mpi/comm/communicator.h"
#include "mpi/comm/session.h"

namespace {

/// Prints failures on ranks other than root, whose own printer reports the rest.
class FailurePrinter : public testing::EmptyTestEventListener {
 public:
  explicit FailurePrinter(int rank) : rank_(rank) {}

  void OnTestStart(const testing::TestInfo& info) override { test_ = &info; }
  void OnTestEnd(const testing::TestInfo&) override { test_ = nullptr; }
  void OnTestPartResult(const testing::TestPartResult& part) override {
    if (!part.failed()) return;
    std::fprintf(stderr, "[rank %d] %s.%s: %s:%d: %s\n", rank_, test_ ? test_->test_suite_name() : "",
                 test_ ? test_->name() : "", part.file_name() ? part.file_name() : "", part.line_number(),
                 part.message());
  }

 private:
  int rank_;
  const testing::TestInfo* test_ = nullptr;
};

void quiet_all_but_root(int rank) {
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank == pbmpi::mpi::Communicator::root) return;
  delete listeners.Release(listeners.default_result_printer());
  delete listeners.Release(listeners.default_xml_generator());
  listeners.Append(new FailurePrinter(rank));
}

}  // namespace

int main(int argc, char** argv) {
  const pbmpi::mpi::Session session(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  const pbmpi::mpi::Communicator world = pbmpi::mpi::Communicator::world();
  quiet_all_but_root(world.rank());
  std::array<std::int64_t, 1> failed = {RUN_ALL_TESTS()};
  world.allreduce(failed, pbmpi::mpi::Reduce::max);
  return failed[0] == 0 ? 0 : 1;
}
