// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/simulate/contact/lip_surfaces.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/drive/skin_measured.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// Computes the motion of skin, landmarks and lips from that of the tissue. It depends on the face
/// only and can be used for any number of runs. Const members may be called from several threads.
class Readout {
 public:
  /// `mesh` must outlive this.
  Readout(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

  /// Displacement of the skin (|skin| x 3, m). It follows the tissue's nodes (|nodes| x 3) or,
  /// where it is measured, the tracked points (P x 3). `rim`: DrivenPoints::rim.
  PointsF skin(const MeasuredRegion& region, const std::vector<tissue::RimVertex>& rim,
               const Points& nodes, const Points& points) const;
  /// The landmarks, which move with the skin, one sample per frame.
  motion::Motion landmark_tracks(const std::vector<double>& time_s,
                                 const std::vector<PointsF>& frames) const;

  /// The greatest depth of the lips in each other in any frame (LipSurfaces), and the greatest
  /// distance between upper and lower lip (ibug68_62, 66) less that of the first frame.
  struct Lips {
    double overlap_mm = 0, gap_mm = 0;
    int overlap_frame = -1;  ///< below 0: they overlap in none
  };
  /// `each(count, f)` calls f for 0 to count - 1, in parallel or not.
  using EachFrame = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
  Lips lips(const motion::Motion& tracks, const std::vector<PointsF>& frames,
            const EachFrame& each) const;

  const std::shared_ptr<const LipSurfaces>& lip_surfaces() const { return surfaces_; }

 private:
  const tissue::TissueMesh& mesh_;
  std::vector<std::string> names_;
  Points rest_;                // of the landmarks
  std::vector<Match> places_;  // of them on the skin
  std::shared_ptr<const LipSurfaces> surfaces_;
};

/// Converts to single precision. Subnormal numbers become 0: some libraries' threads flush them and
/// others do not, and results must not depend on the thread.
PointsF in_single_precision(const Points& points);

/// The points of a motion that drive, and their places on the skin.
struct DrivenPoints {
  /// `wanted`: names; those that the motion lacks are left out.
  /// `landmarks`: of the face at rest, the 68 iBUG points among them.
  DrivenPoints(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
               const AlignedMotion& motion, const std::vector<std::string>& wanted);

  std::vector<int> rows;  ///< in the motion
  std::vector<std::string> names;
  Points rest;                ///< positions at rest (n x 3, m)
  std::vector<Match> places;  ///< on the skin
  /// The mesh's rim through these places (rim_through), with lids that close (share_lid_apertures).
  std::vector<tissue::RimVertex> rim;

  /// Per point: the greatest distance (m) in any frame from where it is driven.
  std::vector<double> off_m(const Performance& performance, const PointCurve& wanted) const;
};

/// The frame nearest to `peak_time_s`. Below 0: the frame in which the mean displacement of the
/// points of `rows` is greatest.
int peak_frame(const std::vector<double>& time_s, double peak_time_s, const std::vector<int>& rows,
               const PointCurve& points);

}  // namespace hyperex::simulate
