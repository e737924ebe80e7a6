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
#include "hyperex/rig/recipes.hpp"
#include "hyperex/session/changes.hpp"
#include "hyperex/session/face.hpp"
#include "hyperex/simulate/contact/lip_surfaces.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::rig {

/// Whether a rig has shapes for combinations of two (correctives.hpp).
enum class Correctives { none, of_clashing_pairs };

/// A face with ARKit's 52 blend shapes (expression::arkit_shapes()) and others.
struct FaceRig {
  std::shared_ptr<const io::Scan> scan;
  std::shared_ptr<const anatomy::Teeth> teeth;  ///< null: none
  simulate::Performance performance;            ///< the run that the shapes come from
  Vec3 jaw_axis_m;                              ///< the middle between the condyles
  /// In the order of expression::arkit_shapes(), then recipes of other names, then the correctives
  /// in the order of clashing_pairs().
  std::vector<report::RigShape> shapes;
  /// The lips of the face at rest: how deep they lie in each other under a displacement.
  std::shared_ptr<const simulate::LipSurfaces> lips;
  /// "Right", "Left": the sides on which the eye is closed in the scan. Shapes of lids and gaze
  /// move nothing there.
  std::vector<std::string> closed_eyes;
};

/// The shapes of one face. Each is the face under the muscles and the jaw that move its landmarks
/// as the shape moves those of real faces (shape_motion.hpp), lids by shares of the aperture, lips
/// in contact. Exceptions:
///   mouthClose    the displacement of the open mouth with closed lips minus that with open lips,
///                 at jawOpen = 0.7, divided by 0.7; added to jawOpen of the same weight it closes
///                 the mouth
///   eyeLook...    the eyes turn; with a gaze up or down the lids follow as the canonical face's do
///   tongueOut     nothing: the tongue stays in the mouth
/// Correctives, where asked for: the landmarks move by the sum of both shapes, muscles, jaw and
/// contact answer to that, and the displacements by the two shapes are subtracted. They are
/// simulated after the shapes, in the same run, which lasts longer by one pose each.
/// Recipes: the landmarks move by the weighted sum of the shapes of ARKit that a recipe names, and
/// the eyes turn by theirs. One with a name of ARKit's stands in its place. The weights of lids and
/// gaze of an eye that is closed in the scan are left out.
/// `changes`: keys of the sections tissue, muscles, contact, support, mesh and teeth of a scene
/// (docs/scene.md). `note`: called with each note and warning on the scan and its shapes, not
/// with those on the recording that is made for them. Throws InputError, NumericalError.
FaceRig make_rig(session::Face face, const session::Changes& changes = {},
                 const std::function<void(const Note&)>& note = {},
                 Correctives correctives = Correctives::none,
                 const std::vector<Recipe>& recipes = {});

}  // namespace hyperex::rig
