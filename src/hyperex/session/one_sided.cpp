// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/one_sided.hpp"

#include <fmt/format.h>

#include "hyperex/face/same_place.hpp"
#include "hyperex/metrics/recorded_sides.hpp"

namespace hyperex::session {

std::optional<Note> one_sided_warning(const motion::Motion& recorded,
                                      const io::Landmarks& landmarks) {
  const auto shows = [&](const char* name) {
    const auto corner = landmarks.find(name);
    return corner == landmarks.end() || metrics::is_recorded(recorded, name, corner->second);
  };
  const bool right = shows("cheilion_R"), left = shows("cheilion_L");
  if (right == left) return std::nullopt;
  return make_warning(
      "recording.one_sided",
      fmt::format("the {0} corner of the mouth is not recorded ({1}): a run simulates that side "
                  "from what is usual, and gives no figures of it and none that compare the sides",
                  right ? "left" : "right", face::place_name(right ? "cheilion_L" : "cheilion_R")));
}

}  // namespace hyperex::session
