/// Shared by the tests on ranks: root's scratch folder, and a function that begins a file there.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "io/run/run_file.h"
#include "mpi/comm/communicator.h"
#include "sample_run.h"
#include "scratch.h"

namespace pbmpi::io::test {

inline FileGroup group_of(const mpi::Communicator& comm) {
  return {comm.fortran_handle(), comm.rank(), comm.size()};
}

/// Root's scratch folder, known to every rank; removed when all are done with it.
class SharedFolder {
 public:
  explicit SharedFolder(const mpi::Communicator& comm) : comm_(comm) {
    std::array<char, 256> name{};
    if (comm.is_root()) {
      scratch_ = std::make_unique<Scratch>();
      scratch_->folder().string().copy(name.data(), name.size() - 1);
    }
    comm.bcast(std::span<char>(name));
    folder_ = name.data();
  }
  ~SharedFolder() { comm_.barrier(); }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;

  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  /// Root only.
  std::size_t num_files() const { return scratch_->num_files(); }

 private:
  const mpi::Communicator& comm_;
  std::unique_ptr<Scratch> scratch_;
  std::string folder_;
};

inline Sample sample_on(const mpi::Communicator& comm) {
  Sample sample;
  sample.num_ranks = comm.size();
  sample.rank = comm.rank();
  return sample;
}

/// A file with the first `num_frames` frames of the sample, not closed.
inline std::unique_ptr<RunFile> begin_run(const mpi::Communicator& comm, const Sample& sample,
                                          const std::string& path, std::int64_t num_frames) {
  const RankWorlds at_start(sample, 0);
  auto file = std::make_unique<RunFile>(group_of(comm), sample_setup(sample, at_start, path));
  for (std::int64_t k = 0; k < num_frames; ++k) put_frame(*file, sample, k);
  return file;
}

}  // namespace pbmpi::io::test
