// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/options.hpp"

namespace hyperex::tissue {

/// Depth of the soft tissue at a landmark.
struct DepthAt {
  std::string landmark;
  double depth_m = 0;

  static constexpr const char* about = "Thickness of the soft tissue at a landmark.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(landmark), "A landmark of the scan.", {.required = true, .least = 1});
    v.option(
        HX_MEMBER(depth_m), "Thickness of the soft tissue there.",
        {.unit = kMillimetres, .bounds = thickness_m_in, .key = "thickness_mm", .required = true});
  }
};

/// Depth of the soft tissue in a part of the skin that was painted.
struct DepthRegion {
  std::filesystem::path painted;  ///< one share per vertex of the scan (per_vertex/per_vertex.hpp)
  double depth_m = 0;             ///< where the share is 1

  static constexpr const char* about = "Thickness in a painted part of the skin.";
  template <class Visitor>
  static void describe(Visitor& v) {
    v.option(HX_MEMBER(painted),
             "The scan painted red where the tissue is of this thickness (PLY, OBJ, GLB with "
             "vertex colours), or a CSV or PLY file with one weight from 0 to 1 per vertex.",
             {.required = true});
    v.option(
        HX_MEMBER(depth_m), "Thickness of the soft tissue where the weight is 1.",
        {.unit = kMillimetres, .bounds = thickness_m_in, .key = "thickness_mm", .required = true});
  }
};

/// Mean depths of adult facial soft tissue, whole millimetres, after C. N. Stephan and E. K.
/// Simpson, "Facial soft tissue depths in craniofacial identification (part I)", J. Forensic Sci.
/// 53 (2008) 1257-1272 (pooled adults). Each craniometric point is assigned to the nearest landmark
/// (mid-philtrum, for example, to the place between subnasale and the upper lip). The depth of the
/// cheek, 20 mm and more down to the teeth, is limited to 12 mm, because the layer that moves there
/// ends at the cavity of the mouth.
const std::vector<DepthAt>& published_depths();

/// A smooth field that lies between the least and the greatest of the given depths (Shepard's
/// inverse squared distance, D. Shepard 1968) over `points`. Unknown landmarks are ignored;
/// std::invalid_argument where none is known.
Eigen::VectorXd depth_field(const Points& points, const std::vector<DepthAt>& depths,
                            const io::Landmarks& landmarks);

}  // namespace hyperex::tissue
