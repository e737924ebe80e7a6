// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/page_template.hpp"

// A megabyte as a C++ array compiles for seconds; the assembler copies the file as it is.
#define HYPEREX_CARRY(NAME, FILE) \
  __asm__(                        \
      ".pushsection .rodata\n"    \
      ".global hyperex_" NAME     \
      "_begin\n"                  \
      ".global hyperex_" NAME     \
      "_end\n"                    \
      "hyperex_" NAME             \
      "_begin:\n"                 \
      ".incbin \"" FILE           \
      "\"\n"                      \
      "hyperex_" NAME             \
      "_end:\n"                   \
      ".byte 0\n"                 \
      ".popsection\n")

HYPEREX_CARRY("replay_page", HYPEREX_REPORT_PAGE_FILE);
HYPEREX_CARRY("tracking_page", HYPEREX_TRACKING_PAGE_FILE);
HYPEREX_CARRY("studio_page", HYPEREX_STUDIO_PAGE_FILE);

extern "C" const char hyperex_replay_page_begin[], hyperex_replay_page_end[];
extern "C" const char hyperex_tracking_page_begin[], hyperex_tracking_page_end[];
extern "C" const char hyperex_studio_page_begin[], hyperex_studio_page_end[];

namespace hyperex::report {

std::string_view page_template(Page page) {
  if (page == Page::tracking) return {hyperex_tracking_page_begin, hyperex_tracking_page_end};
  if (page == Page::studio) return {hyperex_studio_page_begin, hyperex_studio_page_end};
  return {hyperex_replay_page_begin, hyperex_replay_page_end};
}

}  // namespace hyperex::report
