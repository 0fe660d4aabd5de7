#include "scenes/mjcf/attachments.h"

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/settings/mesh_reader.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

/// Finds the element of that kind and name below `around`, and the class that elements around it give it.
bool find_below(const xml::Element& around, std::string_view kind, const std::string& name,
                const std::string& childclass, Attached& found) {
  for (const xml::Element& child : around.children) {
    const xml::Attribute* own = child.find("name");
    if (child.name == kind && own != nullptr && own->value == name) {
      found.element = &child;
      found.childclass = childclass;
      return true;
    }
    const xml::Attribute* inner = child.find("childclass");
    if (find_below(child, kind, name, inner == nullptr ? childclass : inner->value, found)) return true;
  }
  return false;
}

}  // namespace

std::vector<const xml::Element*> Part::sections(std::string_view name) const {
  std::vector<const xml::Element*> found;
  for (const xml::Element& one : root->children) {
    if (one.name == name) found.push_back(&one);
  }
  return found;
}

Attachments::Attachments(const std::string& file, const xml::Texts& texts, const xml::LeaveOut& leave_out)
    : texts_(texts), leave_out_(leave_out) {
  Source& source = source_of(file);
  parts_.push_back({file, &source.root, &source.context, nullptr, ""});
  for (const xml::Element* one : main().sections("option"))
    read_option(*one, leave_out, source.context.option);
}

Attached Attachments::attach(const xml::Element& element, const Part& into) {
  Attributes attach(element);
  const std::string file = attach.has("model") ? file_of(attach, into) : into.file;
  Attached attached;
  const std::string prefix = attach.text("prefix");
  const bool has_body = attach.has("body"), has_frame = attach.has("frame");
  if (has_body && has_frame)
    attach.fail("frame", "'body' and 'frame' both say what is attached; leave out one");
  if (!attach.has("model") && !has_body && !has_frame)
    attach.fail("it has no 'model', 'body' or 'frame'; name what is to be attached");
  const Source& source = source_of(file);
  parts_.push_back({file, &source.root, &source.context, &into, into.prefix + prefix});
  attached.part = &parts_.back();
  const std::vector<const xml::Element*> worlds = attached.part->sections("worldbody");
  core::require_input(!worlds.empty(), attach.where() + ": there is no <worldbody> in " +
                                           core::in_quotes(file) + "; attach a model with bodies");
  const std::string kind = has_body ? "body" : "frame", name = attach.text(kind, "");
  attach.finish();
  if (!has_body && !has_frame) {
    core::require_input(worlds.size() == 1, attach.where() + ": " + core::in_quotes(file) +
                                                " has several <worldbody>; name a 'body' or a 'frame' of it");
    attached.element = worlds.front();
    return attached;
  }
  for (const xml::Element* world : worlds) {
    if (find_below(*world, kind, name, "", attached)) return attached;
  }
  attach.fail(kind, core::in_quotes(file) + " has no " + kind + " " + core::in_quotes(name) +
                        "; name one that it has");
}

Attachments::Source& Attachments::source_of(const std::string& file) {
  const auto known = sources_.find(file);
  if (known != sources_.end()) return known->second;
  xml::Element root = xml::parse(texts_.at(file), file);
  core::require_input(root.name == "mujoco", root.where +
                                                 ": the root of a model to attach is <mujoco>, not " +
                                                 core::in_quotes(root.name) + "; give an MJCF");
  xml::expand_includes(root, file, texts_, leave_out_);
  const Option option = parts_.empty() ? Option() : main().context->option;
  Context context{Compiler(), option, Defaults(), leave_out_};
  for (const xml::Element& one : root.children) {
    if (one.name == "compiler") read_compiler(one, leave_out_, context.compiler);
    if (one.name == "default") context.defaults.read(one);
  }
  Source& source = sources_.emplace(file, Source{std::move(root), std::move(context)}).first->second;
  source.context.meshes =
      std::make_shared<Meshes>(source.root, file, texts_, source.context.defaults, leave_out_.notes());
  return source;
}

std::string Attachments::file_of(Attributes& attach, const Part& into) {
  const std::string wanted = attach.text("model");
  std::vector<std::string> names;
  for (const xml::Element* assets : into.sections("asset")) {
    for (const xml::Element& model : assets->children) {
      if (model.name != "model") continue;
      std::string file = xml::file_of(model, into.file, {"name", "content_type"});
      core::require_input(texts_.contains(file),
                          model.where + ": there is no text of " + core::in_quotes(file) +
                              "; give the path of a file, or its text in [files] of a TOML scene");
      names.push_back(Attributes(model).text("name", Attributes(source_of(file).root).text("model", "")));
      if (names.back() == wanted) return file;
    }
  }
  attach.fail("model", "no <model> of <asset> is called " + core::in_quotes(wanted) +
                           (names.empty() ? "; name one there" : core::suggestion(wanted, names)));
}

}  // namespace pbmpi::scenes::mjcf
