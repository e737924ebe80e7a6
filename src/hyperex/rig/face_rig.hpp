// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
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
  std::vector<Note> notes;                      ///< of the session
};

/// The shapes of one face. Each is the face under the muscles and the jaw that move its landmarks
/// as the shape moves those of real faces (shape_motion.hpp), lids by shares of the aperture, lips
/// in contact. Exceptions:
///   mouthClose    what is left of an open mouth with closed lips when the open mouth is taken away
///                 (both at weight 0.7), so that mouthClose with the weight of jawOpen closes it
///   eyeLook...    the eyes turn; the lids follow a gaze up by 0.5 of eyeWide and one down by 0.4
///   of
///                 eyeBlink
///   tongueOut     nothing: there is no tongue
/// `changes`: of keys of the scene (docs/scene.md), as of muscles or tissue. Throws InputError,
/// NumericalError.
FaceRig make_rig(session::Face face, const session::Changes& changes = {});

}  // namespace hyperex::rig
