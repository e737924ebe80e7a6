// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// A closed surface, represented by the signed distance to it: teeth, eyeballs and other obstacles
/// of the skin.
class SignedDistance {
 public:
  virtual ~SignedDistance() = default;
  /// The signed distance (m) of `place`, negative inside. `outward`: the gradient there, of length
  /// 1 or nearly 1. It must be continuously differentiable near the surface. May be called from
  /// several threads; allocates nothing.
  virtual double at(const Vec3& place, Vec3& outward) const = 0;
};

/// A ball.
class SphereDistance final : public SignedDistance {
 public:
  SphereDistance(const Vec3& centre, double radius_m) : centre_(centre), radius_m_(radius_m) {}
  double at(const Vec3& place, Vec3& outward) const override {
    const Vec3 from = place - centre_;
    const double length = from.norm();
    outward = length > 0 ? Vec3(from / length) : Vec3::UnitZ();
    return length - radius_m_;
  }

 private:
  Vec3 centre_;
  double radius_m_;
};

}  // namespace hyperex
