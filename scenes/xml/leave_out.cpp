#include "scenes/xml/leave_out.h"

#include "core/text.h"

namespace pbmpi::scenes::xml {

bool LeaveOut::drops(std::string_view name, const std::string& where) const {
  if (!names(name)) return false;
  notes_.add(where, core::in_quotes(name) + " is left out");
  return true;
}

std::string LeaveOut::advice(std::string_view name) {
  return "leave it out (leave_out = [\"" + std::string(name) + "\"] in a TOML scene)";
}

}  // namespace pbmpi::scenes::xml
