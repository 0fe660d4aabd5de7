#include "io/hdf5/written_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/system/descriptor.h"

namespace pbmpi::io {
namespace {

/// What the driver tells of a file, and is told of it; belongs to its WrittenFile.
struct Link {
  const bool* values_only;
  int *descriptor, *error;
};

/// An open file as HDF5's virtual file layer has it.
struct Disk : H5FD_t {
  core::Descriptor file;
  haddr_t end_of_allocation = 0, end_of_file = 0;
  Link link{};
};

Disk& disk_of(H5FD_t* file) { return *static_cast<Disk*>(file); }
const Disk& disk_of(const H5FD_t* file) { return *static_cast<const Disk*>(file); }

H5FD_t* open_disk(const char* name, unsigned flags, hid_t access, haddr_t) {
  const bool is_new = (flags & H5F_ACC_CREAT) != 0;
  auto disk = std::make_unique<Disk>();
  disk->file = core::Descriptor(name, O_RDWR | (is_new ? O_CREAT | O_TRUNC : 0));
  struct stat status {};
  if (!disk->file.is_open() || fstat(disk->file.get(), &status) != 0) return nullptr;
  disk->end_of_file = static_cast<haddr_t>(status.st_size);
  disk->link = *static_cast<const Link*>(H5Pget_driver_info(access));
  *disk->link.descriptor = disk->file.get();
  return disk.release();
}

herr_t close_disk(H5FD_t* file) {
  Disk& disk = disk_of(file);
  if (const int error = disk.file.close(); *disk.link.error == 0) *disk.link.error = error;
  delete &disk;
  return 0;
}

herr_t query_disk(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t) { return disk_of(file).end_of_allocation; }
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return disk_of(file).end_of_file; }

herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  disk_of(file).end_of_allocation = address;
  return 0;
}

/// What is behind the end of the file reads as zeros.
herr_t read_disk(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  auto* to = static_cast<std::byte*>(buffer);
  while (size > 0) {
    const ssize_t got = pread(disk_of(file).file.get(), to, size, static_cast<off_t>(address));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    to += got;
    address += static_cast<haddr_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  std::memset(to, 0, size);
  return 0;
}

/// Returns 0, or the errno of the failed call.
int write_at(int file, haddr_t address, std::size_t size, const void* buffer) {
  // The limit is checked first: a write beyond it raises SIGXFSZ.
  if (core::largest_file_bytes() < address + size) return EFBIG;
  const auto* from = static_cast<const std::byte*>(buffer);
  while (size > 0) {
    const ssize_t put = pwrite(file, from, size, static_cast<off_t>(address));
    if (put < 0 && errno != EINTR) return errno;
    if (put <= 0) continue;
    from += put;
    address += static_cast<haddr_t>(put);
    size -= static_cast<std::size_t>(put);
  }
  return 0;
}

herr_t write_disk(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t address, std::size_t size,
                  const void* buffer) {
  Disk& disk = disk_of(file);
  const bool is_dropped = *disk.link.values_only && kind != H5FD_MEM_DRAW;
  if (*disk.link.error == 0 && !is_dropped)
    *disk.link.error = write_at(disk.file.get(), address, size, buffer);
  disk.end_of_file = std::max(disk.end_of_file, address + size);
  return 0;
}

herr_t truncate_disk(H5FD_t* file, hid_t, hbool_t) {
  Disk& disk = disk_of(file);
  int& error = *disk.link.error;
  if (disk.end_of_file == disk.end_of_allocation || *disk.link.values_only) return 0;
  if (error == 0 && core::largest_file_bytes() < disk.end_of_allocation) error = EFBIG;
  if (error == 0 && ftruncate(disk.file.get(), static_cast<off_t>(disk.end_of_allocation)) != 0)
    error = errno;
  disk.end_of_file = disk.end_of_allocation;
  return 0;
}

const H5FD_class_t& driver_class() {
  static const H5FD_class_t driver = [] {
    constexpr haddr_t most_bytes = (haddr_t{1} << 62) - 1;
    H5FD_class_t made{};
    made.name = "pbmpi";
    made.maxaddr = most_bytes;
    made.fc_degree = H5F_CLOSE_WEAK;
    made.fapl_size = sizeof(Link);
    made.open = open_disk;
    made.close = close_disk;
    made.query = query_disk;
    made.get_eoa = end_of_allocation;
    made.set_eoa = set_end_of_allocation;
    made.get_eof = end_of_file;
    made.read = read_disk;
    made.write = write_disk;
    made.truncate = truncate_disk;
    constexpr H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
    std::ranges::copy(kinds, made.fl_map);
    return made;
  }();
  return driver;
}

using Driver = Handle<H5FDunregister>;

/// Keeps all metadata of the file in memory, so that none is read that could not be written.
void keep_metadata(const PropertyList& access) {
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access.id(), &cache), "H5Pget_mdc_config");
  cache.evictions_enabled = 0;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  check(H5Pset_mdc_config(access.id(), &cache), "H5Pset_mdc_config");
}

}  // namespace

std::unique_ptr<WrittenFile::Open> WrittenFile::begin(bool values_only, PropertyList& access) {
  auto open = std::make_unique<Open>();
  open->values_only = values_only;
  access = owned<PropertyList>(H5Pcreate(H5P_FILE_ACCESS), "H5Pcreate");
  const auto driver = owned<Driver>(H5FDregister(&driver_class()), "H5FDregister");
  const Link link = {&open->values_only, &open->descriptor, &open->error};
  check(H5Pset_driver(access.id(), driver.id(), &link), "H5Pset_driver");
  keep_metadata(access);
  return open;
}

WrittenFile WrittenFile::create(const std::string& path) {
  PropertyList access;
  auto open = begin(false, access);
  // The oldest format, chosen on purpose: its superblock has no "open for writing" mark, which after a kill
  // would keep readers out until someone runs h5clear.
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), "H5Pset_libver_bounds");
  constexpr hsize_t metadata_block = hsize_t{64} * 1024;  // metadata lie together
  check(H5Pset_meta_block_size(access.id(), metadata_block), "H5Pset_meta_block_size");
  open->file = owned<File>(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "H5Fcreate");
  return WrittenFile(std::move(open));
}

WrittenFile WrittenFile::open(const std::string& path) {
  PropertyList access;
  auto open = begin(false, access);
  open->file = owned<File>(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), "H5Fopen");
  return WrittenFile(std::move(open));
}

WrittenFile WrittenFile::open_values(const std::string& path) {
  PropertyList access;
  auto open = begin(true, access);
  check(H5Pset_cache(access.id(), 0, 0, 0, 1), "H5Pset_cache");
  open->file = owned<File>(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), "H5Fopen");
  return WrittenFile(std::move(open));
}

void WrittenFile::require_written() const {
  if (open_->error != 0) throw core::RunError(core::reason_of(open_->error));
}

void WrittenFile::flush() {
  check(H5Fflush(id(), H5F_SCOPE_GLOBAL), "H5Fflush");
  require_written();
}

void WrittenFile::sync() {
  flush();
  if (fsync(open_->descriptor) != 0) open_->error = errno;
  require_written();
}

void WrittenFile::close() {
  if (!open_) return;
  if (!open_->file.close()) check(-1, "H5Fclose");
  require_written();
  open_.reset();
}

}  // namespace pbmpi::io
