// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/page_template.hpp"

// A megabyte as a C++ array compiles for seconds; the assembler copies the file as it is.
__asm__(
    ".pushsection .rodata\n"
    ".global hyperex_page_begin\n"
    ".global hyperex_page_end\n"
    "hyperex_page_begin:\n"
    ".incbin \"" HYPEREX_PAGE_FILE
    "\"\n"
    "hyperex_page_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" const char hyperex_page_begin[];
extern "C" const char hyperex_page_end[];

namespace hyperex::report {

std::string_view page_template() {
  return {hyperex_page_begin, hyperex_page_end};
}

}  // namespace hyperex::report
