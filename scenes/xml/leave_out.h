/// What of a file a reader passes over: what the user has named ('leave_out'), and what it does not need.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "scenes/xml/notes.h"

namespace pbmpi::scenes::xml {

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
