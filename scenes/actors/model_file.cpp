#include "scenes/actors/model_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/mjcf.h"
#include "scenes/mjcf/settings/mesh_reader.h"
#include "scenes/urdf/urdf.h"

namespace pbmpi::scenes {
namespace {

/// The meshes of the models among these files, once all files with XML are there.
void add_missing_meshes(const xml::Texts& texts, const std::vector<xml::ModelPart>& parts,
                        std::vector<std::string>& missing) {
  for (const xml::ModelPart& part : parts) {
    if (part.file != part.main) continue;
    const bool is_urdf = xml::parse(texts.at(part.file), part.file).name == "robot";
    for (std::string& mesh :
         is_urdf ? urdf::mesh_files(part.file, texts) : mjcf::mesh_files(part.file, texts)) {
      if (!texts.contains(mesh)) missing.push_back(std::move(mesh));
    }
  }
}

}  // namespace

bool is_model_file(const std::string& path) {
  constexpr std::array<std::string_view, 3> ends = {".xml", ".mjcf", ".urdf"};
  return std::ranges::any_of(ends, [&](std::string_view end) { return path.ends_with(end); });
}

links::ModelFile read_model_file(const xml::Texts& texts, const std::string& file,
                                 const ModelChoices& choices, xml::Notes& notes) {
  const xml::LeaveOut leave_out(choices.leave_out, notes);
  const xml::Element root = xml::parse(texts.at(file), file);
  if (root.name == "mujoco") {
    return mjcf::read(file, texts, choices.keyframe, leave_out);
  }
  core::require_input(root.name == "robot", root.where +
                                                ": neither MJCF (<mujoco>) nor URDF (<robot>), but " +
                                                core::in_quotes(root.name) + "; give one of the two");
  core::require_input(choices.keyframe.empty(),
                      root.where + ": a URDF has no keyframes; give 'joints' their starts");
  return urdf::read(root, file, texts, leave_out);
}

std::vector<std::string> missing_files(const xml::Texts& texts, const std::string& file) {
  std::vector<std::string> missing;
  std::vector<xml::ModelPart> found{{file, file}};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto text = texts.find(found[i].file);
    if (text == texts.end()) {
      missing.push_back(found[i].file);
      continue;
    }
    for (xml::ModelPart& part : xml::files_in(text->second, found[i])) {
      if (std::ranges::find(found, part.file, &xml::ModelPart::file) == found.end())
        found.push_back(std::move(part));
    }
  }
  if (missing.empty()) add_missing_meshes(texts, found, missing);
  return missing;
}

}  // namespace pbmpi::scenes
