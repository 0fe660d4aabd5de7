/// What happens to a run apart from its frames: for the file's /events, and for the counts of events.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pbmpi::stepping {

/// Values of RunEvent::kind, each with the meaning of RunEvent::value. The file counts each kind.
namespace event_kind {

inline constexpr const char* rebalance = "rebalance";        ///< value: worlds (or spaces) moved
inline constexpr const char* signal = "signal";              ///< the run ends early; value: its number
inline constexpr const char* time_limit = "time_limit";      ///< the run ends early
inline constexpr const char* checkpoint = "checkpoint";      ///< value: 1 if it was written, 0 if that failed
inline constexpr const char* joint_broken = "joint_broken";  ///< step, world, joint and name tell which

// A guard that tripped (stability/guards.h); step, world and name tell where.
/// value: bodies; name: the first, or with a value of 0 an observable
inline constexpr const char* nonfinite = "nonfinite";
inline constexpr const char* joint_gap = "joint_gap";      ///< value: the widest gap [m]
inline constexpr const char* energy_gain = "energy_gain";  ///< value: gained without a cause [J]
inline constexpr const char* passage = "passage";          ///< value: path beyond what was passed [m]

// What was done about it, with --on-blowup.
inline constexpr const char* frozen = "frozen";    ///< the world stands still from the start of `step` on
inline constexpr const char* refined = "refined";  ///< value: the finer steps that replaced `step`

inline constexpr std::array guards = {nonfinite, joint_gap, energy_gain, passage};
inline constexpr std::array guard_actions = {frozen, refined};
inline constexpr std::array all = {rebalance, signal,      time_limit, checkpoint, joint_broken, nonfinite,
                                   joint_gap, energy_gain, passage,    frozen,     refined};

}  // namespace event_kind

struct RunEvent {
  std::int64_t frame = 0;
  std::string kind;         ///< one of event_kind
  std::string detail;       ///< one line for people
  std::int64_t step = -1;   ///< step in which it happened, counted from 0; -1: at the end of the frame
  std::int32_t world = -1;  ///< -1: of no world
  std::int32_t joint = -1;  ///< index in the world's model; -1: of no joint
  std::string name = {};    ///< of the joint or body
  double value = 0;         ///< see event_kind
};

/// Knows of events that only the owner of a world sees.
class RunEventSource {
 public:
  virtual ~RunEventSource() = default;
  /// Events since the last call; their frame is for the caller to fill in.
  virtual std::vector<RunEvent> take_events() = 0;
};

}  // namespace pbmpi::stepping
