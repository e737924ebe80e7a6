// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A segmentation of the user's own, in the place of ours.
#include <filesystem>
#include <optional>

#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

enum class SurfaceFrame { patient, face };

/// Surfaces (STL, PLY, OBJ in mm), or one volume of labels (NIfTI, NRRD).
struct OwnBones {
  std::filesystem::path skull, mandible, labels;
  SurfaceFrame frame = SurfaceFrame::patient;  ///< of the surfaces
  int skull_label = 1, mandible_label = 2;
  bool given() const { return !skull.empty() || !mandible.empty() || !labels.empty(); }
};

struct BoneSurfaces {
  TriMesh skull, mandible;  ///< the frame of a face, m; without triangles where there is none
};

/// Throws InputError where one of two surfaces is missing, a file cannot be read, a label does not
/// occur, fewer than 98 % of a surface's vertices lie where `head` has at least `skin_hu`, or the
/// mandible's middle is above the skull's.
BoneSurfaces read_own_bones(const OwnBones& own, const Volume& head, double skin_hu);

/// The surface of one label: the flags, smoothed by weights 1 2 1 along each axis, at one half.
TriMesh label_surface(const Volume& labels, int label);

}  // namespace hyperex::ct
