#include "app/common/scene_parameter.h"

#include <algorithm>

namespace pbmpi::app {

std::string scene_text_parameter(std::string scene_name) {
  std::ranges::replace(scene_name, '/', '.');
  return "scene_text_" + scene_name;
}

}  // namespace pbmpi::app
