// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/nose_cartilage.hpp"
#include "hyperex/simulate/drive/support.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// Where a segment of bone is cut, and about what it turns; in the frame of the landmarks, m.
struct BoneSegment {
  BonePart part;
  BoneCut cut;
  Vec3 turns_about;
  /// Plane of the cut: a place on it, and its normal towards the segment. Zero: no cut.
  Vec3 plane_at = Vec3::Zero(), plane_normal = Vec3::Zero();
  double half_width_m = 0;           ///< greatest distance from the middle; 0: unlimited
  std::optional<Vec3> ends_at = {};  ///< the segment lies in front of this place
};

/// The segment of each part with its usual cut. Planes and centres are those of Osteotomies.
/// `bones`: null where none are known.
std::vector<BoneSegment> usual_segments(const io::Landmarks& landmarks,
                                        const anatomy::Bones* bones);

/// How segments of bone move, by the planes of the standard osteotomies. In the frame of the face:
///  * le_fort_1: horizontal, 6 mm above the base of the nose (ibug68_33), as the cut runs through
///    the rim of the piriform aperture below the inferior turbinate; the maxilla lies below it, in
///    front of the pterygoid plates, half-way from the condyles to the base of the nose;
///  * bsso (bilateral sagittal split): frontal, half-way between the condyles and the chin
///    (ibug68_8), as its outer cut runs behind the second molar; the segment lies in front of it;
///  * genioplasty: horizontal, at 0.45 of the height from chin to lower lip (ibug68_57), as the cut
///    runs below the mental foramina; the segment lies below it, within 27 mm of the middle.
/// Planes after Bloomquist and Krishnan in Peterson's Principles of Oral and Maxillofacial Surgery
/// (Springer 2022), ch. 62 and 63.
///
/// A segment turns about: the middle between the condyles (skull; a whole mandible), the base of
/// the nose (maxilla), the inner edge of the lower lip ibug68_66 (mandible in front of a bsso), the
/// chin ibug68_8 (chin).
class Osteotomies {
 public:
  /// `bones`: null where none are known.
  Osteotomies(const std::vector<BoneMove>& moves, const io::Landmarks& landmarks,
              const anatomy::Bones* bones = nullptr);

  /// The motion (now from rest) of a place on a bone: of all moves that hold it, in turn.
  /// `bone`: skull or mandible.
  Eigen::Isometry3d motion(Bone bone, const Vec3& at) const;
  /// The displacement of a place on the skull or, above the maxilla, on the cartilage of the nose.
  /// The septum stands on the maxilla and ends at the nasal bones. It bends as a beam that is
  /// clamped there, at the middle of the bridge (ibug68_28 and 29), and moved by the maxilla at the
  /// plane of the cut: (3 s^2 - s^3) / 2 of that motion along the plane, s the share of the way.
  /// Across the plane it does not follow, as surgeons shorten it by as much. Aside it moves less,
  /// linearly, down to nothing at the wings of the nose (ibug68_31 and 35).
  Vec3 displacement_of_skull(const Vec3& at) const;
  /// The motion of the skull above all cuts, of the upper teeth, and of the lower ones.
  Eigen::Isometry3d cranium() const;
  Eigen::Isometry3d upper_teeth() const;
  Eigen::Isometry3d lower_teeth() const;

 private:
  struct Move {
    BoneSegment segment;
    Eigen::Isometry3d motion;
  };
  bool holds(const BoneSegment& segment, Bone bone, const Vec3& at) const;
  template <class Holds>
  Eigen::Isometry3d product(const Holds& holds) const;

  face::FaceFrame frame_;
  NoseCartilage nose_;
  std::vector<Move> moves_;
};

/// Displacements between bones: those of the bones about a place, weighted by the squares of their
/// inverse distances.
class BonesAbout {
 public:
  /// `bones`: of each place (m), as bones_under() of the inner nodes.
  BonesAbout(const Osteotomies& cuts, const std::vector<Bone>& bones, const Points& places);
  Vec3 displacement(const Vec3& at) const;

 private:
  struct Group {
    Eigen::Isometry3d motion;
    std::vector<Vec3> places;
  };
  std::vector<Group> groups_;
};

}  // namespace hyperex::simulate
