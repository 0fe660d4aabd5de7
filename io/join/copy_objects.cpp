#include "io/join/copy_objects.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

/// For H5Lvisit: exceptions must not pass through HDF5.
herr_t note_path(hid_t, const char* name, const H5L_info_t*, void* data) {
  try {
    static_cast<std::vector<std::string>*>(data)->push_back("/" + std::string(name));
    return 0;
  } catch (const std::exception&) {
    return -1;
  }
}

/// An attribute that points to another object, written once all objects exist.
struct PendingReference {
  std::string object, name, target;
};

std::string target_of(hid_t file, hid_t attribute) {
  hobj_ref_t reference{};
  check(H5Aread(attribute, H5T_STD_REF_OBJ, &reference), "H5Aread(reference)");
  std::array<char, 1024> name{};
  check(H5Rget_name(file, H5R_OBJECT, &reference, name.data(), name.size()) < 0 ? -1 : 0, "H5Rget_name");
  return name.data();
}

std::vector<std::string> attribute_names(hid_t object) {
  H5O_info_t info;
  check(H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS), "H5Oget_info");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    std::array<char, 256> name{};
    check(H5Aget_name_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(),
                             H5P_DEFAULT) < 0
              ? -1
              : 0,
          "H5Aget_name_by_idx");
    names.emplace_back(name.data());
  }
  return names;
}

class Copier {
 public:
  Copier(hid_t from, hid_t to, const CopyPlan& plan) : from_(from), to_(to), plan_(plan) {
    for (const auto& [path, shape] : plan.grown) grown_[address_of(from, path)] = shape;
    for (const std::string& path : plan.left_out) left_out_.insert(address_of(from, path));
  }

  void run() {
    copy_attributes("/");
    for (const std::string& path : paths_in(from_)) copy(path);
    for (const PendingReference& one : references_) {
      const auto object =
          owned<Object>(H5Oopen(to_, one.object.c_str(), H5P_DEFAULT), "H5Oopen(" + one.object + ")");
      write_reference(object.id(), one.name, to_, one.target);
    }
  }

 private:
  void copy(const std::string& path) {
    const auto is_below = [&path](const std::string& group) { return path.starts_with(group + "/"); };
    if (plan_.made_by_caller.contains(path) || std::ranges::any_of(left_out_groups_, is_below)) return;
    const haddr_t address = address_of(from_, path);
    if (left_out_.contains(address)) return;
    const auto object = owned<Object>(H5Oopen(from_, path.c_str(), H5P_DEFAULT), "H5Oopen(" + path + ")");
    if (H5Iget_type(object.id()) == H5I_GROUP) {
      copy_group(path);
    } else if (const auto [first, is_new] = made_.try_emplace(address, path); is_new) {
      copy_dataset(path, address);
    } else {
      check(H5Lcreate_hard(to_, first->second.c_str(), to_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
            "H5Lcreate_hard(" + path + ")");
    }
  }

  bool is_left_out(const std::string& path) const { return left_out_.contains(address_of(from_, path)); }

  /// Is this the group of a table with no dataset left, or an H5MD element without its value?
  bool is_left_out_group(const std::string& path) const {
    if (has_object(from_, path + "/value") && is_left_out(path + "/value")) return true;
    const std::vector<std::string> names = names_in(from_, path);
    return !names.empty() && std::ranges::all_of(names, [&](const std::string& name) {
      return is_left_out(path + "/" + name);
    });
  }

  void copy_group(const std::string& path) {
    if (is_left_out_group(path)) {
      left_out_groups_.push_back(path);
      return;
    }
    create_group(to_, path);
    copy_attributes(path);
  }

  void copy_dataset(const std::string& path, haddr_t address) {
    RawRows rows = raw_rows(from_, path);
    const auto grown = grown_.find(address);
    if (grown != grown_.end()) {
      rows.dims.at(0) = grown->second.num_rows;
      if (grown->second.num_items > 0) rows.dims.at(1) = grown->second.num_items;
      create_growing(to_, path, rows.type, rows.dims, "", grown->second.rows_a_chunk);
    } else {
      std::vector<std::byte> values(rows.num_rows * rows.row_bytes);
      rows.read(0, rows.num_rows, values.data());
      const Dataset copy = create_fixed(to_, path, rows.type, rows.dims, "");
      if (!values.empty())
        check(H5Dwrite(copy.id(), rows.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
              "H5Dwrite(" + path + ")");
    }
    copy_attributes(path);
  }

  void copy_attributes(const std::string& path) {
    const auto source = owned<Object>(H5Oopen(from_, path.c_str(), H5P_DEFAULT), "H5Oopen(" + path + ")");
    const auto target = owned<Object>(H5Oopen(to_, path.c_str(), H5P_DEFAULT), "H5Oopen(" + path + ")");
    for (const std::string& name : attribute_names(source.id())) {
      const auto attribute =
          owned<Attribute>(H5Aopen(source.id(), name.c_str(), H5P_DEFAULT), "H5Aopen(" + name + ")");
      const auto type = owned<Datatype>(H5Aget_type(attribute.id()), "H5Aget_type");
      if (H5Tget_class(type.id()) == H5T_REFERENCE) {
        references_.push_back({path, name, target_of(from_, attribute.id())});
        continue;
      }
      const auto space = owned<Dataspace>(H5Aget_space(attribute.id()), "H5Aget_space");
      std::vector<std::byte> value(static_cast<std::size_t>(H5Aget_storage_size(attribute.id())));
      check(H5Aread(attribute.id(), type.id(), value.data()), "H5Aread(" + name + ")");
      const auto copy = owned<Attribute>(
          H5Acreate2(target.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
          "H5Acreate(" + name + ")");
      check(H5Awrite(copy.id(), type.id(), value.data()), "H5Awrite(" + name + ")");
    }
  }

  hid_t from_, to_;
  const CopyPlan& plan_;
  std::map<haddr_t, GrownDataset> grown_;
  std::set<haddr_t> left_out_;
  std::vector<std::string> left_out_groups_;
  std::map<haddr_t, std::string> made_;  ///< first path of each dataset
  std::vector<PendingReference> references_;
};

/// Shape and bytes of a dataset.
std::pair<std::vector<hsize_t>, std::vector<std::byte>> content_of(hid_t file, const std::string& path) {
  const RawRows rows = raw_rows(file, path);
  std::vector<std::byte> values(rows.num_rows * rows.row_bytes);
  rows.read(0, rows.num_rows, values.data());
  return {rows.dims, std::move(values)};
}

}  // namespace

std::vector<std::string> paths_in(hid_t file) {
  std::vector<std::string> paths;
  check(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, note_path, &paths), "H5Lvisit");
  return paths;
}

haddr_t address_of(hid_t file, const std::string& path) {
  H5O_info_t info;
  check(H5Oget_info_by_name2(file, path.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT),
        "H5Oget_info(" + path + ")");
  return info.addr;
}

void copy_objects(hid_t from, hid_t to, const CopyPlan& plan) { Copier(from, to, plan).run(); }

void require_same_objects(hid_t a, const std::string& path_a, hid_t b, const std::string& path_b,
                          const std::set<std::string>& growing) {
  std::set<haddr_t> passed_over;
  for (const std::string& path : growing) {
    if (has_object(a, path)) passed_over.insert(address_of(a, path));
  }
  for (const std::string& path : paths_in(a)) {
    if (path.starts_with("/parameters/") || path.starts_with("/ranks/") ||
        passed_over.contains(address_of(a, path)))
      continue;
    const auto object = owned<Object>(H5Oopen(a, path.c_str(), H5P_DEFAULT), "H5Oopen(" + path + ")");
    if (H5Iget_type(object.id()) != H5I_DATASET) continue;
    core::require_input(
        has_object(b, path) && content_of(a, path) == content_of(b, path),
        path_a + " and " + path_b + " are not of one run: " + path + " is not the same in both");
  }
}

}  // namespace pbmpi::io
