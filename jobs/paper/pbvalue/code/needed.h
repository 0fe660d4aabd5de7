/// Finds the values of a block that are used for more than the address of an access.
#pragma once

#include <pub_tool_basics.h>
#include <pub_tool_tooliface.h>

/// [temporaries] of the block; allocated. Arithmetic whose result is only an address is part of the access.
Bool* find_needed(const IRSB* block);
