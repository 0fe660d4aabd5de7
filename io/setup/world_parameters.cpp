/// Group /world_parameters: the parameters in which worlds differ from the scene.
#include <algorithm>

#include "io/setup/static_columns.h"

namespace pbmpi::io {

void write_world_parameters(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  if (setup.world_parameters.empty()) return;
  ColumnWriter columns(ranks, file, "/world_parameters",
                       rows_in_world_order(ranks, setup, [](const auto&) { return std::size_t{1}; }));
  const auto own = [&setup](const auto& all) {
    std::decay_t<decltype(all)> values;
    for (const stepping::LocalWorld& local : setup.worlds)
      values.push_back(all[static_cast<std::size_t>(local.id)]);
    return values;
  };
  for (const WorldParameter& parameter : setup.world_parameters) {
    std::string name = parameter.key;
    std::ranges::replace(name, '/', '.');  // a slash would open a group
    if (parameter.texts.empty()) {
      columns.numbers(name, own(parameter.numbers));
    } else {
      columns.texts(name, own(parameter.texts));
    }
  }
}

}  // namespace pbmpi::io
