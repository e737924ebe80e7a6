// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::metrics {

/// How far a point would go if it were fixed to the jaw: the greatest distance over time (mm)
/// between its place in the first sample and where the jaw alone carries that place. It says how
/// much of a point's motion the jaw can explain; soft tissue follows the jaw only in part.
/// `jaw_now_from_rest`: one pose per sample of `motion` (simulate::Performance). NaN if the point
/// is unknown, or if there are no poses.
double with_jaw_mm(const std::vector<Eigen::Isometry3d>& jaw_now_from_rest,
                   const motion::Motion& motion, int column);

/// The same poses without what slides: each only turns about `joint` (m, at rest; the middle
/// between both condyles), which stays where the first pose puts it. Poses are fitted to points of
/// the chin, and skin that is drawn over the chin makes the joints of the fit slide.
std::vector<Eigen::Isometry3d> turned_about(std::vector<Eigen::Isometry3d> jaw_now_from_rest,
                                            const Vec3& joint);

}  // namespace hyperex::metrics
