/// To be included before the instruction set is switched on: what the lanes' templates use of the standard
/// library and of our own plain code, so that none of it is compiled for an instruction set that another
/// machine may lack.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/random.h"
#include "model/geometry.h"
#include "model/state.h"
#include "solver/articulation.h"
#include "solver/contact_colors.h"
#include "solver/pack.h"
#include "solver/pack_instances.h"
