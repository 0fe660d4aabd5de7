/// Tells the Valgrind tool pbvalue (jobs/paper/pbvalue/tool) what the program is doing. Without Valgrind a
/// mark is a handful of instructions that change nothing.
#pragma once

#include "core/mark_codes.h"

namespace pbmpi::core {

/// Marks, until the end of the block, that the program takes the step of a frame, or makes its estimate. Not
/// nested.
class SectionMark {
 public:
  enum class Section { precise = pbvalue_precise, estimate = pbvalue_estimate };
  explicit SectionMark(Section section);
  ~SectionMark();
  SectionMark(const SectionMark&) = delete;
  SectionMark& operator=(const SectionMark&) = delete;
};

/// Marks, until the end of the block, a part of a step. Not nested. The tool knows one thread only: under it
/// steppers have no others.
class PhaseMark {
 public:
  enum class MarkedPhase { collision = pbvalue_collision, forward_step = pbvalue_forward };
  explicit PhaseMark(MarkedPhase phase);
  ~PhaseMark();
  PhaseMark(const PhaseMark&) = delete;
  PhaseMark& operator=(const PhaseMark&) = delete;
};

}  // namespace pbmpi::core
