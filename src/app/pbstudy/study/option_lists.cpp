#include "app/pbstudy/study/option_lists.h"

namespace pbmpi::app {

void require_at_least(const std::vector<int>& given, int least, const char* option) {
  for (const int value : given) {
    core::require_input(value >= least, std::string(option) + " " + std::to_string(value) +
                                            ": it must be at least " + std::to_string(least));
  }
}

std::optional<int> given(const boost::program_options::variables_map& values, const char* name, int least) {
  if (values.count(name) == 0) return std::nullopt;
  const int value = values[name].as<int>();
  require_at_least({value}, least, ("--" + std::string(name)).c_str());
  return value;
}

}  // namespace pbmpi::app
