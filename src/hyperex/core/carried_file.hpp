// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files that a library carries inside. A megabyte as a C++ array compiles for seconds; the
// assembler copies it as it is.
#include <string_view>

/// Defines `std::string_view NAME()`, the bytes of FILE (a literal), in a namespace with a name. A
/// zero follows them. No other file in the program may have this NAME.
#define HX_CARRIED_FILE(NAME, FILE)                                       \
  __asm__(                                                                \
      ".pushsection .rodata\n"                                            \
      ".balign 16\n"                                                      \
      ".global hyperex_" #NAME                                            \
      "_begin\n"                                                          \
      ".global hyperex_" #NAME                                            \
      "_end\n"                                                            \
      "hyperex_" #NAME                                                    \
      "_begin:\n"                                                         \
      ".incbin \"" FILE                                                   \
      "\"\n"                                                              \
      "hyperex_" #NAME                                                    \
      "_end:\n"                                                           \
      ".byte 0\n"                                                         \
      ".popsection\n");                                                   \
  extern "C" const char hyperex_##NAME##_begin[], hyperex_##NAME##_end[]; \
  std::string_view NAME() {                                               \
    return {hyperex_##NAME##_begin, hyperex_##NAME##_end};                \
  }
