#include "scenes/xml/include.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::xml {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view include = "include";

void collect(const Element& element, const std::string& main, std::vector<ModelPart>& found) {
  for (const Element& child : element.children) {
    if (child.name == include) {
      found.push_back({file_of(child, main), main});
    } else if (child.name == "model" && child.find("file") != nullptr) {
      const std::string file = file_of(child, main, {"name", "content_type"});
      found.push_back({file, file});
    } else {
      collect(child, main, found);
    }
  }
}

class Including {
 public:
  Including(const std::string& main, const Texts& texts, const LeaveOut& leave_out)
      : main_(main), texts_(texts), leave_out_(leave_out), seen_{main} {}

  void expand(Element& element) {
    std::vector<Element> children;
    for (Element& child : element.children) {
      if (child.name != include) {
        expand(child);
        children.push_back(std::move(child));
      } else if (!leave_out_.drops(include, child.where)) {
        const std::string file = file_of(child, main_);
        core::require_input(seen_.insert(file).second,
                            child.where + ": " + core::in_quotes(file) +
                                " is included a second time, or includes itself; include it once");
        std::ranges::move(parsed(file, child.where).children, std::back_inserter(children));
      }
    }
    element.children = std::move(children);
  }

 private:
  Element parsed(const std::string& file, const std::string& where) {
    const auto text = texts_.find(file);
    core::require_input(text != texts_.end(),
                        where + ": there is no text of " + core::in_quotes(file) +
                            "; give the path of a file, or its text in [files] of a TOML scene");
    Element root = parse(text->second, file);
    expand(root);
    return root;
  }

  const std::string& main_;
  const Texts& texts_;
  const LeaveOut& leave_out_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<ModelPart> files_in(const std::string& text, const ModelPart& part) {
  const Element root = parse(text, part.file);
  std::vector<ModelPart> found;
  const bool is_mjcf = root.name == "mujoco" || part.file != part.main;  // an included root has any name
  if (is_mjcf) collect(root, part.main, found);
  return found;
}

std::string file_of(const Element& element, const std::string& main,
                    std::initializer_list<std::string_view> others) {
  Attributes attributes(element);
  const fs::path name = fs::path(attributes.text("file")).lexically_normal();
  attributes.allow(others);
  attributes.finish();
  const bool leaves_folder = name.is_absolute() || (!name.empty() && *name.begin() == "..");
  if (name.empty() || leaves_folder)
    attributes.fail("file", "an included file lies in the folder of " + core::in_quotes(main) +
                                " or below it; move it there");
  return (fs::path(main).parent_path() / name).string();
}

void expand_includes(Element& root, const std::string& main, const Texts& texts, const LeaveOut& leave_out) {
  Including(main, texts, leave_out).expand(root);
}

}  // namespace pbmpi::scenes::xml
