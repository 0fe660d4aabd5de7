/// Files that XML files include.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::xml {

/// Texts of files, by their names in messages.
using Texts = std::map<std::string, std::string>;

/// The names, from the folder of `main`, of the files that this MJCF includes; none if it is no MJCF. `file`:
/// its name in messages.
std::vector<std::string> included_in(const std::string& text, const std::string& file,
                                     const std::string& main);

/// Replaces each `<include>` of an MJCF by what the root of the included file holds, as MuJoCo does. Names
/// count from the folder of `main`, the file of `root`, which they cannot leave; a file is included once.
/// Throws core::InputError.
void expand_includes(Element& root, const std::string& main, const Texts& texts, const LeaveOut& leave_out);

}  // namespace pbmpi::scenes::xml
