/// How files name the scenes of a run or study.
#pragma once

#include <string>

namespace pbmpi::app {

/// The name of a study's parameter that holds a scene's text: '/' would open a group.
std::string scene_text_parameter(std::string scene_name);

}  // namespace pbmpi::app
