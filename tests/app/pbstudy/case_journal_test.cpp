#include "app/pbstudy/study/case_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/pbstudy/study/case_outcome.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;

/// Has no padding, whose bytes would be arbitrary.
struct Number {
  std::int64_t index = 0;
  double value = 0;
};
struct Row {
  std::int32_t case_index = 0;
  float value = 0;
};
using Outcome = CaseOutcome<Number, Row>;

std::vector<std::byte> outcome(int index) {
  Outcome made{{index, 0.5 * index}, {}};
  for (int i = 0; i < index; ++i) made.rows_of<Row>().push_back({index, static_cast<float>(i)});
  return bytes_of(made);
}

class CaseJournalTest : public testing::Test {
 protected:
  CaseJournalTest() : folder_(fs::temp_directory_path() / ("pbmpi-journal-" + std::to_string(getpid()))) {
    fs::create_directory(folder_);
  }
  ~CaseJournalTest() override { fs::remove_all(folder_); }
  std::string output() const { return (folder_ / "study.h5").string(); }
  std::string journal(int rank) const { return output() + ".cases-" + std::to_string(rank); }

  fs::path folder_;
};

TEST_F(CaseJournalTest, cases_of_all_ranks_are_read_as_they_were_added) {
  for (int rank = 0; rank < 3; ++rank) {
    CaseJournal journal(output(), rank, 7);
    for (int index = rank; index < 9; index += 3) journal.add(index, outcome(index));
  }
  const auto kept = read_case_journals(output(), 7);
  ASSERT_EQ(kept.size(), 9u);
  for (const auto& [index, bytes] : kept) {
    EXPECT_EQ(bytes, outcome(static_cast<int>(index)));
    const auto read = outcome_of<Number, Row>(bytes);
    EXPECT_EQ(read.result.value, 0.5 * static_cast<double>(index));
    EXPECT_EQ(std::get<0>(read.rows).size(), static_cast<std::size_t>(index));
  }
}

TEST_F(CaseJournalTest, a_rank_goes_on_in_its_journal) {
  CaseJournal(output(), 0, 7).add(1, outcome(1));
  CaseJournal(output(), 0, 7).add(2, outcome(2));
  EXPECT_EQ(read_case_journals(output(), 7).size(), 2u);
}

TEST_F(CaseJournalTest, wherever_a_kill_cuts_it_off_the_whole_records_are_read_and_the_next_can_be_added) {
  {
    CaseJournal journal(output(), 0, 7);
    journal.add(0, outcome(3));
    journal.add(1, outcome(4));
  }
  const std::uintmax_t whole = fs::file_size(journal(0));
  const std::uintmax_t first = 16 + 24 + outcome(3).size();
  for (std::uintmax_t length = 0; length < whole; ++length) {
    fs::copy_file(journal(0), output() + ".copy", fs::copy_options::overwrite_existing);
    fs::resize_file(journal(0), length);
    EXPECT_EQ(read_case_journals(output(), 7).size(), length >= first ? 1u : 0u) << length;
    CaseJournal(output(), 0, 7).add(5, outcome(5));
    EXPECT_EQ(read_case_journals(output(), 7).count(5), 1u) << length;
    fs::copy_file(output() + ".copy", journal(0), fs::copy_options::overwrite_existing);
  }
}

TEST_F(CaseJournalTest, a_changed_byte_is_noticed) {
  CaseJournal(output(), 0, 7).add(3, outcome(3));
  const std::uintmax_t size = fs::file_size(journal(0));
  for (std::uintmax_t place = 16 + 8; place < size; ++place) {
    std::fstream file(journal(0), std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(static_cast<std::streamoff>(place));
    const char byte = static_cast<char>(file.get() ^ 4);
    file.seekp(static_cast<std::streamoff>(place));
    file.put(byte).flush();
    EXPECT_TRUE(read_case_journals(output(), 7).empty()) << place;
    file.seekp(static_cast<std::streamoff>(place));
    file.put(static_cast<char>(byte ^ 4)).flush();
  }
}

TEST_F(CaseJournalTest, another_study_is_refused_and_told) {
  CaseJournal(output(), 0, 7).add(3, outcome(3));
  const auto message = [&](auto&& call) -> std::string {
    try {
      call();
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([&] { read_case_journals(output(), 8); }), testing::HasSubstr("another study"));
  EXPECT_THAT(message([&] { CaseJournal(output(), 0, 8); }), testing::HasSubstr("--resume"));
}

TEST_F(CaseJournalTest, only_journals_of_the_output_are_removed) {
  CaseJournal(output(), 0, 7).add(3, outcome(3));
  CaseJournal(output() + ".other", 0, 7).add(3, outcome(3));
  std::ofstream(output() + ".cases-notes") << "mine";
  remove_case_journals(output());
  EXPECT_FALSE(fs::exists(journal(0)));
  EXPECT_TRUE(fs::exists(output() + ".other.cases-0"));
  EXPECT_TRUE(fs::exists(output() + ".cases-notes"));
}

TEST(CaseOutcomeTest, what_is_cut_off_or_too_long_is_refused) {
  std::vector<std::byte> bytes = outcome(3);
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW((outcome_of<Number, Row>(std::span(bytes).first(length))), core::RunError) << length;
  bytes.push_back(std::byte{0});
  EXPECT_THROW((outcome_of<Number, Row>(bytes)), core::RunError);
}

}  // namespace
}  // namespace pbmpi::app
