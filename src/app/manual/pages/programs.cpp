#include "app/manual/pages/programs.h"

#include <algorithm>

#include "app/pbmpi/options/options.h"
#include "app/pbreport/commands.h"
#include "app/pbstudy/commands.h"

namespace pbmpi::app {
namespace {

/// The commands of a table, except the one that is the program itself.
template <class Commands>
std::vector<Manual> manuals_of(const Commands& commands, const Manual& program) {
  std::vector<Manual> manuals;
  for (const auto& command : commands) {
    Manual manual = command.manual();
    if (manual.name == program.name) continue;
    manual.meaning = command.meaning;
    manuals.push_back(manual);
  }
  return manuals;
}

}  // namespace

std::vector<ProgramManual> all_manuals() {
  return {{pbmpi_manual(), {}, false},
          {pbstudy_manual(), manuals_of(study_commands(), pbstudy_manual()), false},
          {pbreport_manual(), manuals_of(report_commands(), pbreport_manual()), true}};
}

std::string word_of(const Manual& command) { return command.name.substr(command.name.rfind(' ') + 1); }

std::string page_name(const Manual& manual) {
  std::string name = manual.name;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string one_line(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  return text.substr(0, text.rfind(' ', most)) + " ...";
}

}  // namespace pbmpi::app
