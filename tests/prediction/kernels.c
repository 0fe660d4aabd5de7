/* Programs whose values and cycles are known by hand, for the Valgrind tool pbvalue.
 *
 * Usage: kernels NAME [COUNT] [< values]. COUNT: rounds of the loop. The kernels of values read numbers from
 * standard input, move each through one instruction of a register in the marked section, and write what
 * arrived. Those of cycles print nothing; random_bytes prints COUNT bytes. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <valgrind/valgrind.h>

#include "core/mark_codes.h"

enum { max_bytes = 1 << 16, list_bytes = 8 << 20, line = 64 };

static _Alignas(64) unsigned char in[max_bytes], out[max_bytes], list[list_bytes];
static const double one = 1.0;

static void enter_section(int section) {
  VALGRIND_DO_CLIENT_REQUEST_STMT(pbvalue_request_section, section, 0, 0, 0, 0);
}
static void enter_phase(int phase) {
  VALGRIND_DO_CLIENT_REQUEST_STMT(pbvalue_request_phase, phase, 0, 0, 0, 0);
}

/* One instruction loads each value, another stores it. */
#define MOVE(load, store, step)                                                                           \
  {                                                                                                       \
    unsigned char *from = in, *to = out, *end = in + size;                                                \
    __asm__ volatile("1: " load " (%0), %%xmm0\n " store " %%xmm0, (%1)\n add $" step ", %0\n add $" step \
                     ", %1\n cmp %2, %0\n jb 1b\n"                                                        \
                     : "+r"(from), "+r"(to)                                                               \
                     : "r"(end)                                                                           \
                     : "xmm0", "memory", "cc");                                                           \
  }

static void move_doubles(long size) MOVE("movsd", "movsd", "8") static void move_floats(long size)
    MOVE("movss", "movss", "4") static void move_pairs(long size)
        MOVE("movupd", "movupd", "16") static void move_bits(long size) MOVE("movups", "movups", "16")

    /* Values pass through an addition (of nothing) and are not predicted where they are loaded: through
       integers. */
    static void add_doubles(long size) {
  unsigned char *from = in, *to = out, *end = in + size;
  __asm__ volatile(
      "pxor %%xmm1, %%xmm1\n 1: mov (%0), %%rax\n movq %%rax, %%xmm0\n addsd %%xmm1, %%xmm0\n movsd %%xmm0, "
      "(%1)\n"
      "add $8, %0\n add $8, %1\n cmp %2, %0\n jb 1b\n"
      : "+r"(from), "+r"(to)
      : "r"(end)
      : "rax", "xmm0", "xmm1", "memory", "cc");
}

/* Two loads in turn, the second of the same value each time. */
static void two_loads(long size) {
  unsigned char *from = in, *to = out, *end = in + size;
  __asm__ volatile(
      "1: movsd (%0), %%xmm0\n movsd (%3), %%xmm1\n movsd %%xmm0, (%1)\n add $8, %0\n add $8, %1\n cmp %2, "
      "%0\n jb 1b\n"
      : "+r"(from), "+r"(to)
      : "r"(end), "r"(&one)
      : "xmm0", "xmm1", "memory", "cc");
}

/* 14 instructions, the counter and the branch: 16 micro-operations a round. */
static void chain(long count) {
  __asm__ volatile(
      "movsd (%1), %%xmm1\n movapd %%xmm1, %%xmm0\n 1: .rept 14\n mulsd %%xmm1, %%xmm0\n .endr\n dec %0\n "
      "jnz 1b\n"
      : "+r"(count)
      : "r"(&one)
      : "xmm0", "xmm1", "cc");
}

static void independent(long count) {
  __asm__ volatile(
      "mov $3, %%rax\n 1: add %%rax, %%rbx\n add %%rax, %%rcx\n add %%rax, %%rdx\n add %%rax, %%rsi\n add "
      "%%rax, %%r8\n"
      "add %%rax, %%r9\n add %%rax, %%r10\n add %%rax, %%r11\n add %%rax, %%r12\n add %%rax, %%r13\n add "
      "%%rax, %%r14\n"
      "add %%rax, %%r15\n or %%rax, %%rbx\n or %%rax, %%rcx\n dec %0\n jnz 1b\n"
      : "+D"(count)
      :
      : "rax", "rbx", "rcx", "rdx", "rsi", "r8", "r9", "r10", "r11", "r12", "r13", "r14", "r15", "cc");
}

/* Each line of the list holds the address of the next one. */
static void walk(long count) {
  void* at = list;
  __asm__ volatile("1: mov (%0), %0\n dec %1\n jnz 1b\n" : "+r"(at), "+r"(count) : : "memory", "cc");
}

/* A value goes through memory in each round: a store, and the load of it. */
static void through_memory(long count) {
  __asm__ volatile("1: mov %%rax, (%1)\n mov (%1), %%rax\n dec %0\n jnz 1b\n"
                   : "+r"(count)
                   : "r"(out)
                   : "rax", "memory", "cc");
}

static void link_list(long bytes) {
  for (long at = 0; at < bytes; at += line) {
    void* next = list + (at + line) % bytes;
    memcpy(list + at, &next, sizeof next);
  }
}

/* What the kernel gave this process to make its canary of: 16 bytes. */
static void show_random_bytes(long count) {
  fwrite((const void*)getauxval(AT_RANDOM), 1, (size_t)count, stdout);
}

static const struct {
  const char* name;
  void (*run)(long);
  int moves_values;
  long list_bytes;
} kernels[] = {
    {"doubles", move_doubles, 1, 0},
    {"floats", move_floats, 1, 0},
    {"pairs", move_pairs, 1, 0},
    {"bits", move_bits, 1, 0},
    {"sums", add_doubles, 1, 0},
    {"two", two_loads, 1, 0},
    {"chain", chain, 0, 0},
    {"independent", independent, 0, 0},
    {"walk_memory", walk, 0, list_bytes},
    {"walk_l2", walk, 0, 32 << 10},
    {"walk_l1", walk, 0, 8 << 10},
    {"through_memory", through_memory, 0, 0},
    {"random_bytes", show_random_bytes, 0, 0},
};

int main(int argc, char** argv) {
  const int phase = argc > 3 ? atoi(argv[3]) : pbvalue_forward;
  for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; ++i) {
    if (argc < 2 || strcmp(argv[1], kernels[i].name) != 0) continue;
    long count = argc > 2 ? atol(argv[2]) : 0;
    if (kernels[i].moves_values) count = (long)fread(in, 1, max_bytes, stdin);
    if (count == 0) return 2;
    link_list(kernels[i].list_bytes);
    enter_section(pbvalue_precise);
    enter_phase(phase);
    kernels[i].run(count);
    enter_phase(pbvalue_no_phase);
    enter_section(pbvalue_no_section);
    if (kernels[i].moves_values) fwrite(out, 1, (size_t)count, stdout);
    return 0;
  }
  fprintf(stderr, "kernels: no kernel of that name\n");
  return 2;
}
