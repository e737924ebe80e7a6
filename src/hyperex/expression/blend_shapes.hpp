// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/expression/face_model.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::expression {

/// Weights of ARKit's blend shapes (Apple, ARFaceAnchor.BlendShapeLocation) over time.
struct BlendShapes {
  std::vector<std::string> names;  ///< e.g. "jawOpen", "mouthSmileLeft" (the subject's left)
  std::vector<double> time_s;      ///< N values, strictly increasing
  Eigen::MatrixXd weights;  ///< N x |names|, 0 to 1; a row of NaN where the face was not seen
  /// Live Link's angles of the eyes, radians, N x 4: yaw (to the subject's right above 0) and pitch
  /// (down above 0) of the left eye, then of the right. No columns where there are none.
  Eigen::MatrixXd eye_angles_rad;
  std::filesystem::path file;
  std::vector<int> lines;  ///< line of `file` of each sample, for messages; empty where not known
  /// What each weight is called in `file`, as "JawOpen" or "AU10_r and AU25_r"; empty where not
  /// known.
  std::vector<std::string> columns;
  std::vector<std::string> notes;  ///< assumptions and omissions, one sentence each
  /// Ignored columns whose names look misspelt: "column mouthSmilRight is no ...; did you mean
  /// ...?"
  std::vector<std::string> misspelt;
};

/// Reads a CSV of blend-shape weights. It has a column of time (`time_s`, `time` or `timestamp` in
/// seconds, or `Timecode` as Live Link Face writes it) and columns named after blend shapes; the
/// first letter of a name may be small or capital. Other columns are ignored and named in a note.
/// They are also listed in `misspelt` if the name differs by at most two letters from that of a
/// blend shape without a column. LeftEyeYaw, LeftEyePitch, RightEyeYaw and RightEyePitch of Live
/// Link are read where all four are there and not all values are 0. They are left out with a note
/// if one exceeds a quarter of a turn, as they are no radians then. Weights a little outside 0 to
/// 1, as smoothing produces them, are clamped to that range. Throws InputError naming the file if
/// there is no time or no blend shape, if time does not increase, or if a weight is below -0.05 or
/// above 1.5 (perhaps percent).
BlendShapes read_arkit(const std::filesystem::path& file);

/// Reads a CSV of OpenFace 2: `timestamp`, `success` and intensities `AU01_r` ... from 0 to 5. They
/// are converted to blend-shape weights by data/openface_arkit.csv. A frame without success gives a
/// row of NaN. Throws InputError if there is no timestamp or no intensity, or if an intensity is
/// outside 0 to 5.
BlendShapes read_openface(const std::filesystem::path& file);

/// The motion of a model's landmarks that the blend shapes produce through the model's animation
/// units and recorded units. The weight of a unit is w+ / arkit_scale - w- / arkit_negative_scale.
/// Here w+ is the mean of the blend shapes that the unit's `arkit` names, and w- the mean of those
/// that its `arkit_negative` names. A name with "*" means two blend shapes, one with Left and one
/// with Right in its place. Where the unit has an `arkit_factor`, its weight is multiplied by the
/// weight of that blend shape. The points are in the model's frame and size, without head pose.
/// They are NaN where the face was not seen. Adds a note on blend shapes that the model does not
/// have, except those of gaze, which turn the eyes (gaze.hpp). A gaze aside alone leaves points at
/// rest. Where the model says so (lids_once), lids follow the gaze as with_lids_once() states.
/// Throws InputError if no blend shape moves the model or the eyes.
motion::Motion motion_of(const BlendShapes& shapes, const FaceModel& model,
                         std::vector<std::string>& notes);

}  // namespace hyperex::expression
