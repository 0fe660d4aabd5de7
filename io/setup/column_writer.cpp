#include "io/setup/column_writer.h"

#include <algorithm>
#include <utility>

#include "io/hdf5/columns.h"

namespace pbmpi::io {

ColumnWriter::ColumnWriter(const FileRanks& ranks, ColumnFile file, std::string group, OwnRows rows)
    : ranks_(ranks), file_(file), group_(std::move(group)), rows_(std::move(rows)) {}

void ColumnWriter::numbers(const std::string& name, const std::vector<double>& values,
                           const std::string& unit, const std::vector<hsize_t>& item) {
  write(name, number_type(H5T_NATIVE_DOUBLE), values.data(), item, unit);
}

void ColumnWriter::numbers(const std::string& name, const std::vector<std::int32_t>& values) {
  write(name, number_type(H5T_NATIVE_INT32), values.data(), {}, "");
}

void ColumnWriter::numbers(const std::string& name, const std::vector<std::int64_t>& values,
                           const std::vector<hsize_t>& item) {
  write(name, number_type(H5T_NATIVE_INT64), values.data(), item, "");
}

void ColumnWriter::texts(const std::string& name, const std::vector<std::string>& values,
                         std::size_t length) {
  if (length == 0) {
    for (const std::string& value : values) length = std::max(length, value.size());
    length =
        static_cast<std::size_t>(ranks_.max(std::max<std::int64_t>(static_cast<std::int64_t>(length), 1)));
  }
  std::string packed;
  for (const std::string& value : values) {
    std::string padded = cut_text(value, length);
    padded.resize(length, '\0');
    packed += padded;
  }
  write(name, text_type(length), packed.data(), {}, "");
}

void ColumnWriter::write(const std::string& name, const Datatype& type, const void* data,
                         const std::vector<hsize_t>& item, const std::string& unit) {
  std::vector<hsize_t> dims{rows_.num_rows};
  hsize_t local = count_items(rows_.ranges);
  for (const hsize_t extent : item) {
    dims.push_back(extent);
    local *= extent;
  }
  const std::string path = group_ + "/" + name;
  if (file_.is_new) {
    ranks_.together([&] {
      if (ranks_.is_root()) create_fixed(file_.id, path, type, dims, unit);
    });
    return;
  }
  ranks_.together([&] {
    if (local == 0) return;
    const auto dataset =
        owned<Dataset>(H5Dopen2(file_.id, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
    const auto in_file = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
    select_ranges(in_file, rows_.ranges);
    const auto in_memory = owned<Dataspace>(H5Screate_simple(1, &local, nullptr), "H5Screate_simple");
    check(H5Dwrite(dataset.id(), type.id(), in_memory.id(), in_file.id(), H5P_DEFAULT, data),
          "H5Dwrite(" + path + ")");
  });
}

void append(std::vector<double>& values, const core::Vec3& v) {
  values.insert(values.end(), {v[0], v[1], v[2]});
}

void append(std::vector<double>& values, const core::Quat& q) {
  values.insert(values.end(), {q.w, q.x, q.y, q.z});
}

void append(std::vector<double>& values, const core::Mat3& m) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) values.push_back(m(row, column));
  }
}

void append(std::vector<double>& values, const std::array<double, 3>& numbers) {
  values.insert(values.end(), numbers.begin(), numbers.end());
}

}  // namespace pbmpi::io
