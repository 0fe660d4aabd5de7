/// The parameters of an ensemble: a table of the values in which its worlds differ from the scene.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/overrides.h"

namespace pbmpi::scenes {

/// One row per world, one column per key (Override::key). Immutable.
class ParameterTable {
 public:
  /// `text` is TOML if the name of its file ends in ".toml": one [[world]] table per world, with the keys of
  /// overrides. Otherwise it is comma-separated values: the first line has the keys, an empty cell leaves the
  /// world as in the scene, and an unquoted word is a text. Throws core::InputError "file:line:column: ...".
  ParameterTable(std::string file, std::string text);

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  int num_worlds() const { return static_cast<int>(rows_.size()); }
  const std::vector<std::string>& keys() const { return keys_; }  ///< in the order of their first use

  /// The overrides of world 0 .. num_worlds() - 1.
  const Overrides& of_world(int world) const { return rows_.at(static_cast<std::size_t>(world)); }
  /// [num_worlds][keys] values as TOML; empty where the world is as in the scene.
  std::vector<std::vector<std::string>> values() const;

 private:
  void read_csv_rows();
  void read_toml_rows();
  /// Takes up a key; false if it is known.
  bool add_key(const std::string& key);

  std::string file_, text_;
  std::vector<std::string> keys_;
  std::map<std::string, std::size_t> column_of_;  ///< index into keys_
  std::vector<Overrides> rows_;
};

/// The number that a TOML value represents, if it is a number.
std::optional<double> number_in(const std::string& value);

}  // namespace pbmpi::scenes
