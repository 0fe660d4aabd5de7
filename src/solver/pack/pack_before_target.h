/// To be included before the instruction set is switched on: the parts of the standard library and of our own
/// plain code that the lanes' templates use, so that none of it is compiled for an instruction set that
/// another machine may lack.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/random.h"
#include "effects/breakage.h"
#include "geometry/geometry.h"
#include "geometry/principal_axes.h"
#include "geometry/seams.h"
#include "model/islands.h"
#include "model/joint_traits.h"
#include "model/shape_traits.h"
#include "model/state.h"
#include "model/step_memory.h"
#include "solver/collide/awake_geoms.h"
#include "solver/collide/broad_phase.h"
#include "solver/collide/may_touch_table.h"
#include "solver/collide/pair_table.h"
#include "solver/contacts/contact_colors.h"
#include "solver/contacts/manifold_order.h"
#include "solver/contacts/renewed_contacts.h"
#include "solver/contacts/sweep_order.h"
#include "solver/joints/articulation_tree.h"
#include "solver/joints/broken_joints.h"
#include "solver/layout/active_bodies.h"
#include "solver/layout/articulation.h"
#include "solver/layout/cells.h"
#include "solver/layout/joints_of_bodies.h"
#include "solver/layout/lane_places.h"
#include "solver/layout/pack_laws.h"
#include "solver/layout/passes.h"
#include "solver/layout/slot_list.h"
#include "solver/newton/row_system.h"
#include "solver/pack/pack.h"
#include "solver/pack/pack_instances.h"
