// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// The groove of a profile: heights at equal steps, mm.
struct Groove {
  double depth_mm = 0;  ///< 0: none
  double place_mm = 0;  ///< of its deepest point, along the profile from its first sample
};

/// The greatest distance of the profile below a straight line between two of its own points, which
/// are 2 to 20 mm apart. Samples that are NaN end the profile.
Groove groove_of(const std::vector<double>& height_mm, double step_mm);

/// Cuts of the skin across the fold from nose to mouth (nasolabial fold) of one side, at right
/// angles to the line from the wing of the nose (iBUG points 31, 35) to the corner of the mouth
/// (48, 54) as seen from the front (face_frame). `landmarks`: complete, of this surface.
class FoldProfile {
 public:
  using Place = Eigen::Vector2d;  ///< mm in the face's frame, x to the left and y up

  FoldProfile(const TriMesh& skin, const io::Landmarks& landmarks, bool left);

  /// The groove where a cut at this share of the way from wing to corner has it, from 6 mm on the
  /// side of the nose to 26 mm on the side of the cheek. The profile is smoothed by a Gaussian of 1
  /// mm. Its place is the distance outwards from the line between wing and corner. Nothing where
  /// the surface has a hole, or ends less than 20 mm outwards.
  std::optional<Groove> groove(double share) const;

  const face::FaceFrame& frame() const { return frame_; }
  Place wing() const { return wing_; }
  Place along() const { return along_; }    ///< from the wing to the corner
  Place across() const { return across_; }  ///< of unit length, outwards

 private:
  /// A triangle seen from the front, mm.
  struct Seen {
    Eigen::Matrix<double, 3, 3> corners;  ///< rows: x, y, z
    Place low, high;
    std::optional<double> height_at(const Place& at) const;
  };
  double height_at(const Place& at) const;

  face::FaceFrame frame_;
  Place wing_, along_, across_;
  std::vector<Seen> seen_;
};

}  // namespace hyperex::anatomy
