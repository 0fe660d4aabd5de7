#include "core/error.h"
#include "io/hdf5/read_columns.h"
#include "io/run/contact_rows.h"
#include "io/run/run_data.h"

namespace pbmpi::io {

struct ContactReader::Impl {
  File file;
  std::vector<ContactSpan> spans;  ///< [T]
  std::int64_t record_every = 1;
};

namespace {

/// One recorded row of a motion column, as vectors.
std::vector<core::Vec3> read_vectors(hid_t file, const std::string& path, std::size_t row) {
  const RawRows rows = raw_rows(file, path);
  if (rows.dims.size() != 3 || rows.dims[2] != 3 || row >= rows.num_rows ||
      rows.row_bytes != rows.dims[1] * sizeof(double) * 3)
    throw core::RunError(path + " has no vectors in row " + std::to_string(row));
  std::vector<double> values(rows.dims[1] * 3);
  rows.read(row, 1, values.data());
  std::vector<core::Vec3> vectors;
  for (std::size_t i = 0; i < values.size(); i += 3) vectors.emplace_back(&values[i]);
  return vectors;
}

void require_body(double body, std::size_t num_bodies, bool may_be_static) {
  if (!(body >= (may_be_static ? -1 : 0) && body < static_cast<double>(num_bodies)))
    throw core::RunError(std::string(ContactRows::points) + " names a body that is not there");
}

/// `row`: a row of /contacts/point, with columns as in contact_columns.
ContactRow contact_of(const double* row, std::size_t num_bodies) {
  require_body(row[3], num_bodies, false);
  require_body(row[4], num_bodies, true);
  ContactRow contact;
  contact.body_a = static_cast<std::int64_t>(row[3]);
  contact.body_b = static_cast<std::int64_t>(row[4]);
  contact.position = core::Vec3(row + 6);
  contact.normal = core::Vec3(row + 9);
  contact.depth_m = row[12];
  contact.mu = row[13];
  contact.normal_force = row[17];
  contact.friction = core::Vec3(row + 18);
  return contact;
}

}  // namespace

ContactReader::ContactReader(const std::string& path) : impl_(std::make_unique<Impl>()), path_(path) {
  impl_->file = open_run(path);
  try {
    const hid_t file = impl_->file.id();
    impl_->record_every = integer_attribute(file, "/", "record_every");
    impl_->spans = read_contact_spans(file, integer_attribute(file, "/", "frames_committed"));
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

ContactReader::~ContactReader() = default;

bool ContactReader::has_any() const { return !impl_->spans.empty(); }

RecordedContacts ContactReader::read(std::size_t recorded_row) const {
  const hid_t file = impl_->file.id();
  try {
    RecordedContacts frame;
    frame.velocity = read_vectors(file, "/particles/bodies/velocity/value", recorded_row);
    frame.angular_velocity = read_vectors(file, "/particles/bodies/angular_velocity/value", recorded_row);
    const auto every = static_cast<std::size_t>(impl_->record_every);
    const ContactSpan& span = impl_->spans.at((recorded_row + 1) * every - 1);
    const RawRows rows = raw_rows(file, ContactRows::points, span.first + span.count);
    if (rows.row_bytes != contact_columns.size() * sizeof(double))
      throw core::RunError(std::string(ContactRows::points) + " has other columns");
    std::vector<double> values(static_cast<std::size_t>(span.count) * contact_columns.size());
    rows.read(static_cast<hsize_t>(span.first), static_cast<hsize_t>(span.count), values.data());
    for (std::size_t at = 0; at < values.size(); at += contact_columns.size()) {
      if (values[at + 5] == 1) frame.contacts.push_back(contact_of(&values[at], frame.velocity.size()));
    }
    return frame;
  } catch (const core::RunError& error) {
    throw core::InputError(path_ + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

}  // namespace pbmpi::io
