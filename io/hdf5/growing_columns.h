/// Columns with one row per frame: their rows wait in memory and are written to the file together.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/system/descriptor.h"
#include "io/hdf5/file_ranks.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/rows.h"

namespace pbmpi::io {

/// A column of a table: its name in the group, the type and number of an item's values, and their unit.
struct ColumnSpec {
  std::string name;
  hid_t native_type;  ///< borrowed
  hsize_t width = 1;  ///< values per item; 1 = no extra dimension
  std::string unit = {};
  std::size_t text_bytes = 0;  ///< > 0: text of this length; native_type is ignored
};

/// The shape of a table's rows.
struct TableShape {
  hsize_t num_rows = 0;   ///< full length in the file
  hsize_t num_items = 0;  ///< per row; 0 = the column is one-dimensional
  hsize_t capacity = 1;   ///< rows that can wait
};

/// Columns of one group that get the same rows, of which each rank owns some items. Before writing, the ranks
/// exchange items, so that each rank has some rows whole and writes them in one piece. Each row has a
/// checksum, computed by the rank that writes it. A waiting row has room for all items; pages that a rank
/// never touches take no memory.
class GrowingTable {
 public:
  /// Paths of a table's datasets: of its columns, and of its rows' checksums.
  static std::vector<std::string> datasets(const std::string& group, const std::vector<ColumnSpec>& columns);
  /// Makes the datasets.
  static void create(hid_t file, const std::string& group, const std::vector<ColumnSpec>& columns,
                     TableShape shape);
  /// Opens the datasets in the file of all ranks.
  GrowingTable(hid_t file, const FileRanks& ranks, const std::string& group,
               const std::vector<ColumnSpec>& columns, TableShape shape);

  /// Begins the next row, in which this rank writes the items of `ranges` ({0, 1} or nothing in a
  /// one-dimensional table).
  void begin_row(const std::vector<Range>& ranges);
  /// Puts `count` items, each a T, into the row that was begun last.
  template <class T>
  void put(std::size_t column, hsize_t first_item, const T* items, hsize_t count) {
    core::require_invariant(sizeof(T) == columns_[column].item_bytes,
                            "an item of another type than its column");
    std::memcpy(place(column, first_item), static_cast<const void*>(items), count * sizeof(T));
  }
  template <class T>
  void put(std::size_t column, hsize_t item, T value) {
    put(column, item, &value, 1);
  }
  /// Puts items of one or more numbers each, one after the other.
  void put(std::size_t column, hsize_t first_item, std::span<const double> numbers) {
    core::require_invariant(numbers.size_bytes() % columns_[column].item_bytes == 0,
                            "items of another width than their column");
    if (!numbers.empty()) std::memcpy(place(column, first_item), numbers.data(), numbers.size_bytes());
  }
  void put_text(std::size_t column, const std::string& text);

  hsize_t num_waiting() const { return num_waiting_; }
  bool full() const { return num_waiting_ == shape_.capacity; }
  hsize_t num_rows() const { return written_; }
  /// Bytes of a row with all items and columns.
  static std::size_t row_bytes(const std::vector<ColumnSpec>& columns, hsize_t num_items);

  /// Sends the items of the waiting rows to the ranks that write them. Collective, before write().
  void settle();
  /// Writes the waiting rows that this rank has whole.
  void write();

  /// Closes the datasets.
  void close();
  /// Calls cut_rows() for all its datasets, with the rows written.
  void cut(hid_t file, std::vector<core::ByteRange>& unused) const;

 private:
  struct Column {
    std::string path;
    Datatype type;
    Dataset dataset;
    std::size_t item_bytes;
    hsize_t items;                         ///< per row
    std::unique_ptr<std::byte[]> waiting;  ///< [capacity][items][width]
  };
  std::byte* place(Column& column, hsize_t row, hsize_t item) {
    return column.waiting.get() + (row * column.items + item) * column.item_bytes;
  }
  std::byte* place(std::size_t column, hsize_t item) {
    return place(columns_[column], num_waiting_ - 1, item);
  }
  /// Appends this rank's items of a waiting row to `message`; unpack() puts such items into the row, and
  /// returns where the next items begin.
  void pack(hsize_t row, std::vector<std::byte>& message);
  const std::byte* unpack(hsize_t row, const std::byte* message);
  /// The columns of the table, without the checksums.
  std::span<Column> own_columns() { return std::span(columns_).first(columns_.size() - 1); }
  /// Puts the checksums of the rows that this rank has whole.
  void add_checksums(Range rows);
  Column open_column(hid_t file, const std::string& path, const Datatype& type, hsize_t num_items,
                     hsize_t width) const;

  const FileRanks& ranks_;
  TableShape shape_;
  hsize_t items_;
  std::vector<Column> columns_;            ///< the last one has the checksums of the rows (file_checksum.h)
  std::vector<std::vector<Range>> owned_;  ///< [num_waiting] this rank's items of each row
  hsize_t num_waiting_ = 0;
  hsize_t written_ = 0;
};

/// Cuts a growing dataset, in a file that was opened anew, to its first rows; adds the bytes of the file that
/// this frees to `unused`. One rank alone: HDF5 1.10 hangs if ranks together cut a dataset whose chunks only
/// some of them have written.
void cut_rows(hid_t file, const std::string& path, hsize_t num_rows, std::vector<core::ByteRange>& unused);

}  // namespace pbmpi::io
