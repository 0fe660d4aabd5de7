#include "io/hdf5/commit_record.h"

#include "io/hdf5/columns.h"

namespace pbmpi::io {
namespace {

void rewrite(const WrittenFile& file, const char* object, const std::string& name, std::int64_t value) {
  rewrite_attribute(file.id(), object, name, number_type(H5T_NATIVE_INT64), &value);
}

}  // namespace

void create_commit_attributes(hid_t root, hid_t events, const EventCounts& counts) {
  write_attribute(root, "frames_committed", std::int64_t{0});
  write_attribute(root, "complete", std::int64_t{0});
  write_attribute(root, "state_hash", std::string(hash_digits, ' '));
  for (const auto& [name, count] : counts) write_attribute(events, name, count);
}

void CommitRecord::commit(std::int64_t num_frames, const EventCounts& events) {
  rewrite_counts(events);
  rewrite(file_, "/", "frames_committed", num_frames);
  file_.flush();
}

void CommitRecord::finish(bool complete, const std::string& state_hash, const EventCounts& events) {
  std::string padded = state_hash;
  padded.resize(hash_digits, ' ');
  rewrite_attribute(file_.id(), "/", "state_hash", text_type(hash_digits), padded.data());
  rewrite_counts(events);
  rewrite(file_, "/", "complete", complete ? 1 : 0);
  file_.flush();
}

void CommitRecord::rewrite_counts(const EventCounts& events) {
  for (const auto& [name, count] : events) rewrite(file_, "/events", name, count);
}

}  // namespace pbmpi::io
