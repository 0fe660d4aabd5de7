#include "jobs/paper/pbvalue/tool/report.h"

#include <pub_tool_libcbase.h>
#include <pub_tool_libcprint.h>
#include <pub_tool_vki.h>
#include "jobs/paper/pbvalue/tool/options.h"

static VgFile* out;

/// Valgrind prints no numbers with a point: 15 digits and a power of ten, computed by repeated
/// multiplication, of which about 14 digits are right.
static void write_real(Double x) {
  Int exponent = 0;
  if (x == 0) {
    VG_(fprintf)(out, "0");
    return;
  }
  while (x >= 10) {
    x /= 10;
    ++exponent;
  }
  while (x < 1) {
    x *= 10;
    --exponent;
  }
  ULong digits = (ULong)(x * 1e14 + 0.5);
  if (digits >= 1000000000000000ull) {
    digits /= 10;
    ++exponent;
  }
  VG_(fprintf)(out, "%llu.%014llue%d", digits / 100000000000000ull, digits % 100000000000000ull, exponent);
}

static void write_text(const HChar* text) {
  VG_(fprintf)(out, "\"");
  for (; *text != '\0'; ++text) {
    if (*text == '"' || *text == '\\') VG_(fprintf)(out, "\\");
    VG_(fprintf)(out, "%c", *text);
  }
  VG_(fprintf)(out, "\"");
}

static void write_options(void) {
  static const HChar* const scopes[] = {"collision", "step", "all", "frame", "program"};
  static const HChar* const replacements[] = {"lru", "fifo", "random"};
  static const HChar* const predicted[] = {"none", "fp", "int", "all"};
  VG_(fprintf)
  (out, " \"options\": {\"verify\": \"%s\", \"threshold\": ", options.verification.exact ? "exact" : "fuzzy");
  write_real(options.verification.threshold);
  VG_(fprintf)
  (out,
   ", \"threshold_kind\": \"%s\", \"predict\": \"%s\", \"scope\": \"%s\", \"table_entries\": %d, "
   "\"table_ways\": %d, \"tag_bits\": %d, \"replacement\": \"%s\", \"confidence_max\": %d, "
   "\"confidence_use\": %d, \"confidence_up\": %d, \"confidence_down\": %d, \"first_modelled\": %d},\n",
   options.verification.relative ? "relative" : "absolute", predicted[options.predict], scopes[options.scope],
   options.table_entries, options.table_ways, options.tag_bits, replacements[options.replacement],
   options.confidence_max, options.confidence_use, options.confidence_up, options.confidence_down,
   options.first_modelled);
  VG_(fprintf)(out, " \"models\": [");
  for (Int i = 0; i < num_models(); ++i) {
    VG_(fprintf)(out, "%s{\"name\": ", i == 0 ? "" : ", ");
    write_text(model_name(i));
    VG_(fprintf)(out, ", \"settings\": ");
    write_text(model_text(i));
    VG_(fprintf)(out, "}");
  }
  VG_(fprintf)(out, "],\n");
}

static void write_classes(const ClassCounts* begin, const ClassCounts* end) {
  VG_(fprintf)(out, "   \"classes\": {");
  for (Int i = 0; i < num_classes; ++i) {
    VG_(fprintf)
    (out,
     "%s\n    \"%s\": {\"executed\": %llu, \"repeated\": %llu, \"exact\": %llu, \"fuzzy\": %llu, "
     "\"wrong\": %llu, \"error_sum\": ",
     i == 0 ? "" : ",", class_names[i], end[i].executed - begin[i].executed,
     end[i].repeated - begin[i].repeated, end[i].exact - begin[i].exact, end[i].fuzzy - begin[i].fuzzy,
     end[i].wrong - begin[i].wrong);
    const Double sum = end[i].error_sum - begin[i].error_sum;
    write_real(sum > 0 ? sum : 0);
    VG_(fprintf)(out, ", \"error_max\": ");
    write_real(end[i].error_max);
    VG_(fprintf)(out, "}");
  }
  VG_(fprintf)(out, "},\n");
}

static void write_levels(const HChar* name, const ULong* begin, const ULong* end) {
  VG_(fprintf)(out, "\"%s\": {", name);
  for (Int i = 0; i < num_levels; ++i)
    VG_(fprintf)(out, "%s\"%s\": %llu", i == 0 ? "" : ", ", level_names[i], end[i] - begin[i]);
  VG_(fprintf)(out, "}, ");
}

static void write_models(const Counts* begin, const Counts* end) {
  const MemoryCounts *from = &begin->memory, *to = &end->memory;
  VG_(fprintf)(out, "   \"micro_ops\": %llu, ", end->micro_ops - begin->micro_ops);
  write_levels("data_accesses", from->data, to->data);
  write_levels("fetches", from->fetch, to->fetch);
  VG_(fprintf)
  (out,
   "\"branches\": %llu, \"branches_wrong\": %llu, \"targets_wrong\": %llu, \"indirect_wrong\": %llu,\n   "
   "\"cycles\": {",
   to->branches - from->branches, to->branches_wrong - from->branches_wrong,
   to->targets_wrong - from->targets_wrong, to->indirect_wrong - from->indirect_wrong);
  for (Int i = 0; i < num_models(); ++i) {
    VG_(fprintf)(out, "%s", i == 0 ? "" : ", ");
    write_text(model_name(i));
    VG_(fprintf)(out, ": %llu", end->cycles[i] - begin->cycles[i]);
  }
  VG_(fprintf)(out, "},\n");
}

static void write_record(const Record* record) {
  static const HChar* const sections[] = {"none", "precise", "estimate"};
  const Counts *begin = &record->at_begin, *end = &record->at_end;
  ULong instructions[3], all = 0;
  for (Int i = 0; i < 3; ++i) all += instructions[i] = end->instructions[i] - begin->instructions[i];
  VG_(fprintf)
  (out, "  {\"section\": \"%s\", \"modelled\": %s, \"instructions\": %llu, ", sections[record->section],
   record->modelled ? "true" : "false", all);
  VG_(fprintf)
  (out, "\"collision_instructions\": %llu, \"forward_instructions\": %llu,\n   \"mix\": {", instructions[1],
   instructions[2]);
  for (Int i = 0; i < num_mix_classes; ++i)
    VG_(fprintf)(out, "%s\"%s\": %llu", i == 0 ? "" : ", ", mix_names[i], end->mix[i] - begin->mix[i]);
  VG_(fprintf)(out, "},\n");
  if (record->modelled) write_models(begin, end);
  write_classes(begin->classes, end->classes);
  VG_(fprintf)(out, "   \"complete\": %s}", record->is_closed ? "true" : "false");
}

void report(XArray* records) {
  if (options.out_file == NULL) return;
  out = VG_(fopen)(options.out_file, VKI_O_CREAT | VKI_O_WRONLY | VKI_O_TRUNC,
                   VKI_S_IRUSR | VKI_S_IWUSR | VKI_S_IRGRP | VKI_S_IROTH);
  if (out == NULL) {
    VG_(umsg)("pbvalue: %s cannot be written\n", options.out_file);
    return;
  }
  VG_(fprintf)(out, "{\"tool\": \"pbvalue\", \"version\": 1,\n");
  write_options();
  VG_(fprintf)(out, " \"sections\": [\n");
  const Word num_records = records == NULL ? 0 : VG_(sizeXA)(records);
  for (Word i = 0; i < num_records; ++i) {
    write_record(VG_(indexXA)(records, i));
    VG_(fprintf)(out, i + 1 < num_records ? ",\n" : "\n");
  }
  VG_(fprintf)(out, " ]}\n");
  VG_(fclose)(out);
}
