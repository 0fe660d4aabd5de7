#include "io/setup/world_result_rows.h"

#include "core/error.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/commit_record.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

constexpr const char* rows_written = "num_worlds";

using Integer = std::int64_t WorldResult::*;
using Real = double WorldResult::*;

Datatype type_of(const ResultColumn& column) {
  if (std::holds_alternative<Integer>(column.member)) return number_type(H5T_NATIVE_INT64);
  if (std::holds_alternative<Real>(column.member)) return number_type(H5T_NATIVE_DOUBLE);
  return text_type(hash_digits);
}

std::string path_of(const ResultColumn& column) {
  return std::string(world_results) + "/" + std::string(column.name);
}

void write_column(hid_t file, const ResultColumn& column, const void* values) {
  const std::string path = path_of(column);
  const auto dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  check(H5Dwrite(dataset.id(), type_of(column).id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
        "H5Dwrite(" + path + ")");
}

/// Packs texts at the fixed length that they have in the file.
std::string packed_texts(std::span<const WorldResult> results, std::string WorldResult::*member) {
  std::string packed;
  for (const WorldResult& result : results) {
    std::string text = cut_text(result.*member, hash_digits);
    text.resize(hash_digits, '\0');
    packed += text;
  }
  return packed;
}

}  // namespace

std::int64_t bytes_of_a_world_result() {
  return static_cast<std::int64_t>((world_result_columns.size() - 1) * sizeof(double) + hash_digits);
}

void create_world_results(hid_t file, int num_worlds) {
  const Group group = create_group(file, world_results);
  write_attribute(group.id(), rows_written, std::int64_t{0});
  // Chunked, like everything that changes after the skeleton.
  for (const ResultColumn& column : world_result_columns)
    create_growing(file, path_of(column), type_of(column), {static_cast<hsize_t>(num_worlds)},
                   std::string(column.unit));
}

void write_world_results(hid_t file, std::span<const WorldResult> results) {
  for (const ResultColumn& column : world_result_columns) {
    if (const auto* text = std::get_if<std::string WorldResult::*>(&column.member)) {
      write_column(file, column, packed_texts(results, *text).data());
    } else if (const auto* integer = std::get_if<Integer>(&column.member)) {
      std::vector<std::int64_t> values;
      for (const WorldResult& result : results) values.push_back(result.*(*integer));
      write_column(file, column, values.data());
    } else {
      std::vector<double> values;
      for (const WorldResult& result : results) values.push_back(result.*std::get<Real>(column.member));
      write_column(file, column, values.data());
    }
  }
  const auto num_worlds = static_cast<std::int64_t>(results.size());
  rewrite_attribute(file, world_results, rows_written, number_type(H5T_NATIVE_INT64), &num_worlds);
}

std::vector<WorldResult> read_world_results(hid_t file) {
  if (!has_object(file, world_results)) return {};
  const std::int64_t num_worlds = integer_attribute(file, world_results, rows_written);
  if (num_worlds <= 0) return {};
  std::vector<WorldResult> results(static_cast<std::size_t>(num_worlds));
  for (const ResultColumn& column : world_result_columns) {
    const std::string path = path_of(column);
    if (const auto* text = std::get_if<std::string WorldResult::*>(&column.member)) {
      std::vector<std::string> values = read_texts(file, path, num_worlds);
      for (std::size_t i = 0; i < results.size(); ++i) results[i].*(*text) = values[i];
    } else if (const auto* integer = std::get_if<Integer>(&column.member)) {
      const std::vector<std::int64_t> values = read_integers(file, path, num_worlds);
      for (std::size_t i = 0; i < results.size(); ++i) results[i].*(*integer) = values[i];
    } else {
      const std::vector<double> values = read_doubles(file, path, num_worlds, 1);
      for (std::size_t i = 0; i < results.size(); ++i) results[i].*std::get<Real>(column.member) = values[i];
    }
  }
  return results;
}

}  // namespace pbmpi::io
