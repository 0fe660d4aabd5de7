/// A statement of the paper beside the measurement, and the conclusion.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/pbreport/study/paper_verdict.h"

namespace pbmpi::app {

/// The basis of a number.
enum class Basis {
  counts,        ///< states and counts of runs: the same bits in each run
  clock,         ///< times measured on this machine
  instructions,  ///< counted by callgrind
  prediction,    ///< the study of value prediction, and its modelled processor
  nothing,       ///< nothing here can decide it
};
inline constexpr std::array<std::string_view, 5> basis_names = {"counts", "clock", "instructions",
                                                                "prediction", "nothing"};
inline std::string name_of(Basis basis) { return std::string(basis_names[static_cast<std::size_t>(basis)]); }

/// "CrashWa 3, Fight 4".
class SceneList {
 public:
  void add(const std::string& scene, const std::string& number);
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t size_ = 0;
};

struct PaperStatement {
  PaperVerdict verdict;  ///< its number is ours
  std::string papers;    ///< the paper's value
  Basis basis = Basis::counts;
  std::string command;  ///< measures the number
  std::string remark;   ///< why it is so, or what differs

  /// Sets the finding. Unless all scenes that the statement is about were measured, it stays undecidable, and
  /// the remark says so.
  void decide(bool is_confirmed, std::size_t num_measured, std::size_t num_needed);
  /// decide() from the scenes measured; `lead` and their list become the number. An empty list leaves the
  /// statement as it is.
  void decide(bool is_confirmed, const SceneList& measured, std::size_t num_needed,
              const std::string& lead = "");
};

inline constexpr std::size_t num_scenes = 9;
/// Scenes of Figures 8 and 9.
inline constexpr std::array<const char*, 5> figure_8_scenes = {"CrashWa", "Environ", "Battle", "Fight",
                                                               "Battle2"};

/// Is our number within a tenth of the paper's?
bool is_near(double ours, double papers);

/// The number of a statement for which the files have no data.
inline constexpr const char* not_measured = "not measured";

/// A statement that nothing here can decide, for this reason.
PaperStatement undecidable(const std::string& section, const std::string& statement,
                           const std::string& papers, const std::string& reason);

std::string percent(double share, int decimals = 0);  ///< "42 %"
std::string rate(double hz);                          ///< "1,230 Hz" without the comma

}  // namespace pbmpi::app
