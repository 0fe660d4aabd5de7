#include "app/pbreport/tables/table_json.h"

#include <nlohmann/json.hpp>

#include "app/common/json_text.h"

namespace pbmpi::app {

std::string to_json(const io::TableFile& file) {
  nlohmann::ordered_json json;
  for (const io::Parameter& parameter : file.parameters) json[parameter.name] = parameter.text;
  for (const auto& [name, columns] : file.tables) {
    nlohmann::ordered_json& table = json[name];
    for (const io::TableColumn& column : columns)
      std::visit([&](const auto& values) { table[column.name] = values; }, column.values);
  }
  return json_text(json, 2) + "\n";
}

}  // namespace pbmpi::app
