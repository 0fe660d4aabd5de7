/// Inserts the calls of run_time.h into the code of the program.
#pragma once

#include <pub_tool_basics.h>
#include <pub_tool_tooliface.h>

IRSB* instrument(VgCallbackClosure* closure, IRSB* in, const VexGuestLayout* layout,
                 const VexGuestExtents* extents, const VexArchInfo* host, IRType guest_word,
                 IRType host_word);
