/// A verdict on a statement of the paper.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace pbmpi::app {

enum class Finding { confirmed, refuted, undecidable };
inline constexpr std::array<std::string_view, 3> finding_names = {"confirmed", "refuted",
                                                                  "not decidable here"};

inline std::string name_of(Finding finding) {
  return std::string(finding_names[static_cast<std::size_t>(finding)]);
}
inline Finding finding_if(bool is_confirmed) { return is_confirmed ? Finding::confirmed : Finding::refuted; }

struct PaperVerdict {
  std::string section;    ///< of the paper
  std::string statement;  ///< the paper's, abridged
  std::string rule;       ///< when the statement counts as confirmed
  Finding finding = Finding::undecidable;
  std::string number;  ///< the result, or why there is none
};

}  // namespace pbmpi::app
