/// Notes on the parts of another simulator's model that pbmpi interprets differently or leaves out.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
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

/// The names of elements, types and attributes that are dropped instead of refused, and the notes about what
/// was dropped. `notes` is borrowed.
class LeaveOut {
 public:
  LeaveOut(std::set<std::string> names, Notes& notes) : names_(std::move(names)), notes_(notes) {}

  bool names(std::string_view name) const { return names_.contains(std::string(name)); }
  /// Is the part at `where` to be left out? Then notes it.
  bool drops(std::string_view name, const std::string& where) const;
  Notes& notes() const { return notes_; }

  /// "leave it out (leave_out = ["name"] in a TOML scene)", for the refusal of what drops() would drop.
  static std::string advice(std::string_view name);

 private:
  std::set<std::string> names_;
  Notes& notes_;
};

}  // namespace pbmpi::scenes::xml
