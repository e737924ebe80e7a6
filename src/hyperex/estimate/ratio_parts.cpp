// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/ratio_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "hyperex/core/error.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/unknown_names.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"

namespace hyperex::estimate {
namespace {

[[noreturn]] void refuse(const std::string& asked, const std::string& expected) {
  throw InputError(
      {.file = {}, .line = 0, .key = "stiffness", .value = asked, .expected = expected});
}

/// The index in "tissue.region[2]", or -1.
int scene_region(const std::string& part) {
  constexpr std::string_view head = "tissue.region[";
  if (!part.starts_with(head) || !part.ends_with("]")) return -1;
  int index = -1;
  const char* const end = part.data() + part.size() - 1;
  const auto [stop, error] = std::from_chars(part.data() + head.size(), end, index);
  return error == std::errc{} && stop == end ? index : -1;
}

tissue::TissueRegion region_of(const scene::Scene& scene, const std::string& asked,
                               const std::string& part) {
  tissue::TissueRegion region;
  if (part.starts_with("tissue.region")) {
    const int index = scene_region(part);
    if (index < 0 || index >= int(scene.tissue.regions.size()))
      refuse(asked, fmt::format("the number of a region of the scene, which has {}",
                                scene.tissue.regions.size()));
    region = scene.tissue.regions[std::size_t(index)];
    region.value = region.factor = {};
    region.volume_m3 = 0;
    return region;
  }
  if (!tissue::is_region(part)) {
    const std::string near = session::nearest_region(part);
    refuse(asked, "names of parts of the face (hyperex presets lists them)" +
                      (near.empty() ? "" : "; did you mean " + near + "?"));
  }
  region.name = part;
  return region;
}

/// Per tetrahedron: how much of a change of this part applies.
std::vector<double> shares(session::FaceSession& session, const std::string& asked,
                           const std::string& part) {
  scene::Scene doubled = session.scene();
  doubled.tissue = {};
  tissue::TissueRegion region = region_of(session.scene(), asked, part);
  region.factor[tissue::young] = 2;
  doubled.tissue.regions = {region};
  const auto tets = std::size_t(session.mesh().volume.tets.rows());
  const double plain = tissue::default_parameters[tissue::young];
  std::vector<double> out = session.tissue_of(doubled).element[tissue::young];
  if (out.size() != tets) refuse(asked, "a part of the face that the scan has");
  for (double& young : out) young = std::clamp(young / plain - 1, 0.0, 1.0);
  return out;
}

}  // namespace

StiffnessRatio ratio_of(session::FaceSession& session, const std::string& asked) {
  const std::size_t colon = asked.find(':');
  const std::string over = asked.substr(0, colon);
  for (const char* whole : {"all", "tissue", "young_kpa", "tissue.young_kpa"})
    if (asked == whole)
      refuse(
          asked,
          "a ratio of two parts, as cheek_L:cheek_R. Motion alone does not determine how stiff "
          "the whole tissue is: stiffer tissue under stronger muscles moves the same. A known load "
          "does (--lying, --weight)");
  StiffnessRatio out;
  out.name = over;
  out.over = shares(session, asked, over);
  if (colon == std::string::npos) return out;
  const std::string under = asked.substr(colon + 1);
  if (under == over) refuse(asked, "two different parts");
  out.name = over + " / " + under;
  out.under = shares(session, asked, under);
  return out;
}

}  // namespace hyperex::estimate
