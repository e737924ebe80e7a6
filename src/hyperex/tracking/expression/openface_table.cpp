// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/expression/openface_table.hpp"

// A small table, kept as a file, copied into the library by the assembler.
__asm__(
    ".pushsection .rodata\n.global hyperex_openface_arkit_begin\n"
    ".global hyperex_openface_arkit_end\nhyperex_openface_arkit_begin:\n"
    ".incbin \"" HYPEREX_OPENFACE_TABLE "\"\nhyperex_openface_arkit_end:\n.byte 0\n.popsection\n");

extern "C" const char hyperex_openface_arkit_begin[], hyperex_openface_arkit_end[];

namespace hyperex::tracking {

std::string_view openface_arkit_table() {
  return {hyperex_openface_arkit_begin, hyperex_openface_arkit_end};
}

}  // namespace hyperex::tracking
