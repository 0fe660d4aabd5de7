#include "io/hdf5/hdf5_handle.h"

#include <string_view>

#include "core/error.h"

namespace pbmpi::io {
namespace {

/// Joins the descriptions of the error stack, starting with the library call that failed; two are enough to
/// tell what HDF5 was doing.
herr_t collect(unsigned depth, const H5E_error2_t* entry, void* text) {
  constexpr unsigned max_depth = 2;
  auto& joined = *static_cast<std::string*>(text);
  if (depth < max_depth && entry->desc != nullptr) {
    if (!joined.empty()) joined += "; ";
    joined += entry->desc;
  }
  return 0;
}

}  // namespace

void prepare_hdf5() {
  H5dont_atexit();  // refused, and not needed, once the library is open
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void check(herr_t status, const std::string& call) {
  if (status >= 0) return;
  std::string reasons;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reasons);
  H5Eclear2(H5E_DEFAULT);
  throw core::RunError(call + ": " + (reasons.empty() ? "HDF5 gives no reason" : reasons));
}

}  // namespace pbmpi::io
