// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::report {

enum class Page {
  replay,    ///< web/report.html
  tracking,  ///< web/tracking.html
  visits,    ///< web/visits.html
  studio,  ///< web/studio.html, which has no place for data: it gets them from the studio's server
};

/// A page as Vite built it from web/, with scripts and styles inside and no data.
std::string_view page_template(Page page);

/// The place for the data in the pages `replay`, `tracking` and `visits`.
inline constexpr std::string_view data_mark = "<!--HYPEREX_DATA-->";

}  // namespace hyperex::report
