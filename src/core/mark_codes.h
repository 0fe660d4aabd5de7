/// What a program tells the Valgrind tool pbvalue about itself; plain C, so that both sides can read it.
#pragma once

/// Client requests, with Valgrind's letters 'P' 'B' in the upper half (VG_USERREQ_TOOL_BASE).
enum {
  pbvalue_request_section = 0x50420000, /* argument: a PbvalueSection; from here to the next request */
  pbvalue_request_phase = 0x50420001    /* argument: a PbvaluePhase */
};

/// The counted section: the step of a frame, or its estimate (FEEC). Each begin of a section starts a record.
enum PbvalueSection { pbvalue_no_section, pbvalue_precise, pbvalue_estimate };

/// The part of a step. Code between the parts (counting, rules) is no_phase.
enum PbvaluePhase { pbvalue_no_phase, pbvalue_collision, pbvalue_forward };
