/// The outcomes of a study's cases as they come, with which a stopped or killed study can go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/system/descriptor.h"

namespace pbmpi::app {

/// One file per rank, beside the study's: OUTPUT.cases-RANK. It begins with "PBMPICAS" and the study's key;
/// then come records: the index of a case, the number of its bytes, their checksum, and the bytes. A record
/// that a kill cut off does not count. The journals of a study belong to whoever holds the lock of its file.
class CaseJournal {
 public:
  /// Opens this rank's journal, to append to it. `key`: hash of everything that the outcomes depend on.
  /// Throws core::InputError if the journal cannot be created, core::RunError if it cannot be written.
  CaseJournal(const std::string& output, int rank, std::uint64_t key);

  /// Waits until the outcome is on the disk. A journal that somebody has removed is begun anew, with a
  /// warning. Throws core::RunError.
  void add(std::int64_t index, std::span<const std::byte> outcome);

 private:
  /// Both return 0, or the errno of the failure.
  int begin_anew();
  int append(std::span<const std::byte> record);

  std::string path_;
  std::uint64_t key_;
  core::Descriptor file_;
};

/// The outcomes by case in the journals of this study, of all ranks. Throws core::InputError if a journal's
/// key is another study's.
std::map<std::int64_t, std::vector<std::byte>> read_case_journals(const std::string& output,
                                                                  std::uint64_t key);

/// Removes the journals of all ranks.
void remove_case_journals(const std::string& output);

}  // namespace pbmpi::app
