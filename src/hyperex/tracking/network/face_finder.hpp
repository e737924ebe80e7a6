// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "hyperex/tracking/network/face_region.hpp"

namespace hyperex::tracking {

/// A face as the detector sees it, in pixels of the picture, pixel centres at integers.
struct FoundFace {
  double score = 0;  ///< 0 to 1
  cv::Rect2d box;    ///< brow to chin, cheek to cheek
  /// The subject's right eye, left eye, nose tip, mouth, right ear, left ear.
  std::array<cv::Point2d, 6> points;

  /// The square for the landmark network: 1.5 x the longer side of the box, upright along the eyes.
  FaceRegion region() const;
};

struct FaceFinderOptions {
  double least_score = 0.5;        ///< of a face, 0 to 1
  double same_face_overlap = 0.3;  ///< boxes that overlap more (intersection over union) are one
  /// Where the whole picture shows none: also overlapping squares of half the shorter side, for
  /// faces too small to be seen at the network's 128 pixels.
  bool look_closer = true;
};

/// Faces in a picture: the short-range detector of MediaPipe (V. Bazarevsky et al., "BlazeFace:
/// Sub-millisecond Neural Face Detection on Mobile GPUs", CVPR Workshop 2019).
class FaceFinder {
 public:
  explicit FaceFinder(const FaceFinderOptions& options = {});
  ~FaceFinder();
  FaceFinder(FaceFinder&&) noexcept;
  FaceFinder& operator=(FaceFinder&&) noexcept;

  /// The faces in a picture (CV_8UC3, BGR, not empty), the largest box first. The result is valid
  /// until the next call.
  const std::vector<FoundFace>& find(const cv::Mat& bgr);
  /// The faces in one square of a picture, which may be turned: faces that stand upright in it.
  /// FoundFace::box then has its sides along the square's.
  const std::vector<FoundFace>& find_in(const cv::Mat& bgr, const FaceRegion& square);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
