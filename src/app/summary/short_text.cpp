#include <fmt/core.h>

#include "app/summary/run_summary.h"

namespace pbmpi::app {
namespace {

enum class Tone { good, middling, bad };

/// The words in the tone's colour (ANSI), or as they are.
std::string toned(const std::string& words, Tone tone, bool in_colour) {
  if (!in_colour) return words;
  const int colour = tone == Tone::good ? 32 : tone == Tone::middling ? 33 : 31;
  return fmt::format("\033[{}m{}\033[0m", colour, words);
}

std::string counted(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string work(const RunSummary& s) {
  return fmt::format("scene: {}, {} with {} on {}; {} {} x {} {}, dt {:g} s; {} after {} of warm-up\n",
                     s.scene, counted(s.worlds, "world", "worlds"), counted(s.bodies, "body", "bodies"),
                     counted(s.ranks, "rank", "ranks"), s.stepper, s.substeps, s.iterations, s.precision,
                     s.dt_s, counted(s.measured_frames, "frame", "frames"), s.warmup_frames);
}

std::string speed(const RunSummary& s, bool in_colour) {
  const Tone tone = s.satisfied_fraction >= 1  ? Tone::good
                    : s.satisfied_fraction > 0 ? Tone::middling
                                               : Tone::bad;
  const std::string share =
      fmt::format("{:.0f} % of the frames within {:.3g} ms", 100 * s.satisfied_fraction, 1e3 * s.budget_s);
  return fmt::format("speed: {}; half take {:.3g} ms, the longest {:.3g} ms\n", toned(share, tone, in_colour),
                     1e3 * s.frame_p50_s, 1e3 * s.frame_max_s);
}

std::string accuracy(const RunSummary& s) {
  std::string text = fmt::format("accuracy: joints gape by {:.3g} mm, contacts are {:.3g} mm deep at most; ",
                                 1e3 * s.max_joint_gap_m, 1e3 * s.max_penetration_m);
  if (s.estimate) {
    text += fmt::format("estimates {:.3g} mm from precise (rms), {:.0f} % in time; ",
                        1e3 * s.estimate->position_defect.rms, 100 * s.estimate->satisfied_fraction);
  }
  return text + "error by nature: pbstudy accuracy\n";
}

std::string failures(const RunSummary& s, bool in_colour) {
  std::string found;
  const auto add = [&](const std::string& words) { found += (found.empty() ? "" : "; ") + words; };
  if (s.worlds_survived < s.worlds)
    add(fmt::format("{} of {} worlds did not survive", s.worlds - s.worlds_survived, s.worlds));
  if (s.nonfinite_bodies > 0) add(counted(s.nonfinite_bodies, "body is", "bodies are") + " not finite");
  if (!s.guards.counts.empty()) {
    std::string counts;
    for (const auto& [kind, count] : s.guards.counts)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, kind);
    add(counts + (s.guards.first.empty() ? "" : ", first: " + s.guards.first));
  }
  if (!s.complete) add("stopped before the last frame");
  return "failed: " +
         (found.empty() ? toned("nothing", Tone::good, in_colour) : toned(found, Tone::bad, in_colour)) +
         "\n";
}

}  // namespace

std::string to_short_text(const RunSummary& s, bool in_colour) {
  std::string text = work(s) + speed(s, in_colour) + accuracy(s) + failures(s, in_colour);
  text += "state_hash: " + s.state_hash + "\n";
  if (s.joints_broken > 0) text += fmt::format("joints_broken: {}\n", s.joints_broken);
  if (!s.effects_chosen.empty()) text += "effects_chosen: " + s.effects_chosen + "\n";
  if (!s.checkpoint.empty()) text += "checkpoint: " + s.checkpoint + "\n";
  const bool has_file = !s.output.empty();
  return text + "output: " + (has_file ? s.output : "none") +
         "; all numbers: " + (has_file ? "pbreport " + s.output + ", or " : "") + "--report full\n";
}

}  // namespace pbmpi::app
