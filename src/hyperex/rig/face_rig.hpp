// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/core/note.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/report/rig_glb.hpp"
#include "hyperex/session/changes.hpp"
#include "hyperex/session/face.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::rig {

/// A face with ARKit's 52 blend shapes (expression::arkit_shapes()).
struct FaceRig {
  std::shared_ptr<const io::Scan> scan;
  std::shared_ptr<const anatomy::Teeth> teeth;  ///< null: none
  simulate::Performance performance;            ///< the run that the shapes come from
  Vec3 jaw_axis_m;                              ///< the middle between the condyles
  std::vector<report::RigShape> shapes;         ///< in the order of expression::arkit_shapes()
  /// "Right", "Left": the sides on which the eye is closed in the scan. Shapes of lids and gaze
  /// move nothing there.
  std::vector<std::string> closed_eyes;
};

/// The shapes of one face. Each is the face under the muscles and the jaw that move its landmarks
/// as the shape moves those of real faces (shape_motion.hpp), lids by shares of the aperture, lips
/// in contact. Exceptions:
///   mouthClose    the displacement of the open mouth with closed lips minus that with open lips,
///   at
///                 jawOpen = 0.7, divided by 0.7; added to jawOpen of the same weight it closes the
///                 mouth
///   eyeLook...    the eyes turn; with a gaze up or down the lids follow as the canonical face's do
///   tongueOut     nothing: the tongue stays in the mouth
/// `changes`: keys of the sections tissue, muscles, contact, support, mesh and teeth of a scene
/// (docs/scene.md). `note`: called with each note and warning on the scan and its shapes, not
/// with those on the recording that is made for them. Throws InputError, NumericalError.
FaceRig make_rig(session::Face face, const session::Changes& changes = {},
                 const std::function<void(const Note&)>& note = {});

}  // namespace hyperex::rig
