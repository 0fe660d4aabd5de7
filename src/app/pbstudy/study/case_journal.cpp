#include "app/pbstudy/study/case_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "core/error.h"
#include "core/system/input_file.h"
#include "core/system/seal.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "PBMPICAS";
constexpr std::size_t most_bytes = std::size_t{4} << 30;

using Word = std::uint64_t;
using Words2 = std::array<Word, 2>;
using Words3 = std::array<Word, 3>;

std::string prefix_of(const std::string& output) { return output + ".cases-"; }

Words2 head_of(Word key) {
  Words2 head = {0, key};
  std::memcpy(head.data(), magic.data(), magic.size());
  return head;
}

template <class Words>
std::span<const std::byte> bytes_of_words(const Words& words) {
  return std::as_bytes(std::span(words));
}

std::vector<std::string> journals_of(const std::string& output) {
  std::vector<std::string> paths;
  const fs::path folder = fs::path(output).has_parent_path() ? fs::path(output).parent_path() : fs::path(".");
  const std::string start = fs::path(prefix_of(output)).filename().string();
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::string rank = name.starts_with(start) ? name.substr(start.size()) : "";
    if (!rank.empty() && rank.find_first_not_of("0123456789") == std::string::npos)
      paths.push_back(entry.path().string());
  }
  return paths;
}

Word checksum_of(std::span<const std::byte> bytes) {
  core::Checksum checksum;
  checksum.add(bytes);
  return checksum.value();
}

/// The records of a journal, until the first incomplete one; `length`: where they end.
std::map<std::int64_t, std::vector<std::byte>> records_of(std::span<const std::byte> bytes,
                                                          std::size_t& length) {
  std::map<std::int64_t, std::vector<std::byte>> records;
  length = sizeof(Words2);
  while (bytes.size() - length >= sizeof(Words3)) {
    Words3 head;
    std::memcpy(head.data(), bytes.data() + length, sizeof head);
    const auto [index, size, checksum] = head;
    const std::span<const std::byte> rest = bytes.subspan(length + sizeof head);
    if (size > rest.size() || checksum != checksum_of(rest.first(size))) break;
    records[static_cast<std::int64_t>(index)].assign(rest.begin(),
                                                     rest.begin() + static_cast<std::ptrdiff_t>(size));
    length += sizeof head + size;
  }
  return records;
}

/// A journal's bytes; empty if a kill left less than its head. Throws core::InputError for another study's.
std::string read_journal(const std::string& path, Word key) {
  std::string text = core::read_input_file(path, "remove it, or leave --resume out", most_bytes);
  if (text.size() < sizeof(Words2)) return "";
  core::require_input(
      std::memcmp(text.data(), head_of(key).data(), sizeof(Words2)) == 0,
      path +
          ": it holds cases of another study (other options, scenes or another build); give the options "
          "of that study, remove the file, or leave --resume out");
  return text;
}

}  // namespace

CaseJournal::CaseJournal(const std::string& output, int rank, std::uint64_t key)
    : path_(prefix_of(output) + std::to_string(rank)), key_(key), file_(path_, O_RDWR | O_CREAT) {
  core::require_input(file_.is_open(), path_ + ": cannot be created: " + core::reason_of(errno) +
                                           "; it keeps the study's cases as they are done");
  // Removes a record that a kill cut off, so that what is appended can be read.
  const std::string text = read_journal(path_, key);
  std::size_t length = 0;
  if (!text.empty()) records_of(std::as_bytes(std::span(text)), length);
  int error = ftruncate(file_.get(), static_cast<off_t>(length)) == 0 ? 0 : errno;
  if (error == 0 && lseek(file_.get(), 0, SEEK_END) < 0) error = errno;
  if (error == 0 && length == 0) error = file_.write(bytes_of_words(head_of(key)));
  if (error != 0) throw core::RunError(path_ + ": cannot be written: " + core::reason_of(error));
}

void CaseJournal::add(std::int64_t index, std::span<const std::byte> outcome) {
  const Words3 head = {static_cast<Word>(index), outcome.size(), checksum_of(outcome)};
  std::vector<std::byte> record(sizeof head + outcome.size());
  std::memcpy(record.data(), head.data(), sizeof head);
  if (!outcome.empty()) std::memcpy(record.data() + sizeof head, outcome.data(), outcome.size());
  int error = file_.is_at(path_) ? 0 : begin_anew();
  if (error == 0) error = append(record);
  if (error != 0) throw core::RunError(path_ + ": cannot be written: " + core::reason_of(error));
}

int CaseJournal::begin_anew() {
  file_ = core::Descriptor(path_, O_RDWR | O_CREAT | O_TRUNC);
  if (!file_.is_open()) return errno;
  std::cerr << "pbstudy: warning: " << path_
            << " was removed by somebody; --resume would do its earlier cases again" << std::endl;
  return file_.write(bytes_of_words(head_of(key_)));
}

int CaseJournal::append(std::span<const std::byte> record) {
  const int error = file_.write(record);
  return error == 0 && fdatasync(file_.get()) != 0 ? errno : error;
}

std::map<std::int64_t, std::vector<std::byte>> read_case_journals(const std::string& output,
                                                                  std::uint64_t key) {
  std::map<std::int64_t, std::vector<std::byte>> all;
  for (const std::string& path : journals_of(output)) {
    const std::string text = read_journal(path, key);
    std::size_t length = 0;
    if (!text.empty()) all.merge(records_of(std::as_bytes(std::span(text)), length));
  }
  return all;
}

void remove_case_journals(const std::string& output) {
  for (const std::string& path : journals_of(output)) {
    std::error_code error;
    fs::remove(path, error);
  }
}

}  // namespace pbmpi::app
