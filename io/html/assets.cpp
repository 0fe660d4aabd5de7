#include "io/html/assets.h"

#include <array>
#include <stdexcept>
#include <string>

// CMake generates asset_list.inc along with the assembly that embeds the files: one PBMPI_ASSET(id) each.
extern "C" {
#define PBMPI_ASSET(id) extern const char pbmpi_asset_##id##_begin[], pbmpi_asset_##id##_end[];
#include "asset_list.inc"
#undef PBMPI_ASSET
}

namespace pbmpi::io::html {
namespace {

struct Asset {
  std::string_view id;
  const char* begin;
  const char* end;
};

constexpr auto assets = std::to_array<Asset>({
#define PBMPI_ASSET(id) {#id, pbmpi_asset_##id##_begin, pbmpi_asset_##id##_end},
#include "asset_list.inc"
#undef PBMPI_ASSET
});

}  // namespace

std::string_view asset(std::string_view id) {
  for (const Asset& entry : assets) {
    if (entry.id == id) return {entry.begin, static_cast<std::size_t>(entry.end - entry.begin)};
  }
  throw std::logic_error("no embedded file '" + std::string(id) + "'; list it in io/html/CMakeLists.txt");
}

}  // namespace pbmpi::io::html
