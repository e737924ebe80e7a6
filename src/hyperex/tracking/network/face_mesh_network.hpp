// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core.hpp>

#include "hyperex/tracking/network/face_points.hpp"

namespace hyperex::tracking {

/// The landmark network of MediaPipe Face Mesh with attention (face_landmark_with_attention.tflite;
/// I. Grishchenko et al., "Attention Mesh: High-fidelity Face Mesh Prediction in Real-time", CVPR
/// Workshop 2020): 468 points of the whole face, then lips and eyes again, each from the features
/// about the place where the first look saw them. Three operations of the file are its authors' own
/// and done here: the square about a region (Landmarks2TransformMatrix), its bilinear samples
/// (TransformTensorBilinear) and the way back (TransformLandmarks); which points are looked at
/// again, and how far about them, stands in the file.
class FaceMeshNetwork {
 public:
  /// `lips`, `eyes`: whether they are looked at again.
  FaceMeshNetwork(bool lips, bool eyes);
  ~FaceMeshNetwork();
  FaceMeshNetwork(FaceMeshNetwork&&) noexcept;
  FaceMeshNetwork& operator=(FaceMeshNetwork&&) noexcept;

  int size_px() const;  ///< side of the square picture that it sees
  /// `picture`: 1 x 3 x size x size, RGB, 0 to 1. The points in the picture's pixels, (0, 0) its
  /// upper left corner; returns the score, 0 to 1. Where the score is below `least_score` the
  /// second look is spared.
  double look(const cv::Mat& picture, double least_score, FacePoints& points);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
