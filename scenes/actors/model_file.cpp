#include "scenes/actors/model_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/mjcf.h"
#include "scenes/urdf/urdf.h"

namespace pbmpi::scenes {

bool is_model_file(const std::string& path) {
  constexpr std::array<std::string_view, 3> ends = {".xml", ".mjcf", ".urdf"};
  return std::ranges::any_of(ends, [&](std::string_view end) { return path.ends_with(end); });
}

links::ModelFile read_model_file(const std::string& text, const std::string& file,
                                 const std::set<std::string>& leave_out, xml::Notes& notes) {
  const xml::Element root = xml::parse(text, file);
  if (root.name == "mujoco") return mjcf::read(root, leave_out, notes);
  if (root.name == "robot") return urdf::read(root, leave_out, notes);
  throw core::InputError(root.where + ": neither MJCF (<mujoco>) nor URDF (<robot>), but " +
                         core::in_quotes(root.name) + "; give one of the two");
}

}  // namespace pbmpi::scenes
