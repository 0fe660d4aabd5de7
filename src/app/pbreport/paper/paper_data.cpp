#include "app/pbreport/paper/paper_data.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/pbreport/study/study_file.h"
#include "core/error.h"
#include "core/text.h"
#include "io/hdf5/file_types.h"
#include "stepping/names.h"
#include "stepping/run_event.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;
using core::InputError;

struct GivenFile {
  std::string path;
  bool is_named = false;  ///< itself, rather than its folder
};

bool is_data(const fs::path& path) { return path.extension() == ".h5" || path.extension() == ".json"; }

std::vector<GivenFile> files_of(const std::vector<std::string>& paths) {
  std::vector<GivenFile> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back({path, true});
      continue;
    }
    std::vector<std::string> below;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file() && is_data(entry.path())) below.push_back(entry.path().string());
    }
    std::ranges::sort(below);
    for (std::string& one : below) files.push_back({std::move(one), false});
  }
  return files;
}

std::map<std::string, std::vector<int>> count_actor_bodies(const io::BodyTable& bodies) {
  std::map<std::string, std::map<std::pair<int, std::string>, int>> counts;  // kind -> actor -> bodies
  for (std::size_t i = 0; i < bodies.id.size(); ++i)
    ++counts[bodies.kind[i]][{bodies.world[i], bodies.actor[i]}];
  std::map<std::string, std::vector<int>> found;
  for (const auto& [kind, actors] : counts) {
    std::vector<int>& numbers = found[kind];
    for (const auto& [actor, number] : actors) {
      if (std::ranges::find(numbers, number) == numbers.end()) numbers.push_back(number);
    }
    std::ranges::sort(numbers);
  }
  return found;
}

SuiteRun suite_run(const io::RunData& run, const std::string& path) {
  SuiteRun result{
      summarize_islands(run),        {}, summarize_cores(run, path), island_work(run, path), run.num_events,
      count_actor_bodies(run.bodies)};
  const io::Table& islands = run.observables.at("islands");
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (!run.frame_measured[frame]) continue;
    double sum = 0;
    for (const double of_world : islands[frame]) sum += of_world;
    result.islands_by_frame.push_back(sum);
  }
  return result;
}

const std::string& scene_of(const SuiteRun& run) { return run.islands.scene; }
const std::string& scene_of(const IslandWork& work) { return work.scene; }
const std::string& scene_of(const FigureScene& scene) { return scene.name; }

/// Sorts into the order of the paper's Table 1; other scenes come last.
template <class Of>
void sort_scenes(std::vector<Of>& scenes) {
  const auto place = [](const Of& one) {
    const auto& rows = paper_rows();
    return std::ranges::find(rows, scene_of(one), &PaperRow::scene) - rows.begin();
  };
  std::ranges::stable_sort(scenes, {}, place);
}

/// A run with --record-islands, or the least times of its repeats.
struct ProfiledRun {
  std::string path;
  io::RunData run;
};

void keep_least(io::Table& times, const io::Table& others) {
  for (std::size_t row = 0; row < std::min(times.size(), others.size()); ++row) {
    for (std::size_t i = 0; i < times[row].size(); ++i)
      times[row][i] = std::min(times[row][i], others[row][i]);
  }
}

/// Keeps the lesser of each two times of the same run: other programs on the machine only add time.
void keep_least(io::RunData& run, const io::RunData& repeat) {
  for (auto& [name, times] : run.rank_times) keep_least(times, repeat.rank_times.at(name));
  for (auto& [name, times] : run.space_times) keep_least(times, repeat.space_times.at(name));
  for (std::size_t frame = 0; frame < std::min(run.islands.size(), repeat.islands.size()); ++frame) {
    run.frame_wall_s[frame] = std::min(run.frame_wall_s[frame], repeat.frame_wall_s[frame]);
    for (std::size_t i = 0; i < run.islands[frame].size(); ++i) {
      double& solve_s = run.islands[frame][i].solve_s;
      solve_s = std::min(solve_s, repeat.islands[frame][i].solve_s);
    }
  }
}

bool is_same_setting(const io::RunData& a, const io::RunData& b) {
  return std::ranges::all_of(std::array{"scene", "stepper", "iterations"}, [&](const char* name) {
    return core::value_in(a.parameters, name) == core::value_in(b.parameters, name);
  });
}

void add_profiled(ProfiledRun added, std::vector<ProfiledRun>& runs) {
  const auto same =
      std::ranges::find_if(runs, [&](const ProfiledRun& one) { return is_same_setting(one.run, added.run); });
  if (same == runs.end()) {
    runs.push_back(std::move(added));
    return;
  }
  core::require_input(
      same->run.attributes.at("state_hash") == added.run.attributes.at("state_hash"),
      added.path + " and " + same->path + " are different runs of one scene and setting; name repeats only");
  keep_least(same->run, added.run);
}

void sort_in(const ProfiledRun& profiled, PaperData& data) {
  const auto& [path, run] = profiled;
  if (core::value_in(run.parameters, "stepper") == name_of(stepping::StepperKind::direct)) {
    data.direct.push_back(island_work(run, path));
  } else if (core::value_in(run.parameters, "iterations") == "20") {
    data.suite.push_back(suite_run(run, path));
  } else if (core::value_in(run.parameters, "iterations") == "1") {
    data.one_iteration.push_back(suite_run(run, path));
  } else {
    data.more_iterations.push_back(island_work(run, path));
  }
}

void add_run(const std::string& path, PaperData& data, std::vector<ProfiledRun>& profiled,
             std::vector<std::string>& figures) {
  io::RunData run = io::read_run(path);
  data.files.emplace_back(path, run.attributes);
  if (core::value_in(run.parameters, "effects").find("-fast_bodies") != std::string::npos) {
    const auto passages = run.num_events.find(stepping::event_kind::passage);
    data.plain.push_back(
        {core::value_in(run.parameters, "scene"), passages == run.num_events.end() ? 0 : passages->second});
  } else if (run.islands.empty()) {
    figures.push_back(path);
  } else {
    add_profiled({path, std::move(run)}, profiled);
  }
}

void add_study(const GivenFile& file, PaperData& data) {
  const std::string kind = study_named_in({file.path});
  if (kind == "prediction") {
    core::require_input(!data.prediction, file.path + ": a second study of prediction; name one");
    const io::TableFile table = read_study(file.path, kind);
    data.prediction = prediction_study(table, {});
    data.files.emplace_back(file.path, table.attributes);
  } else if (kind == "stability") {
    core::require_input(!data.stability, file.path + ": a second study of stability; name one");
    const io::TableFile table = read_study(file.path, kind);
    data.stability = stability_map(table, {});
    data.files.emplace_back(file.path, table.attributes);
  } else if (file.is_named) {
    throw InputError(file.path + ": a study of " + kind + ", which decides nothing of the paper");
  }
}

void add_counts(const GivenFile& file, PaperData& data) {
  if (!file.is_named && !has_counts(file.path)) return;
  core::require_input(data.counts.empty(), file.path + ": second counts of instructions; name one file");
  data.counts = read_counts(file.path);
  data.files.emplace_back(file.path, std::map<std::string, std::string>{{"command_line", "jobs/figure3.sh"}});
}

}  // namespace

const SuiteRun* PaperData::find(const std::string& scene) const {
  const auto found = std::ranges::find_if(suite, [&](const SuiteRun& run) { return scene_of(run) == scene; });
  return found == suite.end() ? nullptr : &*found;
}

std::vector<IslandWork> PaperData::works() const {
  std::vector<IslandWork> all;
  all.reserve(suite.size());
  for (const SuiteRun& run : suite) all.push_back(run.work);
  return all;
}

PaperData read_paper_data(const std::vector<std::string>& paths) {
  PaperData data;
  std::vector<std::string> figures;
  std::vector<ProfiledRun> profiled;
  for (const GivenFile& file : files_of(paths)) {
    if (fs::path(file.path).extension() == ".json") {
      add_counts(file, data);
    } else if (io::filetype_of(file.path) == study_filetype) {
      add_study(file, data);
    } else if (file.is_named || io::filetype_of(file.path) == io::filetype) {
      add_run(file.path, data, profiled, figures);
    }
  }
  for (const ProfiledRun& run : profiled) sort_in(run, data);
  if (!figures.empty()) data.figures = recorded_figures(figures).scenes;
  sort_scenes(data.suite);
  sort_scenes(data.one_iteration);
  sort_scenes(data.direct);
  sort_scenes(data.figures);
  core::require_input(!data.files.empty(), "paper: no file of jobs/paper.sh found in what is named");
  return data;
}

}  // namespace pbmpi::app
