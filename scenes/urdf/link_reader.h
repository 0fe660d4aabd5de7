/// Reads URDF's `<link>` elements one by one.
#pragma once

#include "scenes/links/links.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::urdf {

/// Reads mass and geoms; the caller adds the joints to other links.
links::Link read_link(const xml::Element& element, const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::urdf
