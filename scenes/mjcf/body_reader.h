/// MJCF's `<worldbody>`: the tree of bodies.
#pragma once

#include "scenes/mjcf/places.h"

namespace pbmpi::scenes::mjcf {

/// Reads the bodies below all `<worldbody>` of the main part as links, parents before children; the geoms of
/// the world itself are a link without joints. `<frame>`, `<replicate>` and `<attach>` are written out, which
/// adds parts to `attachments`. Throws core::InputError.
Places read_bodies(Attachments& attachments, links::Mechanism& mechanism);

/// Most bodies, geoms, joints and copies that one model may have.
inline constexpr int most_elements = 1'000'000;

}  // namespace pbmpi::scenes::mjcf
