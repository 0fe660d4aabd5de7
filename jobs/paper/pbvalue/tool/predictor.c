#include "jobs/paper/pbvalue/tool/predictor.h"

#include <pub_tool_hashtable.h>
#include <pub_tool_libcassert.h>
#include <pub_tool_libcbase.h>
#include <pub_tool_mallocfree.h>
#include "jobs/paper/pbvalue/tool/options.h"

typedef struct {
  Value value;
  ULong tag;
  ULong stamp;  ///< of the last use (lru), or of the insertion (fifo)
  UChar confidence;
  Bool valid;
} Entry;

typedef struct {
  VgHashNode node;  ///< its key is the site's
  Site site;
} SiteNode;

const HChar* const class_names[num_classes] = {"fp_load", "fp_operation", "int_load", "int_operation"};
ClassCounts class_counts[num_classes];

static Entry* table;
static UInt num_entries, num_ways, num_sites;
static ULong now;
static UInt random_state = 2463534242u;
static VgHashTable* sites;

void reset_error_max(void) {
  for (Int i = 0; i < num_classes; ++i) class_counts[i].error_max = 0;
}

static void grow_table(UInt wanted) {
  Entry* grown = VG_(calloc)("pbvalue.table", wanted, sizeof(Entry));
  if (table != NULL) {
    VG_(memcpy)(grown, table, num_entries * sizeof(Entry));
    VG_(free)(table);
  }
  table = grown;
  num_entries = wanted;
}

void make_table(void) {
  sites = VG_(HT_construct)("pbvalue.sites");
  num_ways = options.table_entries == 0 ? 1 : (UInt)options.table_ways;
  grow_table(options.table_entries == 0 ? 1u << 16 : (UInt)options.table_entries);
}

/// Addresses are dense in their low bits, and statements use few of theirs: Fibonacci hashing spreads both.
static ULong spread(ULong key) { return key * 0x9E3779B97F4A7C15ull; }

/// The set comes from the upper half of a hash of the key, a partial tag from the top bits of a second hash.
static void place_in_table(Site* site) {
  if (options.table_entries == 0) {
    if (num_sites == num_entries) grow_table(2 * num_entries);
    site->first_entry = num_sites;
    site->tag = site->key;
    return;
  }
  const UInt num_sets = num_entries / num_ways;
  site->first_entry = (UInt)((spread(site->key) >> 32) & (num_sets - 1)) * num_ways;
  const ULong hash = spread(site->key ^ 0x5bd1e995u);
  site->tag = options.tag_bits == 64  ? site->key
              : options.tag_bits == 0 ? 0
                                      : hash >> (64 - options.tag_bits);
}

Site* find_site(Addr address, UInt id, ValueClass value_class, ValueType type) {
  const ULong key = (ULong)address << 4 | id;
  SiteNode* node = VG_(HT_lookup)(sites, key);
  if (node == NULL) {
    node = VG_(calloc)("pbvalue.site", 1, sizeof *node);
    node->node.key = key;
    node->site.key = key;
    place_in_table(&node->site);
    ++num_sites;
    VG_(HT_add_node)(sites, node);
  }
  node->site.value_class = (UChar)value_class;  // code that was unloaded may have been replaced by other code
  node->site.type = type;
  return &node->site;
}

static Entry* look_up(const Site* site) {
  Entry* set = &table[site->first_entry];
  for (UInt way = 0; way < num_ways; ++way) {
    if (set[way].valid && set[way].tag == site->tag) return &set[way];
  }
  return NULL;
}

static UInt next_random(void) {  // Marsaglia's xorshift
  random_state ^= random_state << 13;
  random_state ^= random_state >> 17;
  random_state ^= random_state << 5;
  return random_state;
}

static Entry* victim(const Site* site) {
  Entry* set = &table[site->first_entry];
  Entry* oldest = set;
  for (UInt way = 0; way < num_ways; ++way) {
    if (!set[way].valid) return &set[way];
    if (set[way].stamp < oldest->stamp) oldest = &set[way];
  }
  return options.replacement == replace_random ? &set[next_random() % num_ways] : oldest;
}

static void allocate(const Site* site, const Value* value) {
  Entry* entry = victim(site);
  entry->value = *value;
  entry->tag = site->tag;
  entry->stamp = now;
  entry->confidence = 0;
  entry->valid = True;
}

static void train(Entry* entry, Bool right, const Value* value) {
  const Int up = entry->confidence + options.confidence_up,
            down = entry->confidence - options.confidence_down;
  if (right) {
    entry->confidence = (UChar)(up > options.confidence_max ? options.confidence_max : up);
  } else {
    entry->confidence = (UChar)(down < 0 ? 0 : down);
  }
  entry->value = *value;
  if (options.replacement == replace_lru) entry->stamp = now;
}

Outcome predict(Site* site, Value* value) {
  ClassCounts* counts = &class_counts[site->value_class];
  ++now;
  ++counts->executed;
  Entry* entry = look_up(site);
  if (entry == NULL) {
    allocate(site, value);
    return not_predicted;
  }
  Double error = 0;
  static const Verification exactly = {.exact = True};
  const Verification* verification =
      site->value_class <= class_fp_operation ? &options.verification : &exactly;
  const Likeness likeness = compare_values(site->type, &entry->value, value, verification, &error);
  const Bool is_used = entry->confidence >= options.confidence_use;
  const Value predicted = entry->value;
  train(entry, likeness != values_differ, value);
  if (likeness == values_equal) ++counts->repeated;
  if (!is_used) return not_predicted;
  if (likeness == values_differ) {
    ++counts->wrong;
    return predicted_wrong;
  }
  if (likeness == values_near) {
    ++counts->fuzzy;
    counts->error_sum += error;
    if (error > counts->error_max) counts->error_max = error;
    *value = predicted;
  } else {
    ++counts->exact;
  }
  return predicted_right;
}
