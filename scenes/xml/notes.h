/// Notes on the parts of another simulator's model that pbmpi interprets differently or leaves out.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pbmpi::scenes::xml {

/// Equal notes are reported once, with the first place and their number.
class Notes {
 public:
  void add(const std::string& where, const std::string& text);
  /// "file:line:column: text (and 3 more)", in the order in which each was first added.
  std::vector<std::string> lines() const;

 private:
  struct Note {
    std::string where, text;
    int count = 0;
  };
  std::vector<Note> notes_;
  std::map<std::string, std::size_t> index_;  ///< of each text
};

}  // namespace pbmpi::scenes::xml
