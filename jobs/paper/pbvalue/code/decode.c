// Opcode maps: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, appendix A. The rule
// for the classes is that of jobs/figure3.py, which reads objdump's text instead.
#include "jobs/paper/pbvalue/code/decode.h"

const HChar* const mix_names[num_mix_classes] = {"floating_point", "integer", "branch", "store", "load"};

enum {
  fp = 1 << mix_floating_point,
  integer = 1 << mix_integer,
  branch = 1 << mix_branch,
  store = 1 << mix_store,
  load = 1 << mix_load
};

typedef struct {
  UChar map;  ///< 0: one-byte opcodes, 1: 0F, 2: 0F 38, 3: 0F 3A
  UChar opcode;
  UChar prefix;  ///< the mandatory one: 0, 0x66, 0xF3 or 0xF2
  Bool wide;     ///< REX.W or VEX.W
  Bool is_vex;
  Bool in_memory;  ///< is the ModRM operand in memory? only where the opcode has one
  UChar reg;       ///< the middle field of ModRM
} Parts;

static UChar vex_prefix(UChar pp) {
  static const UChar of[4] = {0, 0x66, 0xF3, 0xF2};
  return of[pp & 3];
}

static Bool is_legacy_prefix(UChar b) {
  return b == 0x66 || b == 0xF2 || b == 0xF3 || b == 0xF0 || b == 0x67 || b == 0x2E || b == 0x36 ||
         b == 0x3E || b == 0x26 || b == 0x64 || b == 0x65;
}

static Parts take_apart(const UChar* bytes, UInt length) {
  Parts parts = {0};
  UInt at = 0;
  for (; at < length && is_legacy_prefix(bytes[at]); ++at) {
    if (bytes[at] == 0xF2 || bytes[at] == 0xF3) parts.prefix = bytes[at];
    if (bytes[at] == 0x66 && parts.prefix == 0) parts.prefix = 0x66;
  }
  if (at < length && (bytes[at] & 0xF0) == 0x40) parts.wide = (bytes[at++] & 8) != 0;
  if (at + 2 < length && bytes[at] == 0xC5) {
    parts.is_vex = True;
    parts.map = 1;
    parts.prefix = vex_prefix(bytes[at + 1]);
    at += 2;
  } else if (at + 3 < length && bytes[at] == 0xC4) {
    parts.is_vex = True;
    parts.map = bytes[at + 1] & 3;
    parts.prefix = vex_prefix(bytes[at + 2]);
    parts.wide = (bytes[at + 2] & 0x80) != 0;
    at += 3;
  } else if (at + 1 < length && bytes[at] == 0x0F) {
    parts.map = bytes[at + 1] == 0x38 ? 2 : bytes[at + 1] == 0x3A ? 3 : 1;
    at += parts.map == 1 ? 1 : 2;
  }
  if (at < length) parts.opcode = bytes[at];
  if (at + 1 < length) {
    parts.in_memory = bytes[at + 1] < 0xC0;
    parts.reg = (bytes[at + 1] >> 3) & 7;
  }
  return parts;
}

static UChar if_memory(const Parts* p, UInt classes) { return (UChar)(p->in_memory ? classes : 0); }
static UChar move(const Parts* p, UInt in_memory, UInt in_register) {
  return (UChar)(p->in_memory ? in_memory : in_register);
}

/// D8 to DF. With a memory operand, an odd opcode loads, stores or controls by its middle field; an even one
/// computes.
static UChar x87_mix(const Parts* p) {
  if (!p->in_memory) return fp;
  if ((p->opcode & 1) == 0) return fp | load;
  const Bool is_control = p->opcode == 0xD9 && p->reg >= 4;
  if (is_control) return p->reg == 5 || p->reg == 4 ? load : fp | store;
  return p->reg == 0 || p->reg == 5 || (p->opcode == 0xDF && p->reg == 4) ? load : store;
}

/// F6, F7, FE, FF: groups whose operation is in the middle field.
static UChar group_mix(const Parts* p) {
  if (p->opcode >= 0xFE) {
    if (p->opcode == 0xFF && p->reg == 6) return store;                                 // push
    if (p->opcode == 0xFF && p->reg >= 2) return (UChar)(branch | if_memory(p, load));  // call, jmp
    return (UChar)(integer | if_memory(p, load | store));                               // inc, dec
  }
  const Bool writes = p->reg == 2 || p->reg == 3;  // not, neg; the others test, multiply and divide
  return (UChar)(integer | if_memory(p, writes ? load | store : load));
}

static UChar one_byte_mix(const Parts* p) {
  const UChar op = p->opcode;
  if (op < 0x40) {  // the eight operations of two operands; 38 to 3F compare
    const UChar form = op & 7;
    if (form >= 4) return integer;
    return (UChar)(integer | if_memory(p, form < 2 && op < 0x38 ? load | store : load));
  }
  if ((op >= 0x70 && op <= 0x7F) || (op >= 0xE0 && op <= 0xE3) || (op >= 0xE8 && op <= 0xEB) || op == 0xC2 ||
      op == 0xC3)
    return branch;
  if ((op >= 0x50 && op <= 0x57) || op == 0x68 || op == 0x6A || op == 0x9C) return store;  // push
  if ((op >= 0x58 && op <= 0x5F) || op == 0x8F || op == 0x9D || op == 0xC9) return load;   // pop, leave
  if (op >= 0xD8 && op <= 0xDF) return x87_mix(p);
  if (op == 0xF6 || op == 0xF7 || op >= 0xFE) return group_mix(p);
  switch (op) {
    case 0x8D:
    case 0x86:
    case 0x87:  // lea; exchanges count as what they compute
      return integer;
    case 0x63:
    case 0x8A:
    case 0x8B:
      return move(p, load, integer);
    case 0x88:
    case 0x89:
    case 0xC6:
    case 0xC7:
      return move(p, store, integer);
    case 0xA0:
    case 0xA1:
      return load;
    case 0xA2:
    case 0xA3:
    case 0xA4:
    case 0xA5:
      return store;
    case 0xAA:
    case 0xAB:
      return integer | load | store;
    case 0xA6:
    case 0xA7:
    case 0xAC:
    case 0xAD:
    case 0xAE:
    case 0xAF:
      return integer | load;
    case 0x80:
    case 0x81:
    case 0x83:
      return (UChar)(integer | if_memory(p, p->reg == 7 ? load : load | store));
    case 0x84:
    case 0x85:
    case 0x69:
    case 0x6B:
      return (UChar)(integer | if_memory(p, load));
    case 0xC0:
    case 0xC1:
    case 0xD0:
    case 0xD1:
    case 0xD2:
    case 0xD3:
      return (UChar)(integer | if_memory(p, load | store));
    default:
      return integer;
  }
}

/// 0F xx on general registers.
static UChar integer_0f_mix(const Parts* p) {
  const UChar op = p->opcode;
  if (op >= 0x80 && op <= 0x8F) return branch;
  if (op >= 0x90 && op <= 0x9F) return (UChar)(integer | if_memory(p, load | store));  // setcc
  switch (op) {
    case 0xB6:
    case 0xB7:
    case 0xBE:
    case 0xBF:  // movzx, movsx
      return move(p, load, integer);
    case 0xC3:
      return store;
    case 0xA4:
    case 0xA5:
    case 0xAB:
    case 0xAC:
    case 0xAD:
    case 0xB0:
    case 0xB1:
    case 0xB3:
    case 0xBB:
    case 0xC0:
    case 0xC1:
    case 0xC7:
      return (UChar)(integer | if_memory(p, load | store));
    case 0xBA:
      return (UChar)(integer | if_memory(p, p->reg == 4 ? load : load | store));
    case 0xAE:
      return (UChar)(integer | if_memory(p, p->reg == 2 ? load : p->reg == 3 ? store : 0));
    case 0x0D:
    case 0x18:
    case 0x19:
    case 0x1A:
    case 0x1B:
    case 0x1C:
    case 0x1D:
    case 0x1E:
    case 0x1F:
      return integer;  // prefetch, nop
    default:
      return (UChar)(integer | if_memory(p, load));
  }
}

static Bool is_vector_0f(UChar op) {
  return (op >= 0x10 && op <= 0x17) || (op >= 0x28 && op <= 0x2F) || (op >= 0x50 && op <= 0x7F) ||
         op == 0xC2 || (op >= 0xC4 && op <= 0xC6) || op >= 0xD0;
}

static UChar vector_0f_mix(const Parts* p) {
  switch (p->opcode) {
    case 0x10:
    case 0x12:
    case 0x16:
    case 0x28:
    case 0x6E:
    case 0x6F:
    case 0xF0:
      return move(p, load, fp);
    case 0x7E:
      return move(p, p->prefix == 0xF3 ? load : store, fp);
    case 0x11:
    case 0x13:
    case 0x17:
    case 0x29:
    case 0x2B:
    case 0x7F:
    case 0xD6:
    case 0xE7:
      return move(p, store, fp);
    case 0x77:  // vzeroupper names no register
      return integer;
    default:
      return (UChar)(fp | if_memory(p, load));
  }
}

/// 0F 38 and 0F 3A: vectors, except the bit manipulations of BMI, movbe and crc32.
static Bool is_vector_0f38(const Parts* p) {
  if (p->map == 3) return !(p->is_vex && p->opcode == 0xF0);
  return p->opcode < 0xF0;
}

static UChar upper_mix(const Parts* p) {
  if (!is_vector_0f38(p)) return (UChar)(integer | if_memory(p, load));
  if (p->map == 3 && ((p->opcode >= 0x14 && p->opcode <= 0x17) || p->opcode == 0x19 || p->opcode == 0x39))
    return (UChar)(fp | if_memory(p, store));
  if (p->map == 2 && p->opcode == 0x2A) return move(p, load, fp);
  if (p->map == 2 && (p->opcode == 0x2E || p->opcode == 0x2F || p->opcode == 0x8E)) return fp | store;
  return (UChar)(fp | if_memory(p, load));
}

static UChar lane_of_prefix(UChar prefix) { return prefix == 0x66 || prefix == 0xF2 ? 8 : 4; }

/// Compilers copy any 16 bytes with movups and movaps, and 8 bytes with movlps, which say nothing of the
/// lanes.
static UChar lane_bytes_of(const Parts* p) {
  const UChar op = p->opcode;
  if (p->map == 1) {
    if (op == 0x10 || op == 0x28) return p->prefix == 0 ? 0 : lane_of_prefix(p->prefix);
    if (op == 0x12 || op == 0x16) return p->prefix == 0 ? 0 : p->prefix == 0xF3 ? 4 : 8;
    if (op == 0x2E || op == 0x2F || op == 0x14 || op == 0x15 || op == 0xC2 || op == 0xC6 || op == 0x51 ||
        op == 0x58 || op == 0x59 || op == 0x5A || (op >= 0x5C && op <= 0x5F) || op == 0x2C || op == 0x2D)
      return lane_of_prefix(p->prefix);
    return 0;
  }
  if (p->map == 2 && p->is_vex) {
    if (op == 0x18) return 4;
    if (op == 0x19) return 8;
    if (op >= 0x96 && op <= 0xBF) return p->wide ? 8 : 4;  // fused multiply-add
  }
  return 0;
}

static UChar branch_kind(const Parts* p) {
  const UChar op = p->opcode;
  if (p->map == 1) return op >= 0x80 && op <= 0x8F ? branch_conditional : no_branch;
  if (p->map != 0) return no_branch;
  if ((op >= 0x70 && op <= 0x7F) || (op >= 0xE0 && op <= 0xE3)) return branch_conditional;
  if (op == 0xE8) return branch_call;
  if (op == 0xE9 || op == 0xEB) return branch_direct;
  if (op == 0xC2 || op == 0xC3) return branch_return;
  return op == 0xFF && p->reg >= 2 && p->reg <= 5 ? branch_indirect : no_branch;
}

Decoded decode(const UChar* bytes, UInt length) {
  const Parts parts = take_apart(bytes, length);
  Decoded result = {0};
  result.branch = branch_kind(&parts);
  if (parts.map == 0) {
    result.mix = one_byte_mix(&parts);
    result.is_float = parts.opcode >= 0xD8 && parts.opcode <= 0xDF;
  } else if (parts.map == 1 && !is_vector_0f(parts.opcode)) {
    result.mix = integer_0f_mix(&parts);
  } else if (parts.map == 1) {
    result.mix = vector_0f_mix(&parts);
    result.is_float = True;
  } else {
    result.mix = upper_mix(&parts);
    result.is_float = is_vector_0f38(&parts);
  }
  result.lane_bytes = lane_bytes_of(&parts);
  return result;
}
