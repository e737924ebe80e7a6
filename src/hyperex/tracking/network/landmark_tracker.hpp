// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "hyperex/tracking/network/face_finder.hpp"
#include "hyperex/tracking/network/face_points.hpp"
#include "hyperex/tracking/network/face_region.hpp"

namespace hyperex::tracking {

/// Where the landmark network should look for a face with these points: 1.5 x the longer side of
/// their box, upright along the eyes.
FaceRegion region_of(const FacePoints& points_px);

struct FaceLandmarks {
  FacePoints points_px;
  double score = 0;         ///< that there is a face where the points are, 0 to 1
  int faces_in_view = 1;    ///< at the last look at the whole picture
  bool found_anew = false;  ///< by the detector in this picture; else followed from the last one
  FaceRegion region;        ///< the square of the picture that the network saw
};

struct LandmarkOptions {
  FaceFinderOptions finder = {};
  /// A second look at the lips takes 0.6 ms and a third off the error of their motion. One at the
  /// eyes and brows made those worse on the face it was measured on, by a third at the 95th
  /// percentile.
  bool lips_again = true, eyes_again = false;
  /// Looks at the square's mirror image too and takes the mean, in which what the network errs from
  /// left to right goes out: twice the time, 7 % off the error of the lips' and chin's motion (mean
  /// of seven recordings).
  bool mirrored_too = false;
  double least_score = 0.5;  ///< below it the face counts as lost, 0 to 1
  /// A face found anew: its square is taken from the points again until it settles, at most so
  /// often.
  int settling_rounds = 8;
  /// Pictures between two looks at the whole picture while a face is followed (they keep
  /// faces_in_view true); 0: none.
  int look_around_every = 30;
};

/// Finds a face and follows it from picture to picture: the 468 points of MediaPipe Face Mesh
/// (Y. Kartynnik et al., "Real-time Facial Surface Geometry from Monocular Video on Mobile GPUs",
/// CVPR Workshop 2019; lips as FaceMeshNetwork says). The points of one picture say where to look
/// in the next; a lost face is looked for in the whole picture. Of several faces the largest is
/// taken, and kept while it is followed. The pictures need not be of one size. The same pictures
/// give the same points.
class LandmarkTracker {
 public:
  explicit LandmarkTracker(const LandmarkOptions& options = {});
  ~LandmarkTracker();
  LandmarkTracker(LandmarkTracker&&) noexcept;
  LandmarkTracker& operator=(LandmarkTracker&&) noexcept;

  /// The face in a picture (CV_8UC3, BGR, not empty; std::invalid_argument otherwise), or nothing
  /// where there is none.
  std::optional<FaceLandmarks> track(const cv::Mat& bgr);
  /// The points in a region known from elsewhere, whatever was followed before; no look at the
  /// score. Does not change what is followed.
  FaceLandmarks look_at(const cv::Mat& bgr, const FaceRegion& region);
  /// The same, the region taken from the points again until it settles (settling_rounds); stops
  /// where the score falls below least_score.
  FaceLandmarks settle(const cv::Mat& bgr, const FaceRegion& first);
  /// Forgets the face that was followed.
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::tracking
