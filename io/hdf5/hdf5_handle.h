/// Owners of HDF5 ids, and the functions through which io checks calls of the HDF5 library.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace pbmpi::io {

/// Move-only owner of one HDF5 id. The destructor never throws and drops an error of closing; call close()
/// where the error matters.
template <herr_t (*close_id)(hid_t)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle() { close(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, -1);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  /// Borrowed: valid while this owner lives.
  hid_t id() const { return id_; }
  /// Closes the id, which may do I/O if it is the last one of a file. False if HDF5 refused.
  bool close() noexcept { return id_ < 0 || close_id(std::exchange(id_, -1)) >= 0; }
  /// Gives the id away without closing it.
  hid_t release() noexcept { return std::exchange(id_, -1); }

 private:
  hid_t id_ = -1;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Attribute = Handle<H5Aclose>;
using Dataspace = Handle<H5Sclose>;
using Datatype = Handle<H5Tclose>;
using PropertyList = Handle<H5Pclose>;
using Object = Handle<H5Oclose>;

/// Call before anything else of HDF5, any number of times. Errors are no longer printed (check() puts them
/// into exceptions), and HDF5 does not close files at exit: after a failed write it would try again and
/// abort.
void prepare_hdf5();

/// Throws core::RunError with `call` and the text of the HDF5 error stack if `status` is negative.
void check(herr_t status, const std::string& call);

/// check() for calls that return an id; returns its owner.
template <class Owner>
Owner owned(hid_t id, const std::string& call) {
  if (id < 0) check(-1, call);
  return Owner(id);
}

}  // namespace pbmpi::io
