# Writes OUTPUT, a C++ source that holds the text of FOLDER/<scene>.toml for each scene in SCENES, in that order. The folder
# tells a scene's group; a scene of effects/ goes by its name alone.
set(entries "")
foreach(scene IN LISTS SCENES)
  file(READ ${FOLDER}/${scene}.toml text)
  set(group paper)
  if(scene MATCHES "^(effects|exact|hard)/")
    set(group ${CMAKE_MATCH_1})
  endif()
  string(REGEX REPLACE "^effects/" "" name ${scene})
  string(APPEND entries "    {SceneGroup::${group}, \"${name}\", R\"scene_toml(${text})scene_toml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from the scene files by embed_scenes.cmake.
#include \"scenes/embedded.h\"

namespace pbmpi::scenes {

std::span<const EmbeddedScene> embedded_scenes() {
  static const EmbeddedScene scenes[] = {
${entries}  };
  return scenes;
}

}  // namespace pbmpi::scenes
")
