/// Files that are tables: attributes, parameters, and groups of equal-length columns. Written and read whole,
/// by one rank (io/SCHEMA.md, "The file of a study").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "io/file/output_target.h"
#include "io/hdf5/parameter.h"

namespace pbmpi::io {

/// One column; a row has `width` numbers, one after the other.
struct TableColumn {
  std::string name;
  std::string unit;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> values;
  std::size_t width = 1;

  std::size_t num_rows() const;
};

struct TableFile {
  std::map<std::string, std::string> attributes;           ///< of the root, as text
  std::vector<Parameter> parameters;                       ///< of /parameters
  std::map<std::string, std::vector<TableColumn>> tables;  ///< by group name

  bool has_column(const std::string& table, const std::string& name) const;
  /// A column of a table. Throws core::InputError if there is none, or of another type.
  template <class Value>
  const std::vector<Value>& column(const std::string& table, const std::string& name) const {
    const auto* values = std::get_if<std::vector<Value>>(&find(table, name).values);
    if (values == nullptr) throw_type(table, name);
    return *values;
  }

 private:
  const TableColumn& find(const std::string& table, const std::string& name) const;
  [[noreturn]] static void throw_type(const std::string& table, const std::string& name);
};

/// Makes sure that `path` can be written before the work begins; the file gets its name only when it is
/// complete.
class TableWriter {
 public:
  /// Throws core::InputError if the file cannot be created.
  explicit TableWriter(const std::string& path);

  /// Throws core::RunError if the file cannot be written.
  void write(const std::string& filetype, const TableFile& file);

 private:
  OutputLock lock_;
};

/// The attribute filetype of all files of pbstudy, and the major and minor version of their layout.
inline constexpr const char* study_filetype = "pbmpi-study";
inline constexpr std::array<std::int64_t, 2> study_version = {1, 8};

/// About as many bytes as a table file has.
inline constexpr std::int64_t table_bytes = std::int64_t{1} << 20;

/// The bytes of a table file, made in memory: a file written in one go is never left half done. Sealed
/// (core/system/seal.h) from minor version 3 on.
std::vector<std::byte> table_image(const std::string& filetype, const std::array<std::int64_t, 2>& version,
                                   const TableFile& file);

/// Throws core::InputError if the file is missing, not HDF5, of another file type or layout, or damaged.
/// `major`: version of the layout.
TableFile read_table_file(const std::string& path, const std::string& filetype,
                          std::int64_t major = study_version[0]);

/// The right to write an HDF5 file of this type and of about `bytes`, which replaces only a file of its own
/// type: any other HDF5 file may be somebody's data. Throws core::InputError like OutputTarget's constructor.
OutputTarget output_target(const std::string& path, const std::string& filetype, std::int64_t bytes);

/// A text among the root's attributes of an HDF5 file; empty if `path` is not one, is damaged, or has no such
/// attribute.
std::string root_text(const std::string& path, const std::string& attribute);
inline std::string filetype_of(const std::string& path) { return root_text(path, "filetype"); }

}  // namespace pbmpi::io
