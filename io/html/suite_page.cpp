#include "io/html/suite_page.h"

#include <nlohmann/json.hpp>
#include <span>

#include "io/file/write_file.h"
#include "io/html/assets.h"
#include "io/html/base64.h"
#include "io/html/escape.h"
#include "io/html/fill_template.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

std::string suite_json(const std::vector<SuiteScene>& scenes) {
  json rows = json::array();
  for (const SuiteScene& scene : scenes) {
    rows.push_back(
        {{"name", scene.name},
         {"islands", json::parse(scene.islands_json)},
         {"cores", json::parse(scene.cores_json)},
         {"still", scene.still_png.empty() ? json(nullptr)
                                           : json("data:image/png;base64," +
                                                  base64(std::as_bytes(std::span(scene.still_png))))}});
  }
  return dump(rows);
}

}  // namespace

void write_suite_page(const std::string& path, const std::vector<SuiteScene>& scenes,
                      const Provenance& provenance) {
  write_file(path, fill_template(asset("suite_html"), [&](std::string_view name) {
               if (name == "suite") return suite_json(scenes);
               if (name == "provenance") return provenance_json(provenance);
               return std::string(asset(name));
             }));
}

}  // namespace pbmpi::io::html
