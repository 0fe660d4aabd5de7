/// The parameters of an ensemble: what each of its worlds has otherwise than the scene, as a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/overrides.h"

namespace pbmpi::scenes {

/// A world a row, a key (Override::key) a column. Immutable.
class ParameterTable {
 public:
  /// `text`: TOML if the name of its file ends in ".toml", a [[world]] table a world, whose keys are those of
  /// overrides; else comma-separated values, the first line the keys, where a cell that is empty leaves the
  /// world as the scene has it, and a word without quotes is a text. Throws core::InputError
  /// "file:line:column: ...".
  ParameterTable(std::string file, std::string text);

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  int num_worlds() const { return static_cast<int>(rows_.size()); }
  const std::vector<std::string>& keys() const { return keys_; }  ///< in the order of their first use

  /// Of world 0 .. num_worlds() - 1.
  const Overrides& of_world(int world) const { return rows_.at(static_cast<std::size_t>(world)); }
  /// [num_worlds][keys] values as TOML; empty where the world is as the scene has it.
  std::vector<std::vector<std::string>> values() const;

 private:
  void read_csv_rows();
  void read_toml_rows();
  void note_key(const std::string& key);

  std::string file_, text_;
  std::vector<std::string> keys_;
  std::vector<Overrides> rows_;
};

/// The number that a TOML value is, if it is one.
std::optional<double> number_in(const std::string& value);

}  // namespace pbmpi::scenes
