/// Group /world_results of a run's file: the outcome of each world over the frames of the file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace pbmpi::io {

struct WorldResult {
  std::int64_t survived = 1;  ///< 0: it had a non-finite body, or a guard has frozen it
  std::int64_t nonfinite_step =
      -1;                        ///< steps done at the end of the first frame that was not finite; -1: none
  std::int64_t frozen_in = -1;   ///< first step in which it stands frozen; -1: none
  std::int64_t frames = 0;       ///< of the file
  double energy_first_j = 0;     ///< after the first of these frames
  double energy_last_j = 0;      ///< after the last of these frames
  double joint_gap_max_m = 0;    ///< largest finite value at the ends of frames
  double penetration_max_m = 0;  ///< largest finite value at the ends of frames
  double contacts_mean = 0;      ///< mean over the ends of frames
  double row_visits = 0;         ///< sum over the ends of frames
  double cost_s = 0;             ///< time that ranks spent on it
  std::int64_t moves = 0;        ///< from rank to rank
  std::string state_hash;        ///< model::hash() of its last state, 16 digits
};

struct ResultColumn {
  std::string_view name, unit;
  std::variant<std::int64_t WorldResult::*, double WorldResult::*, std::string WorldResult::*> member;
};

inline constexpr auto world_result_columns = std::to_array<ResultColumn>({
    {"survived", "", &WorldResult::survived},
    {"nonfinite_step", "", &WorldResult::nonfinite_step},
    {"frozen_in", "", &WorldResult::frozen_in},
    {"frames", "", &WorldResult::frames},
    {"energy_first", "J", &WorldResult::energy_first_j},
    {"energy_last", "J", &WorldResult::energy_last_j},
    {"joint_gap_max", "m", &WorldResult::joint_gap_max_m},
    {"penetration_max", "m", &WorldResult::penetration_max_m},
    {"contacts_mean", "", &WorldResult::contacts_mean},
    {"row_visits", "", &WorldResult::row_visits},
    {"cost", "s", &WorldResult::cost_s},
    {"moves", "", &WorldResult::moves},
    {"state_hash", "", &WorldResult::state_hash},
});

/// Bytes of one world's row.
std::int64_t bytes_of_a_world_result();

}  // namespace pbmpi::io
