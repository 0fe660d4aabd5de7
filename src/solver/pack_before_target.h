/// To be included before the instruction set is switched on: what the lanes' templates use of the standard
/// library and of our own plain code, so that none of it is compiled for an instruction set that another
/// machine may lack.
#pragma once

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
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
#include "model/breakage.h"
#include "model/geometry.h"
#include "model/state.h"
#include "solver/active_bodies.h"
#include "solver/articulation.h"
#include "solver/awake_geoms.h"
#include "solver/broad_phase.h"
#include "solver/broken_joints.h"
#include "solver/joint_load.h"
#include "solver/lane_places.h"
#include "solver/manifold_order.h"
#include "solver/may_touch_table.h"
#include "solver/pack.h"
#include "solver/pack_instances.h"
#include "solver/pair_table.h"
#include "solver/passes.h"
#include "solver/slot_list.h"
