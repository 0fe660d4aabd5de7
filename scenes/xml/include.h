/// Files that XML files include.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::xml {

/// Texts of files, by their names in messages.
using Texts = std::map<std::string, std::string>;

/// A file of a model.
struct ModelPart {
  std::string file;  ///< its name in messages and in Texts
  std::string
      main;  ///< the model from whose folder the names in it count: the file itself, or what includes it
};

/// The files that this MJCF includes, and the models that its `<asset>` names; none if it is no MJCF.
std::vector<ModelPart> files_in(const std::string& text, const ModelPart& part);

/// The name in Texts of the file that an element of `main` names in its attribute 'file'. Throws
/// core::InputError for a file outside of the folder of `main`, or with other attributes than `others`.
std::string file_of(const Element& element, const std::string& main,
                    std::initializer_list<std::string_view> others = {});

/// Replaces each `<include>` of an MJCF by what the root of the included file holds, as MuJoCo does. Names
/// count from the folder of `main`, the file of `root`, which they cannot leave; a file is included once.
/// Throws core::InputError.
void expand_includes(Element& root, const std::string& main, const Texts& texts, const LeaveOut& leave_out);

}  // namespace pbmpi::scenes::xml
