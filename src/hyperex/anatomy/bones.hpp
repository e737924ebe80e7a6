// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

enum class Bone : char { none, skull, mandible };

/// Centres of the heads of the mandible, about which the jaw turns: left, right (m).
using Condyles = std::array<Vec3, 2>;

/// A person's own bones, as surfaces in the frame of the scan (m). They need not be closed.
class Bones {
 public:
  /// Either surface may be empty. Throws std::invalid_argument if both are.
  Bones(TriMesh skull, TriMesh mandible, std::optional<Condyles> condyles = {});
  ~Bones();

  const TriMesh& skull() const;
  const TriMesh& mandible() const;
  /// Empty: not known.
  const std::optional<Condyles>& condyles() const;

  struct Place {
    Bone bone = Bone::none;
    Vec3 at = Vec3::Zero();
    double distance_m = 0;
  };
  /// The nearest place of either bone. Bone::none where there is none within `within_m`.
  Place nearest(const Vec3& p, double within_m) const;
  /// The same of one bone.
  Place nearest(Bone bone, const Vec3& p, double within_m) const;
  /// Distance from `from` along `way` (unit length) to the first bone; infinite where there is none
  /// within `within_m`.
  double along(const Vec3& from, const Vec3& way, double within_m) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The condyles of a mandible: on each side, the head is the highest part of the hindmost 20 mm.
/// `jaw_axis`: the middle between the condyles as landmarks place it. Nothing where a side has no
/// vertices, the heads are not 70 to 130 mm apart, or their middle is more than 45 mm from
/// `jaw_axis`, as of a mandible that is incomplete.
std::optional<Condyles> find_condyles(const TriMesh& mandible, const face::FaceFrame& frame,
                                      const Vec3& jaw_axis);

}  // namespace hyperex::anatomy
