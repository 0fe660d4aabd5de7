# Writes OUTPUT, a C++ source that holds the text of FOLDER/<scene>.toml for each scene in SCENES, in that order.
set(entries "")
foreach(scene IN LISTS SCENES)
  file(READ ${FOLDER}/${scene}.toml text)
  string(APPEND entries "    {\"${scene}\", R\"scene_toml(${text})scene_toml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from scenes/*.toml and scenes/hard/*/*.toml by embed_scenes.cmake.
#include \"scenes/embedded.h\"

namespace pbmpi::scenes {

std::span<const EmbeddedScene> embedded_scenes() {
  static const EmbeddedScene scenes[] = {
${entries}  };
  return scenes;
}

}  // namespace pbmpi::scenes
")
