#include "app/pbstudy/prediction/prediction_steps.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/common/json_text.h"
#include "app/common/python_program.h"
#include "core/error.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string tool_folder() { return fs::path(folder_of_program()).parent_path() / "lib" / "pbvalue"; }

std::string new_folder() {
  std::string path = (fs::temp_directory_path() / "pbmpi-prediction-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr)
    throw core::RunError(path +
                         ": the folder cannot be made; is TMPDIR a folder in which files can be made?");
  return path;
}

void put(const json& value, std::vector<std::string>& values) { values.push_back(value); }
void put(const json& value, std::vector<std::int64_t>& values) { values.push_back(value); }
/// JSON has no number for infinity, which comes as text.
void put(const json& value, std::vector<double>& values) {
  values.push_back(value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>());
}

}  // namespace

void require_tool() {
  core::require_input(fs::exists(tool_folder() + "/pbvalue-amd64-linux"),
                      "this build has no Valgrind tool pbvalue (" + tool_folder() +
                          "); install Debian's valgrind, and configure and build again");
  // The files beside Valgrind's own tools are linked, not copied: an installed pbvalue may have lost them.
  core::require_input(fs::exists(tool_folder() + "/default.supp"),
                      "Valgrind is not installed, and pbvalue needs it (" + tool_folder() +
                          "/default.supp leads nowhere); install Debian's valgrind");
}

PredictionSteps::PredictionSteps(const std::vector<StudyScene>& scenes) : folder_(new_folder()) {
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::string name = scenes[i].source.name;
    std::ranges::replace(name, '/', '_');
    const std::string own = folder_ + "/" + std::to_string(i);
    fs::create_directory(own);
    io::write_file(own + "/" + name + ".toml", scenes[i].source.text);
  }
}

PredictionSteps::~PredictionSteps() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string PredictionSteps::answer(const std::string& step, json request, const std::string& what) const {
  request["programs"] = folder_of_program();
  request["tool"] = tool_folder();
  io::write_file(folder_ + "/request.json", json_text(request));
  const std::string output = folder_ + "/answer.json";
  const int exit_code = exit_code_of(python_command("studies", {step, folder_}), output);
  std::ostringstream text;
  text << std::ifstream(output).rdbuf();
  if (exit_code != 0)
    throw core::RunError(what + (text.str().empty()
                                     ? ": Python ended with exit code " + std::to_string(exit_code)
                                     : text.str()));
  return text.str();
}

std::vector<io::TableColumn> empty_columns(const json& columns) {
  std::vector<io::TableColumn> all;
  all.reserve(columns.size());
  for (const json& one : columns) {
    io::TableColumn column{one.at("name"), one.at("unit"), {}, one.at("width")};
    if (one.at("type") == "integer") column.values = std::vector<std::int64_t>();
    if (one.at("type") == "text") column.values = std::vector<std::string>();
    all.push_back(std::move(column));
  }
  return all;
}

void add_row(const json& row, std::vector<io::TableColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const json& value = row.at(i);
    const auto put_all = [&](auto& values) {
      if (!value.is_array()) return put(value, values);
      for (const json& one : value) put(one, values);
    };
    std::visit(put_all, columns[i].values);
  }
}

}  // namespace pbmpi::app
