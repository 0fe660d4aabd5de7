#include "core/marks.h"

#if PBMPI_HAS_CALLGRIND
#include <valgrind/valgrind.h>
#endif

namespace pbmpi::core {
namespace {

/// Without Valgrind's header nothing can listen.
void tell([[maybe_unused]] int request, [[maybe_unused]] int what) {
#if PBMPI_HAS_CALLGRIND
  VALGRIND_DO_CLIENT_REQUEST_STMT(request, what, 0, 0, 0, 0);
#endif
}

}  // namespace

SectionMark::SectionMark(Section section) { tell(pbvalue_request_section, static_cast<int>(section)); }
SectionMark::~SectionMark() { tell(pbvalue_request_section, pbvalue_no_section); }
PhaseMark::PhaseMark(MarkedPhase phase) { tell(pbvalue_request_phase, static_cast<int>(phase)); }
PhaseMark::~PhaseMark() { tell(pbvalue_request_phase, pbvalue_no_phase); }

}  // namespace pbmpi::core
