#include "jobs/paper/pbvalue/tool/options.h"

#include <pub_tool_libcassert.h>
#include <pub_tool_libcbase.h>
#include <pub_tool_libcprint.h>
#include <pub_tool_libcproc.h>
#include <pub_tool_options.h>
#include "core/mark_codes.h"
#include "jobs/paper/pbvalue/timing/core_model.h"

Options options = {.out_file = NULL,
                   .verification = {.exact = True},
                   .predict = predict_fp,
                   .scope = scope_all,
                   .table_entries = 4096,
                   .table_ways = 4,
                   .tag_bits = 64,
                   .replacement = replace_lru,
                   .confidence_max = 3,
                   .confidence_use = 2,
                   .confidence_up = 1,
                   .confidence_down = 1,
                   .first_modelled = 0,
                   .modelled = 1 << pbvalue_precise | 1 << pbvalue_estimate};

Bool parse_real(const HChar* text, Double* value) {
  HChar* rest = NULL;
  *value = VG_(strtod)(text, &rest);
  if (rest == text) return False;
  if (*rest == 'e') {
    HChar* end = NULL;
    const Long exponent = VG_(strtoll10)(rest + 1, &end);
    if (end == rest + 1 || exponent < -300 || exponent > 300) return False;
    Double power =
        1;  // of ten: exact up to 22, and a threshold is given with fewer digits than is lost beyond
    for (Long i = 0; i < (exponent < 0 ? -exponent : exponent); ++i) power *= 10;
    *value = exponent < 0 ? *value / power : *value * power;
    rest = end;
  }
  return *rest == '\0';
}

static void take_threshold(const HChar* text) {
  if (!parse_real(text, &options.verification.threshold) || !(options.verification.threshold >= 0))
    VG_(fmsg_bad_option)("--threshold", "'%s' is no number from 0 on, such as 1e-6\n", text);
  options.verification.exact = False;
}

Bool process_option(const HChar* argument) {
  const HChar* text = NULL;
  if (VG_STR_CLO(argument, "--threshold", text)) {
    take_threshold(text);
  } else if (VG_STR_CLO(argument, "--model", text)) {
    add_model(text);
  } else if (VG_STR_CLO(argument, "--pbvalue-out-file", options.out_file) ||
             VG_XACT_CLO(argument, "--threshold-kind=absolute", options.verification.relative, False) ||
             VG_XACT_CLO(argument, "--threshold-kind=relative", options.verification.relative, True) ||
             VG_XACT_CLO(argument, "--predict=fp", options.predict, predict_fp) ||
             VG_XACT_CLO(argument, "--predict=int", options.predict, predict_int) ||
             VG_XACT_CLO(argument, "--predict=all", options.predict, predict_fp | predict_int) ||
             VG_XACT_CLO(argument, "--predict=none", options.predict, 0) ||
             VG_XACT_CLO(argument, "--scope=collision", options.scope, scope_collision) ||
             VG_XACT_CLO(argument, "--scope=step", options.scope, scope_step) ||
             VG_XACT_CLO(argument, "--scope=all", options.scope, scope_all) ||
             VG_XACT_CLO(argument, "--scope=frame", options.scope, scope_frame) ||
             VG_XACT_CLO(argument, "--scope=program", options.scope, scope_program) ||
             VG_XACT_CLO(argument, "--replacement=lru", options.replacement, replace_lru) ||
             VG_XACT_CLO(argument, "--replacement=fifo", options.replacement, replace_fifo) ||
             VG_XACT_CLO(argument, "--replacement=random", options.replacement, replace_random) ||
             VG_XACT_CLO(argument, "--modelled=precise", options.modelled, 1u << pbvalue_precise) ||
             VG_XACT_CLO(argument, "--modelled=estimate", options.modelled, 1u << pbvalue_estimate) ||
             VG_XACT_CLO(argument, "--modelled=all", options.modelled,
                         1u << pbvalue_precise | 1u << pbvalue_estimate) ||
             VG_BINT_CLO(argument, "--table-entries", options.table_entries, 0, 1 << 24) ||
             VG_BINT_CLO(argument, "--table-ways", options.table_ways, 1, 64) ||
             VG_BINT_CLO(argument, "--tag-bits", options.tag_bits, 0, 64) ||
             VG_BINT_CLO(argument, "--confidence-max", options.confidence_max, 0, 255) ||
             VG_BINT_CLO(argument, "--confidence-use", options.confidence_use, 0, 255) ||
             VG_BINT_CLO(argument, "--confidence-up", options.confidence_up, 0, 255) ||
             VG_BINT_CLO(argument, "--confidence-down", options.confidence_down, 0, 255) ||
             VG_BINT_CLO(argument, "--first-modelled", options.first_modelled, 0, 1 << 30)) {
  } else {
    return False;
  }
  return True;
}

/// Valgrind's own message no longer ends the program once it is about to start.
static void refuse(const HChar* option, const HChar* why) {
  VG_(fmsg_bad_option)(option, "%s\n", why);
  VG_(exit)(1);
}

static Bool is_power_of_two(Int number) { return (number & (number - 1)) == 0; }

void check_options(void) {
  const Int entries = options.table_entries, ways = options.table_ways;
  if (!is_power_of_two(entries)) refuse("--table-entries", "it is no power of two");
  if (!is_power_of_two(ways) || (entries != 0 && ways > entries))
    refuse("--table-ways", "it is no power of two, or above --table-entries");
  if (options.confidence_use > options.confidence_max)
    refuse("--confidence-use", "no entry can reach it: it is above --confidence-max");
}

void print_usage(void) {
  VG_(printf)
  ("    --pbvalue-out-file=FILE         JSON: counts, predictions and cycles of each marked section\n"
   "    --threshold=X                   a prediction within X of the computed value is right, and goes on\n"
   "                                    into the program; 0: exact verification [0]\n"
   "    --threshold-kind=absolute|relative  [absolute]\n"
   "    --predict=fp|int|all|none       results of floating-point arithmetic and loads; integer ones "
   "(always\n"
   "                                    verified exactly); both [fp]\n"
   "    --scope=collision|step|all|frame|program  where values are predicted: in the marked phase of\n"
   "                                    collision or of the forward step, in both, in all of a marked\n"
   "                                    section, everywhere (the program is then one section) [all]\n"
   "    --table-entries=N --table-ways=N    last values; 0 entries: one for each micro-operation [4096, 4]\n"
   "    --tag-bits=N                    64: the whole address and micro-operation, 0: no tags [64]\n"
   "    --replacement=lru|fifo|random   [lru]\n"
   "    --confidence-max=N --confidence-use=N --confidence-up=N --confidence-down=N  a counter an entry: "
   "its\n"
   "                                    ceiling, from where on it is used, steps after right and wrong ones\n"
   "                                    [3, 2, 1, 1]\n"
   "    --modelled=precise|estimate|all  the sections that they see [all]\n"
   "    --first-modelled=N              the first section that the cycle models see, of each kind [0]\n");
  print_model_usage();
}
