// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/page_template.hpp"

#include "hyperex/core/carried_file.hpp"

namespace hyperex::report {

HX_CARRIED_FILE(replay_page, HYPEREX_REPORT_PAGE_FILE)
HX_CARRIED_FILE(tracking_page, HYPEREX_TRACKING_PAGE_FILE)
HX_CARRIED_FILE(visits_page, HYPEREX_VISITS_PAGE_FILE)
HX_CARRIED_FILE(studio_page, HYPEREX_STUDIO_PAGE_FILE)

std::string_view page_template(Page page) {
  if (page == Page::tracking) return tracking_page();
  if (page == Page::visits) return visits_page();
  if (page == Page::studio) return studio_page();
  return replay_page();
}

}  // namespace hyperex::report
