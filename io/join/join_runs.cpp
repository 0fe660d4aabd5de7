#include "io/join/join_runs.h"

#include <sys/stat.h>

#include <algorithm>
#include <memory>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/system/paths.h"
#include "io/file/output_target.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/commit_record.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/read_columns.h"
#include "io/join/copy_objects.h"
#include "io/join/join_events.h"
#include "io/join/join_plan.h"
#include "io/join/join_rows.h"
#include "io/join/run_outline.h"
#include "io/join/run_settings.h"
#include "io/table/table_file.h"

namespace pbmpi::io {
namespace {

/// A file that has been checked.
struct Source {
  RunOutline run;
  File file;
  PartFrames frames;

  explicit Source(const std::string& path) : run(read_outline(path)), file(open_run(path)) {
    frames = {path, run.frames.empty() ? 0 : run.frames.front().frame, std::ssize(run.frames)};
  }
};

void require_distinct(const std::vector<std::string>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      core::require_input(!core::is_same_file(paths[i], paths[k]),
                          paths[i] + ": it is named twice; name each file once");
  }
}

/// Opens all files, sorted by first frame, and by their ends where those are equal.
std::vector<std::unique_ptr<Source>> open_all(const std::vector<std::string>& paths) {
  std::vector<std::unique_ptr<Source>> sources;
  sources.reserve(paths.size());
  for (const std::string& path : paths) sources.push_back(std::make_unique<Source>(path));
  std::ranges::stable_sort(sources, [](const auto& a, const auto& b) {
    return std::pair(a->frames.first, a->frames.end()) < std::pair(b->frames.first, b->frames.end());
  });
  return sources;
}

void require_same_attribute(const Source& a, const Source& b, const std::string& name,
                            const std::string& advice) {
  const auto value = [&name](const Source& source) {
    const auto found = source.run.attributes.find(name);
    return found == source.run.attributes.end() ? std::string("(none)") : found->second;
  };
  core::require_input(value(a) == value(b), a.frames.path + " and " + b.frames.path +
                                                " cannot be joined: " + name + " is " + value(a) + " and " +
                                                value(b) + "; " + advice);
}

/// Throws unless all frames have the same number of steps, starting from the first frame.
void require_steps(const Source& source) {
  const std::int64_t steps_per_frame = std::atoll(source.run.parameters.at("steps_per_frame").c_str());
  for (const FrameNumber& frame : source.run.frames)
    core::require_input(frame.step == (frame.frame + 1) * steps_per_frame,
                        source.frames.path + ": frame " + std::to_string(frame.frame) + " ends with step " +
                            std::to_string(frame.step) + ", which is none of one run");
}

/// The columns of /world_results that describe each part's own frames.
std::set<std::string> result_datasets(hid_t file) {
  std::set<std::string> paths;
  if (!has_object(file, world_results)) return paths;
  for (const std::string& name : names_in(file, world_results))
    paths.insert(std::string(world_results) + "/" + name);
  return paths;
}

void require_one_run(const Source& a, const Source& b) {
  const std::string& path_a = a.frames.path;
  const std::string& path_b = b.frames.path;
  require_same_attribute(a, b, "version", "only files of one layout can be");
  require_same_attribute(a, b, "pbmpi_version", "only one version of pbmpi gives the same bits");
  require_same_attribute(a, b, "scene", "they are of two runs");
  require_same_attribute(a, b, "record_every", "record all with the same interval");
  std::vector<ParameterDifference> apart;
  for (const Matters matters : {Matters::results, Matters::seed, Matters::estimate}) {
    const auto more = differences(a.run.parameters, b.run.parameters, matters);
    apart.insert(apart.end(), more.begin(), more.end());
  }
  core::require_input(apart.empty(), path_a + " and " + path_b + " are not of one run: " +
                                         (apart.empty() ? "" : text_of(apart.front(), path_a, path_b)));
  std::set<std::string> of_a_part = growing_datasets();
  of_a_part.merge(result_datasets(a.file.id()));
  require_same_objects(a.file.id(), path_a, b.file.id(), path_b, of_a_part);
}

std::vector<JoinPart> parts_of(const std::vector<std::unique_ptr<Source>>& sources) {
  std::vector<JoinPart> parts;
  parts.reserve(sources.size());
  for (const auto& source : sources)
    parts.push_back({source->frames.path, source->file.id(), std::ssize(source->run.hosts)});
  return parts;
}

CommonTables tables_of(const std::vector<JoinPart>& parts, bool common_only) {
  CommonTables common = common_tables(parts);
  std::string names;
  for (const std::string& name : common.of_some) names += (names.empty() ? "" : ", ") + name;
  core::require_input(common.of_some.empty() || common_only,
                      "not all files have " + names +
                          " (--record contacts and its like are to be asked for again with "
                          "--resume); --common leaves out what only some have");
  return common;
}

/// Writes the ranks and hosts of the part with the most ranks; a rank that had another host before lists
/// both.
void write_ranks(const std::vector<std::unique_ptr<Source>>& sources, hid_t to) {
  std::vector<std::string> hosts;
  for (const auto& source : sources) {
    const std::vector<std::string>& of_part = source->run.hosts;
    hosts.resize(std::max(hosts.size(), of_part.size()));
    for (std::size_t rank = 0; rank < of_part.size(); ++rank) {
      std::string& all = hosts[rank];
      if ((", " + all + ", ").find(", " + of_part[rank] + ", ") == std::string::npos)
        all += (all.empty() ? "" : ", ") + of_part[rank];
    }
  }
  std::vector<std::int64_t> worlds = read_integers(sources.front()->file.id(), "/ranks/worlds_at_start");
  worlds.resize(hosts.size());
  std::vector<std::int32_t> rank, owned_worlds;
  std::size_t longest = 1;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    rank.push_back(static_cast<std::int32_t>(i));
    owned_worlds.push_back(static_cast<std::int32_t>(worlds[i]));
    longest = std::max(longest, hosts[i].size());
  }
  std::string names;
  for (std::string host : hosts) {
    host.resize(longest, '\0');
    names += host;
  }
  const auto write = [&](const char* path, const Datatype& type, const void* values) {
    const Dataset dataset = create_fixed(to, path, type, {hosts.size()}, "");
    check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "H5Dwrite");
  };
  write("/ranks/rank", number_type(H5T_NATIVE_INT32), rank.data());
  write("/ranks/host", text_type(longest), names.data());
  write("/ranks/worlds_at_start", number_type(H5T_NATIVE_INT32), owned_worlds.data());
}

/// Differences from the first part in settings that do not matter, e.g. "ranks is 3".
std::vector<std::string> differences_from(const Source& first, const Source& other) {
  std::vector<std::string> texts;
  for (const ParameterDifference& one :
       differences(first.run.parameters, other.run.parameters, Matters::nothing)) {
    if (one.name != "resumed_from" && one.name != "joined_from" && one.name != "frames" &&
        !one.name.starts_with("env_"))
      texts.push_back(one.name + " is " + one.b);
  }
  const auto revision = [](const Source& source) {
    const auto found = source.run.attributes.find("git_revision");
    return found == source.run.attributes.end() ? std::string() : found->second;
  };
  if (revision(first) != revision(other)) texts.push_back("git_revision is " + revision(other));
  return texts;
}

JoinedRun describe(const std::vector<std::unique_ptr<Source>>& sources, const JoinPlan& plan) {
  JoinedRun joined;
  for (const auto& source : sources)
    joined.parts.push_back({source->frames.path, source->frames.first, source->frames.count, 0,
                            differences_from(*sources.front(), *source)});
  for (const Stretch& stretch : plan.stretches()) joined.parts[stretch.part].num_used += stretch.count;
  joined.first_frame = plan.first();
  joined.num_frames = plan.num_frames();
  const auto& attributes = sources[plan.stretches().back().part]->run.attributes;
  joined.complete = attributes.at("complete") != "0";
  joined.state_hash = attributes.at("state_hash");
  if (joined.state_hash.find_first_not_of(' ') == std::string::npos) joined.state_hash.clear();
  return joined;
}

/// One line per part, for /parameters/joined_from.
std::string provenance(const JoinedRun& joined, const std::vector<std::unique_ptr<Source>>& sources) {
  std::string text;
  for (std::size_t i = 0; i < joined.parts.size(); ++i) {
    const JoinedRun::Part& part = joined.parts[i];
    text += part.path + ": frames " + std::to_string(part.first_frame) + " to " +
            std::to_string(part.first_frame + part.num_frames - 1) + ", " + std::to_string(part.num_used) +
            " of them taken; created " + sources[i]->run.attributes.at("created");
    for (const std::string& one : part.differs) text += "; " + one;
    text += "\n";
    const auto& parameters = sources[i]->run.parameters;
    if (const auto before = parameters.find("joined_from"); before != parameters.end()) {
      std::istringstream lines(before->second);
      for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
    }
  }
  return text;
}

void write_parameters(const std::vector<std::unique_ptr<Source>>& sources, const JoinPlan& plan,
                      const std::string& joined_from, hid_t to) {
  const Source& last = *sources[plan.stretches().back().part];
  std::size_t num_ranks = 0;
  for (const auto& source : sources) num_ranks = std::max(num_ranks, source->run.hosts.size());
  const auto put = [to](const Parameter& value) {
    create_scalar(to, "/parameters/" + value.name, value, true);
  };
  put(Parameter::of("frames",
                    static_cast<std::int64_t>(std::atoll(last.run.parameters.at("frames").c_str()))));
  put(Parameter::of("ranks", static_cast<std::int64_t>(num_ranks)));
  put(Parameter::of("joined_from", joined_from));
}

/// Bytes of the files on the disk: the file of a killed run is as long as the run was planned to be.
std::int64_t bytes_of(const std::vector<std::string>& paths) {
  constexpr std::int64_t block_bytes = 512;
  std::int64_t bytes = 0;
  for (const std::string& path : paths) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0)
      bytes += std::min<std::int64_t>(status.st_size, block_bytes * status.st_blocks);
  }
  return bytes;
}

/// Declares the joined frames committed, and gives the file its name.
void commit(OutputTarget& target, const JoinedRun& joined, const EventCounts& counts) {
  CommitRecord record(target.temporary_path());
  record.commit(joined.num_frames, counts);
  record.finish(joined.complete, joined.state_hash, counts);
  store_fixed_checksum(record.id());
  store_end_checksum(record.id());
  record.close();
  target.publish();
}

}  // namespace

JoinedRun join_runs(const std::vector<std::string>& paths, const std::string& output, bool common_only) {
  core::require_input(paths.size() > 1, "join: name two files or more, of a run and of what went on from it");
  require_distinct(paths);
  const auto sources = open_all(paths);
  std::vector<PartFrames> frames;
  for (const auto& source : sources) {
    require_steps(*source);
    if (source != sources.front()) require_one_run(*sources.front(), *source);
    frames.push_back(source->frames);
  }
  const JoinPlan plan(std::move(frames), sources.front()->run.record_every);
  const std::vector<JoinPart> parts = parts_of(sources);
  JoinedRun joined;
  EventCounts counts;
  OutputTarget target;
  WrittenFile file;
  try {
    const CommonTables common = tables_of(parts, common_only);
    require_equal_overlaps(parts, common, plan);
    const JoinedEvents events(parts, plan);
    joined = describe(sources, plan);
    joined.left_out = common.of_some;

    target = output_target(output, filetype, bytes_of(paths));
    file = WrittenFile::create(target.temporary_path());
    std::set<std::string> left_out = result_datasets(parts.front().file);
    left_out.insert(common.left_out.begin(), common.left_out.end());
    CopyPlan copy{grown_datasets(parts, common, plan, events.num_rows()),
                  left_out,
                  {"/ranks/rank", "/ranks/host", "/ranks/worlds_at_start", "/parameters/frames",
                   "/parameters/ranks", "/parameters/joined_from"}};
    copy_objects(parts.front().file, file.id(), copy);
    write_ranks(sources, file.id());
    write_parameters(sources, plan, provenance(joined, sources), file.id());
    write_joined_rows(parts, common, plan, file.id());
    events.write(file.id());
    counts = events.counts();
  } catch (const core::RunError& error) {
    throw core::InputError("the files cannot be joined: " + std::string(error.what()));
  }
  try {  // from here on it is the disk that fails, not what was read
    file.close();
    commit(target, joined, counts);
  } catch (const core::RunError& error) {
    throw core::RunError("cannot write " + output + ": " + error.what());
  }
  return joined;
}

}  // namespace pbmpi::io
