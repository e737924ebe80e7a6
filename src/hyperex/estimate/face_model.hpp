// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/estimate/face_responses.hpp"
#include "hyperex/estimate/question.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"

namespace hyperex::estimate {

/// The muscles of a face in pairs, and what is known of their activations beforehand.
struct MusclePrior {
  std::vector<int> left, right;            ///< pairs: indices of the muscles
  std::vector<char> tone;                  ///< per muscle: its activation may go below 0
  Eigen::VectorXd sigma;                   ///< per pair: of the mean of both activations
  Eigen::MatrixXd together;                ///< per pair: correlations of these means
  double opening_rad, turn_rad, tilt_rad;  ///< 1 sigma of the jaw's pose
  Vec3 slide_m;
};

/// Everything about a face that does not depend on its recordings.
struct FaceModel {
  FaceResponses responses;
  simulate::JawKinematics jaw;
  double half;  ///< MuscleOptions::half
  MusclePrior prior;
  std::vector<std::vector<int>> acts;  ///< per requested gain: the muscles it acts on
  Points places;                       ///< of the points at rest, P x 3, m
  std::vector<KnownLoad> loads;
};

/// `points`: names and places (P x 3, m) of those that all recordings observe. Mesh and landmarks
/// must outlive the result. Throws InputError for a gain that names no muscle.
FaceModel face_model(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                     const simulate::SimulationOptions& options,
                     const std::vector<std::string>& points, const Points& places,
                     const Question& question);

}  // namespace hyperex::estimate
