// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From a CT to surfaces, thickness and landmarks.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/ct/bones.hpp"
#include "hyperex/ct/label_surfaces.hpp"
#include "hyperex/ct/read_series.hpp"
#include "hyperex/ct/thickness.hpp"

namespace hyperex::ct {

struct CtOptions {
  std::filesystem::path source;
  SeriesChoice series;
  std::optional<double> skin_hu, bone_hu;
  std::optional<Seeds> seeds;
  OwnBones own;
};

/// All that a CT gives; lengths in metres, in the frame of a face. It names no patient.
struct CtFace {
  SeriesVolume series;  ///< its values as measured
  Body body;
  Thresholds thresholds;
  BoneSurfaces bones;
  TriMesh skin;
  bool own_bones = false, seeded = false;
  bool separated = true;  ///< the mandible is a surface of its own
  double level_hu = 0;    ///< at which skull and mandible fell apart
  double metal_cm3 = 0;   ///< denser than kMetal_hu
  double greatest_hu = 0;
  FoundPoints points;
  FaceBounds bounds;
  Thickness thickness;  ///< per vertex of the skin
  std::vector<std::string> notes, warnings;
};

constexpr double kMetal_hu = 2500, kTeethVoxel_m = 0.6e-3;
constexpr double kSkinEdge_m = 1.6e-3, kBoneEdge_m = 1.8e-3, kThinned_m = 1e-4;

/// Throws InputError as read_series(), find_skin_threshold(), find_body() and find_bones() do.
CtFace face_of_ct(const CtOptions& options);
/// The same of a volume that was read already; `options.source` and `options.series` are not used.
CtFace face_of_series(SeriesVolume series, const CtOptions& options = {});

}  // namespace hyperex::ct
