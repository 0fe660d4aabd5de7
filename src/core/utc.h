/// The date and time of day.
#pragma once

#include <string>

namespace pbmpi::core {

/// Now, in UTC, to the second: ISO 8601, as "2006-07-30T12:00:00Z".
std::string utc_now();

}  // namespace pbmpi::core
