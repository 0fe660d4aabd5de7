/// The outcomes of a study's cases as they come: what a study that is stopped, or killed, goes on from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/system/descriptor.h"

namespace pbmpi::app {

/// A file a rank, beside that of the study: OUTPUT.cases-RANK. It begins with "PBMPICAS" and the study's key;
/// then come records: the index of a case, the number of its bytes, their checksum, and they. A record that a
/// kill has cut off is none. The journals of a study belong to whoever holds the lock of its file.
class CaseJournal {
 public:
  /// Opens this rank's, to append to it. `key`: of all that the outcomes depend on. Throws core::InputError
  /// if it cannot be written.
  CaseJournal(const std::string& output, int rank, std::uint64_t key);

  /// Waits until it is on the disk. Throws core::RunError.
  void add(std::int64_t index, std::span<const std::byte> outcome);

 private:
  std::string path_;
  core::Descriptor file_;
};

/// The outcomes by case that journals of this study hold, of whichever ranks. Throws core::InputError if one
/// is of another study, by its key.
std::map<std::int64_t, std::vector<std::byte>> read_case_journals(const std::string& output,
                                                                  std::uint64_t key);

/// Removes all of them.
void remove_case_journals(const std::string& output);

}  // namespace pbmpi::app
