// A Valgrind tool: measures last-value prediction, exact and fuzzy, on a program, and the cycles that the
// processor of the paper's Table 3 would take with and without it.
#include <pub_tool_basics.h>
#include <pub_tool_libcassert.h>
#include <pub_tool_libcbase.h>
#include <pub_tool_libcproc.h>
#include <pub_tool_options.h>
#include <pub_tool_tooliface.h>
#include "core/mark_codes.h"
#include "jobs/paper/pbvalue/tool/instrument.h"
#include "jobs/paper/pbvalue/tool/options.h"
#include "jobs/paper/pbvalue/tool/predictor.h"
#include "jobs/paper/pbvalue/tool/run_time.h"

static Bool take_request(ThreadId tid, UWord* request, UWord* answer) {
  (void)tid;
  *answer = 0;
  switch (request[0]) {
    case pbvalue_request_section:
      enter_section(request[1]);
      return True;
    case pbvalue_request_phase:
      enter_phase(request[1]);
      return True;
    default:
      return False;
  }
}

/// The kernel gives each process 16 random bytes (AT_RANDOM, getauxval(3)), from which the C library makes
/// the stack protector's canary. Canaries stay behind on the stack, and code that reads unset stack memory
/// takes them for numbers: in half of all processes for one so small that it is near zero. With fixed bytes,
/// predictions are the same in each process. As a number 0x50... is far from all computed values.
static void fix_random_bytes(void) {
  enum { type_end = 0, type_random = 25, num_bytes = 16 };
  HChar** variable = VG_(client_envp);
  while (*variable != NULL) ++variable;
  const UWord* entry = (const UWord*)(variable + 1);  // the auxiliary vector follows the environment
  while (entry[0] != type_end && entry[0] != type_random) entry += 2;
  if (entry[0] == type_random) VG_(memset)((void*)entry[1], 0x50, num_bytes);
}

static void begin(void) {
  check_options();
  fix_random_bytes();
  make_table();
  begin_program();
}

static void finish(Int exit_code) {
  (void)exit_code;
  write_report();
}

static void print_debug_usage(void) {}

/// Keeps micro-operations those of the machine code: unrolls no loop, follows no jump, and takes no
/// expression of one instruction from another.
static void keep_close_to_machine_code(void) {
  VG_(clo_vex_control).iropt_level = 1;
  VG_(clo_vex_control).iropt_unroll_thresh = 0;
  VG_(clo_vex_control).guest_chase = False;
}

static void register_tool(void) {
  VG_(details_name)("pbvalue");
  VG_(details_version)("1");
  VG_(details_description)("last-value prediction, exact and fuzzy");
  VG_(details_copyright_author)
  ("Part of pbmpi; with Valgrind's core, under the GNU GPL, version 2 or later.");
  VG_(details_bug_reports_to)("pbmpi's maintainers");
  VG_(details_avg_translation_sizeB)(600);
  VG_(basic_tool_funcs)(begin, instrument, finish);
  VG_(needs_command_line_options)(process_option, print_usage, print_debug_usage);
  VG_(needs_client_requests)(take_request);
  keep_close_to_machine_code();
}

VG_DETERMINE_INTERFACE_VERSION(register_tool)
