#include "io/run/skeleton.h"

#include <algorithm>
#include <functional>

#include "core/utc.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/commit_record.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/written_file.h"
#include "io/run/event_columns.h"
#include "io/run/frame_columns.h"
#include "io/setup/static_columns.h"
#include "io/setup/world_result_rows.h"

namespace pbmpi::io {
namespace {

const Parameter* find(const std::vector<Parameter>& parameters, const std::string& name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&name](const Parameter& parameter) { return parameter.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

std::string text_or(const std::vector<Parameter>& parameters, const std::string& name,
                    const std::string& other) {
  const Parameter* found = find(parameters, name);
  return found != nullptr && !found->text.empty() ? found->text : other;
}

void write_boundary(hid_t box) {
  constexpr std::size_t bytes = 4;
  const Datatype type = text_type(bytes);
  const hsize_t length = 3;
  const auto space = owned<Dataspace>(H5Screate_simple(1, &length, nullptr), "H5Screate_simple");
  const auto attribute = owned<Attribute>(
      H5Acreate2(box, "boundary", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "H5Acreate(boundary)");
  check(H5Awrite(attribute.id(), type.id(), "nonenonenone"), "H5Awrite(boundary)");
}

/// Writes what H5MD 1.1 (nongnu.org/h5md) requires in addition to the elements of a particle group.
void write_h5md(hid_t file, const RunSetup& setup) {
  const Group h5md = create_group(file, "/h5md");
  write_version(h5md.id(), {1, 1});
  const Group author = create_group(file, "/h5md/author");
  write_attribute(author.id(), "name", text_or(setup.attributes, "author", "unknown"));
  const Group creator = create_group(file, "/h5md/creator");
  write_attribute(creator.id(), "name", std::string("pbmpi"));
  write_attribute(creator.id(), "version", text_or(setup.attributes, "pbmpi_version", "unknown"));
  const Group units = create_group(file, "/h5md/modules/units");
  write_version(units.id(), {1, 0});
  write_attribute(units.id(), "system", std::string("SI"));
  const Group box = create_group(file, "/particles/bodies/box");
  write_attribute(box.id(), "dimension", std::int64_t{3});
  write_boundary(box.id());
}

void write_root(hid_t file, const RunSetup& setup) {
  const auto root = owned<Group>(H5Gopen2(file, "/", H5P_DEFAULT), "H5Gopen(/)");
  write_attribute(root.id(), "filetype", std::string(filetype));
  write_version(root.id(), {layout_major, layout_minor});
  for (const Parameter& attribute : setup.attributes) write_attribute(root.id(), attribute);
  if (find(setup.attributes, "created") == nullptr) {
    write_attribute(root.id(), "created", core::utc_now());
  }
  write_attribute(root.id(), "record_every", std::int64_t{setup.record_every});
  write_attribute(root.id(), "first_frame", setup.first_frame);
  create_checksum_attributes(root.id());
  const Group events = create_group(file, "/events");
  create_commit_attributes(root.id(), events.id(), EventColumns::no_counts());
}

void write_parameters(hid_t file, const std::vector<Parameter>& parameters) {
  const Group group = create_group(file, "/parameters");
  for (const Parameter& parameter : parameters) create_scalar(group.id(), parameter.name, parameter, true);
}

}  // namespace

void make_skeleton(const FileRanks& ranks, const std::string& path, const RunSetup& setup,
                   const RunShape& shape) {
  WrittenFile file;
  const auto on_root = [&](const std::function<void()>& work) {
    ranks.together([&] {
      if (ranks.is_root()) work();
    });
  };
  on_root([&] {
    file = WrittenFile::create(path);
    write_root(file.id(), setup);
  });
  write_static_columns(ranks, {file.id(), true}, setup);
  on_root([&] {
    create_world_results(file.id(), setup.table.num_worlds());
    write_h5md(file.id(), setup);
    write_parameters(file.id(), setup.parameters);
    FrameColumns::create(file.id(), shape);
    file.close();
  });
}

void fill_skeleton(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  write_static_columns(ranks, {file, false}, setup);
}

}  // namespace pbmpi::io
