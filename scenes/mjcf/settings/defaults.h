/// MJCF's default classes: attributes that elements have unless they override them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/mjcf/settings/compiler.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::mjcf {

/// Does MJCF have an actuator of that name?
bool is_actuator(std::string_view element);

class Defaults {
 public:
  /// Reads a top-level `<default>` with the classes in it; later ones complete earlier ones.
  void read(const xml::Element& element);

  /// The defaults that `element` takes from its own class, or else from `childclass` of the bodies around it
  /// ("": the topmost class). The first attribute of a name counts. `kind`: the element of `<default>` that
  /// has them, if that is not called as this one. Throws core::InputError for an unknown class.
  std::vector<xml::Attribute> of(const xml::Element& element, const std::string& childclass,
                                 std::string_view kind = {}) const;

 private:
  using ByElement = std::map<std::string, std::vector<xml::Attribute>, std::less<>>;
  void read_class(const xml::Element& element, const std::string& name);

  std::map<std::string, ByElement> classes_{{"main", {}}};
};

class Meshes;

/// What the rest of the file specifies about its bodies and servos.
struct Context {
  Compiler compiler;
  Option option;
  Defaults defaults;
  const xml::LeaveOut& leave_out;
  std::shared_ptr<Meshes> meshes = nullptr;  ///< mesh_reader.h
};

}  // namespace pbmpi::scenes::mjcf
