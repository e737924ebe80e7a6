// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/sample/bumps.hpp"
#include "hyperex/tracking/fit/score.hpp"

namespace hyperex::sample {

/// The state of a face at one moment; each value is a share of its peak.
struct Pose {
  double jaw_open = 0;
  double smile = 0;  ///< of the right side alone
};

/// A face that can open its jaw and smile on one side, in the head's frame: x to the subject's
/// left, y up, z forward, metres.
///
/// Its motion is not that of the tracker's model. The jaw turns about an axis through the condyles,
/// a tenth of the face's width inwards from the outline beside the ears (as in
/// motion/embedded_motion.hpp). The share by which a vertex follows the jaw is a smooth step of its
/// depth below the line of the lips. The step is sharp between the lips and widens from their
/// corners to the ears. The smile is a sum of bumps (bumps.hpp).
class Person {
 public:
  static constexpr double kJawPeak_deg = 12;
  /// Displacement of the corner of the mouth in a smile: outwards, up and back.
  static inline const Vec3 kSmile_mm = Vec3(-6, 8, -4);

  /// `face`: has the vertices of anatomy::embedded_face(), which may have been moved.
  explicit Person(const anatomy::EmbeddedFace& face);

  /// The skin's vertices and all 68 landmarks.
  Points skin(const Pose& pose) const { return skin_.at(pose, condyle_); }
  tracking::Points68 landmarks(const Pose& pose) const { return landmarks_.at(pose, condyle_); }
  const Triangles& triangles() const { return triangles_; }
  const render::VertexColours& colours() const { return colours_; }

  /// The other visible parts, in the head's frame: eyeballs, and pockets behind the openings of a
  /// skin.
  struct Part {
    TriMesh mesh;
    render::VertexColours colours;
  };
  std::vector<Part> behind(const Points& skin) const;

 private:
  /// Points and their displacements.
  struct Moving {
    Points rest, smile;         // m; the smile at its peak
    Eigen::VectorXd jaw_share;  // 0 to 1
    Points at(const Pose& pose, const Vec3& condyle) const;
  };
  Moving moving(const Points& rest, const io::Landmarks& landmarks) const;
  /// How far a point follows the jaw, from its position at rest.
  double jaw_share(const Vec3& p) const;

  std::vector<Vec3> lip_line_;  // from corner to corner, x rising
  Vec3 condyle_;                // the jaw's axis is along x
  Moving skin_, landmarks_;
  Triangles triangles_;
  render::VertexColours colours_;
  report::FaceBacking backing_;
};

}  // namespace hyperex::sample
