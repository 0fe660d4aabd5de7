/// Creates the datasets and attributes of a run's file. Metadata: every rank makes the same calls.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/parameter.h"

namespace pbmpi::io {

/// Fixed-length UTF-8 text, padded with NUL: unlike variable-length text it can be written in parallel.
Datatype text_type(std::size_t bytes);
/// A copy of one of HDF5's own types, e.g. H5T_NATIVE_DOUBLE.
Datatype number_type(hid_t native);

/// The longest prefix of `text` that has at most `bytes` bytes and ends between two UTF-8 characters.
std::string cut_text(std::string_view text, std::size_t bytes);

/// Makes and writes a scalar attribute. Text beyond 60,000 bytes is cut.
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, const std::string& value);
void write_attribute(hid_t object, const Parameter& value);

/// Makes and writes a scalar attribute that refers to the object at `path` of `file`.
void write_reference(hid_t object, const std::string& name, hid_t file, const std::string& path);

/// Overwrites, serially, an existing attribute of a group. It keeps its type.
void rewrite_attribute(hid_t file, const char* group, const std::string& name, const Datatype& type,
                       const void* value);

/// Makes and writes the attribute "version": major, minor.
void write_version(hid_t object, const std::array<std::int64_t, 2>& version);

/// Creates a dataset whose space in the file is allocated now and never filled, with its unit if it has one.
/// Missing groups on the path are created. A growing dataset is chunked, and its rows (first index) can be
/// cut.
Dataset create_fixed(hid_t file, const std::string& path, const Datatype& type,
                     const std::vector<hsize_t>& dims, const std::string& unit);
/// `rows_a_chunk`: 0 = as chunk_shape() chooses.
Dataset create_growing(hid_t file, const std::string& path, const Datatype& type,
                       const std::vector<hsize_t>& dims, const std::string& unit, hsize_t rows_a_chunk = 0);
/// Creates a scalar dataset; it is enough if one rank passes `write`.
void create_scalar(hid_t file, const std::string& path, const Parameter& value, bool write);

Group create_group(hid_t file, const std::string& path);

}  // namespace pbmpi::io
