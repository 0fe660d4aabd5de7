/// The parameter under which a file keeps a scene's text.
#pragma once

#include <algorithm>
#include <string>

namespace pbmpi::app {

/// "scene_text_NAME", without a slash, which would open a group.
inline std::string scene_text_parameter(std::string scene_name) {
  std::ranges::replace(scene_name, '/', '.');
  return "scene_text_" + scene_name;
}

}  // namespace pbmpi::app
