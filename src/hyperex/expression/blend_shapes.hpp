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
  std::vector<double> time_s;      ///< N of them, strictly rising
  Eigen::MatrixXd weights;  ///< N x |names|, 0 to 1; a row of NaN where the face was not seen
  std::filesystem::path file;
  std::vector<std::string> notes;  ///< what was assumed or left out: a sentence each
  /// Columns left out that look misspelt: "column mouthSmilRight is no ...; did you mean ...?"
  std::vector<std::string> misspelt;
};

/// A CSV of blend-shape weights: a column of time (`time_s`, `time` or `timestamp` in seconds, or
/// `Timecode` as Live Link Face writes it) and columns named after blend shapes, the first letter
/// small or capital; others are left out and named in a note, in `misspelt` where a blend shape
/// that the file lacks is at most two letters away. Throws InputError naming the file: no time, no
/// blend shape, time that does not rise, a weight below -0.05 or above 1.5 (percent, perhaps).
/// Weights a little beyond 0 to 1, as smoothing leaves them, are kept to that range.
BlendShapes read_arkit(const std::filesystem::path& file);

/// A CSV of OpenFace 2: `timestamp`, `success` and intensities `AU01_r` ... from 0 to 5, made
/// blend-shape weights by data/openface_arkit.csv. Frames of no success are rows of NaN.
/// Throws InputError: no timestamp, no intensities, one outside 0 to 5.
BlendShapes read_openface(const std::filesystem::path& file);

/// The points that a model's landmarks name, moved by its animation units: weight = (w+ - w-) /
/// arkit_scale, w+ and w- the mean of the blend shapes that the unit's `arkit` and
/// `arkit_negative` name ("*": Left and Right). In the model's frame and size, no head pose; NaN
/// where the face was not seen. Throws InputError where no blend shape moves the model. A note says
/// which blend shapes it does not have.
motion::Motion motion_of(const BlendShapes& shapes, const FaceModel& model,
                         std::vector<std::string>& notes);

}  // namespace hyperex::expression
