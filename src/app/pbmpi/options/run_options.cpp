#include "app/pbmpi/options/run_options.h"

#include <algorithm>
#include <type_traits>

#include "core/error.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "stepping/option_values.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

namespace {

using Defaults = scenes::RunDefaults;

std::string effect_list() {
  std::string list;
  for (const effects::Effect& effect : effects::effect_registry())
    list += (list.empty() ? "" : ", ") + std::string(effect.name);
  return list;
}

// Upper bounds are numbers that no run reaches, so that sums and products of such numbers have room.
constexpr int most_frames = 1'000'000'000, most_steps = 1'000'000;

std::vector<RunOption> scene_rows() {
  return {
      {.name = "scene",
       .member = &RunSpec::scene,
       .placeholder = "NAME|FILE",
       .meaning = "a scene that pbmpi brings (--list-scenes), or a file of your own: a scene (.toml), or a "
                  "model in MJCF (.xml) or URDF (.urdf)"},
      {.name = "replicas",
       .member = &RunSpec::replicas,
       .placeholder = "N",
       .meaning = "worlds; default: the scene's",
       .saved = Saved::physics,
       .recorded = true,
       .of_scene = &Defaults::replicas},
      {.name = "parameters",
       .member = &RunSpec::parameters,
       .placeholder = "FILE",
       .meaning = "what each world has otherwise than the scene: a table with a row for each world and a "
                  "column for each parameter, car.speed or world.gravity (scenes/FORMAT.md); CSV, or TOML "
                  "with [[world]] tables"},
      {.name = "world-range",
       .member = &RunSpec::range,
       .placeholder = "A:B",
       .meaning = "run the worlds A to B-1 of the ensemble only, with the bits that they have in the whole; "
                  "default of --output: <scene>.worlds<A>-<B>.h5",
       .saved = Saved::physics,
       .recorded = true},
      {.name = "frames",
       .member = &RunSpec::frames,
       .placeholder = "N",
       .meaning = "measured frames; default: the scene's",
       .saved = Saved::value,
       .recorded = true,
       .of_scene = &Defaults::frames,
       .most = most_frames},
      {.name = "warmup",
       .member = &RunSpec::warmup,
       .placeholder = "N",
       .meaning = "frames before the measured ones; default: the scene's, 3",
       .saved = Saved::value,
       .recorded = true,
       .of_scene = &Defaults::warmup,
       .least = 0,
       .most = most_frames},
      {.name = "seed",
       .member = &RunSpec::seed,
       .placeholder = "N",
       .meaning = "of the solver's row order and of the scene's variation",
       .shows_default = true,
       .saved = Saved::physics,
       .recorded = true},
      {.name = "effects",
       .member = &RunSpec::effects,
       .placeholder = "+NAME,-NAME",
       .meaning =
           "for an experiment: + demands an effect that the scene does not call for, - leaves one out; "
           "they are " +
           effect_list(),
       .saved = Saved::physics,
       .recorded = true},
  };
}

std::vector<RunOption> step_rows() {
  return {
      {.name = "steps-per-frame",
       .member = &RunSpec::steps_per_frame,
       .placeholder = "N",
       .meaning = "steps in a frame; default: the scene's, 3",
       .saved = Saved::physics,
       .recorded = true,
       .of_scene = &Defaults::steps_per_frame,
       .most = most_steps},
      {.name = "on-blowup",
       .member = &RunSpec::on_blowup,
       .placeholder = "report|stop|freeze|refine",
       .meaning =
           "what to do about a world that blows up: a number that is not finite, energy gained without "
           "a cause, a joint that gapes, a body that went through something. report: the run goes on "
           "(not with a number that is not finite); stop: the run ends after the frame; freeze: that "
           "world stands still from the start of the step on; refine: the step is done again as 2, 4, "
           "8 or 16 finer ones, and if these blow up too the world stands still",
       .shows_default = true,
       .saved = Saved::value,
       .recorded = true},
  };
}

std::vector<RunOption> cut_rows() {
  return {
      {.name = "decompose",
       .member = &RunSpec::decomposition,
       .placeholder = "auto|worlds|spaces",
       .meaning =
           "worlds: each rank owns whole worlds; spaces: a world is cut at its collision spaces, of "
           "which each rank owns some (sor only), one world over all ranks, several worlds each over a "
           "group of them; auto: with sor spaces for one world of several spaces on several ranks, and "
           "for more worlds where there are more ranks than worlds and groups are predicted to be "
           "faster; else worlds",
       .shows_default = true,
       .saved = Saved::value,
       .recorded = true},
      {.name = "ranks-per-world",
       .member = &RunSpec::ranks_per_world,
       .placeholder = "N",
       .meaning = "spaces: groups of at most N ranks, as equal as can be, of which each cuts worlds of its "
                  "own; default: as few as make the busiest group's worlds cost least, counted in rows of "
                  "joints and bodies; one world: all ranks",
       .recorded = true},
  };
}

std::vector<RunOption> output_rows() {
  return {
      {.name = "output",
       .member = &RunSpec::output,
       .letter = 'o',
       .placeholder = "FILE",
       .meaning = "HDF5 file of the run; default: <scene>.h5"},
      {.name = "no-output", .member = &RunSpec::no_output, .meaning = "write no file"},
      {.name = "no-xdmf",
       .member = &RunSpec::no_xdmf,
       .meaning = "write no sidecar for ParaView; without this it stands beside the file, <output without "
                  ".h5>.xdmf"},
      {.name = "record-every",
       .member = &RunSpec::record_every,
       .placeholder = "N",
       .meaning = "store the bodies of every Nth frame; timings are stored for all",
       .shows_default = true,
       .saved = Saved::value,
       .recorded = true},
      {.name = "record",
       .member = &RunSpec::records,
       .placeholder = "LIST",
       .meaning =
           "what else to store of the last step of each frame, e.g. contacts,residuals. islands (quick, "
           "direct): the time of each island and space, measured once more after the frame (slow; outside of "
           "the frame's time, and the states stay the same). contacts: geoms, place, normal, depth, forces, "
           "and the forces of joints. residuals (sor): how far the step is from the solution of its "
           "constraints"},
      {.name = "report",
       .member = &RunSpec::report,
       .placeholder = "text|full|json",
       .meaning =
           "the summary; full: with times of phases and ranks; json: exactly one JSON document on stdout",
       .shows_default = true},
      {.name = "budget",
       .member = &RunSpec::budget_s,
       .placeholder = "TIME",
       .meaning = "time that a frame may take, e.g. 3.33ms (us, ms, s); default: a tenth of 1/30 s",
       .saved = Saved::value,
       .recorded = true,
       .measure = &core::frame_time},
  };
}

std::vector<RunOption> stop_rows() {
  return {
      {.name = "max-time",
       .member = &RunSpec::max_time_s,
       .placeholder = "TIME",
       .meaning = "stop with a checkpoint at the end of the frame in which so much time has passed since the "
                  "start, e.g. 90s, 30min, 2h"},
      {.name = "checkpoint",
       .member = &RunSpec::checkpoint_file,
       .placeholder = "FILE",
       .meaning =
           "where the run is saved: on USR1, when it stops early, and after the last frame too if this "
           "option is given; default: <output without .h5>.checkpoint.h5, or the file of --resume"},
      {.name = "checkpoint-every",
       .member = &RunSpec::checkpoint_every_s,
       .placeholder = "TIME",
       .meaning = "save the run this often, too, e.g. 10min"},
      {.name = "resume",
       .member = &RunSpec::resume,
       .placeholder = "FILE",
       .meaning =
           "go on from a checkpoint, with any number of ranks and the same bits. Scene and physics are "
           "the checkpoint's; options that would change them are refused. --frames and --warmup count "
           "from the start of the first run. What follows goes to a file of its own; default: <first "
           "output>.from<frame>.h5"},
  };
}

constexpr const auto& names_of(stability::OnBlowup) { return stability::on_blowup_names; }
constexpr const auto& names_of(Decomposition) { return decomposition_names; }
constexpr const auto& names_of(ReportFormat) { return report_format_names; }

template <class T>
struct Type {};

bool read(const std::string&, const std::string&, const RunOption&, Type<bool>) { return true; }

void require_within(int value, const std::string& what, const RunOption& option) {
  const std::string given = what + " " + std::to_string(value);
  require_input(value >= option.least, given + ": it must be at least " + std::to_string(option.least));
  require_input(value <= option.most, given + ": it must be at most " + std::to_string(option.most));
}

int read(const std::string& text, const std::string& what, const RunOption& option, Type<int>) {
  const int value = stepping::read_number<int>(text, what);
  require_within(value, what, option);
  return value;
}

std::uint64_t read(const std::string& text, const std::string& what, const RunOption&, Type<std::uint64_t>) {
  return stepping::read_number<std::uint64_t>(text, what);
}

double read(const std::string& text, const std::string& what, const RunOption& option, Type<double>) {
  return core::read_quantity(text, what, *option.measure);
}

std::string read(const std::string& text, const std::string& what, const RunOption&, Type<std::string>) {
  require_input(!text.empty(), what + ": the name is empty; give that of a file");
  return text;
}

WorldRange read(const std::string& text, const std::string& what, const RunOption&, Type<WorldRange>) {
  return parse_world_range(text, what);
}

Records read(const std::string& text, const std::string& what, const RunOption&, Type<Records>) {
  return parse_records(text, what);
}

model::EffectChoices read(const std::string& text, const std::string& what, const RunOption&,
                          Type<model::EffectChoices>) {
  try {
    return effects::parse_effect_choices(text);
  } catch (const core::InputError& error) {
    throw core::InputError(what + " " + text + ": " + error.what());
  }
}

template <class Enum>
requires std::is_enum_v<Enum> Enum read(const std::string& text, const std::string& what, const RunOption&,
                                        Type<Enum>) {
  return stepping::read_word<Enum>(text, what, names_of(Enum{}));
}

template <class T>
std::optional<T> read(const std::string& text, const std::string& what, const RunOption& option,
                      Type<std::optional<T>>) {
  return read(text, what, option, Type<T>());
}

std::string as_text(const RunOption&, const std::string& value) { return value; }
std::string as_text(const RunOption&, const WorldRange& value) { return to_text(value); }
std::string as_text(const RunOption&, const Records& value) { return to_text(value); }
std::string as_text(const RunOption&, const model::EffectChoices& value) { return effects::to_text(value); }
std::string as_text(const RunOption& option, double value) {
  return core::quantity_text(value, *option.measure);
}
template <class Number>
requires std::is_integral_v<Number> std::string as_text(const RunOption&, Number value) {
  return stepping::written(value);
}
template <class Enum>
requires std::is_enum_v<Enum> std::string as_text(const RunOption&, Enum value) {
  return std::string(names_of(value)[static_cast<std::size_t>(value)]);
}

/// Calls visit(value) unless the option is left out.
template <class Visit>
void with_value(const RunOption& option, const RunSpec& spec, Visit visit) {
  const auto pass = [&](const auto& value) {
    if constexpr (requires { value.has_value(); }) {
      if (value) visit(*value);
    } else {
      visit(value);
    }
  };
  std::visit([&](auto member) { pass(spec.*member); }, option.member);
}

}  // namespace

const std::vector<RunOption>& run_options() {
  static const std::vector<RunOption> all = [] {
    std::vector<RunOption> rows;
    const auto add = [&](OptionGroup group, std::vector<RunOption> its_rows) {
      for (RunOption& option : its_rows) {
        option.group = group;
        rows.push_back(std::move(option));
      }
    };
    add(OptionGroup::scene, scene_rows());
    add(OptionGroup::step, step_rows());
    add(OptionGroup::cut, cut_rows());
    add(OptionGroup::output, output_rows());
    add(OptionGroup::stop, stop_rows());
    return rows;
  }();
  return all;
}

void add_run_options(OptionGroup group, po::options_description& description) {
  for (const RunOption& option : run_options()) {
    if (option.group != group) continue;
    std::string name(option.name);
    if (option.letter != 0) name += std::string(",") + option.letter;
    if (option.placeholder.empty()) {
      description.add_options()(name.c_str(), option.meaning.c_str());
      continue;
    }
    auto* value = po::value<std::string>()->value_name(std::string(option.placeholder));
    if (option.shows_default) value->default_value(*text_of(option, RunSpec{}));
    description.add_options()(name.c_str(), value, option.meaning.c_str());
  }
}

void set(const RunOption& option, const std::string& text, RunSpec& spec) {
  const auto put = [&](auto member) {
    using Member = std::remove_reference_t<decltype(spec.*member)>;
    spec.*member = read(text, "--" + std::string(option.name), option, Type<Member>());
  };
  std::visit(put, option.member);
}

void take_default(const RunOption& option, const Defaults& defaults, RunSpec& spec) {
  if (option.of_scene == nullptr) return;
  const int value = defaults.*option.of_scene;
  require_within(value, "--" + std::string(option.name), option);
  spec.*std::get<int RunSpec::*>(option.member) = value;
}

std::optional<std::string> text_of(const RunOption& option, const RunSpec& spec) {
  std::optional<std::string> text;
  with_value(option, spec, [&](const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const bool&>) {
      if (value) text = "";
    } else {
      text = as_text(option, value);
    }
  });
  return text;
}

std::optional<stepping::StepValue> value_of(const RunOption& option, const RunSpec& spec) {
  std::optional<stepping::StepValue> stored;
  with_value(option, spec, [&](const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>)
      stored = value;
    else if constexpr (std::is_integral_v<Value>)
      stored = static_cast<std::int64_t>(value);
    else
      stored = as_text(option, value);
  });
  return stored;
}

}  // namespace pbmpi::app
