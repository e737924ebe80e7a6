// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// A stretch of a motion in which the face is at rest, seconds from the first sample; the same time
/// twice: the sample nearest to it.
struct RestStretch {
  double from_s = 0, to_s = 0;
};

/// A motion whose first sample shows the face at rest, as everything after this expects: positions
/// at rest are the means over the stretch (of the samples in it that are measured). Where the first
/// sample is within 1 mm of them at every point, they take its place. Otherwise the motion is led
/// from rest to its first sample within `lead_s` by a minimum-jerk course (10 u^3 - 15 u^4 + 6
/// u^5), put before it: a face that is pulled into the middle of an expression at once would swing.
/// `motion`: head pose taken out (stabilise).
struct RestedMotion {
  Motion motion;
  double lead_s = 0;  ///< by how much it now starts earlier; 0 where nothing was put before it
};
inline constexpr double rest_lead_s = 0.5;
/// `start_s`: samples before that time, from the first one, are left out. Throws InputError where
/// the stretch lies outside the motion, a point is never measured in it, or fewer than two samples
/// are left.
RestedMotion with_rest(const Motion& motion, const RestStretch& stretch, double start_s = 0);

/// A stretch of the motion that is nearer to the face at rest than its first sample.
struct StartedInExpression {
  RestStretch stretch;  ///< s from the first sample
  std::string point;    ///< whose distance from its place in that stretch is greatest at the start
  double distance_m = 0;  ///< that distance, in the lengths of `at_rest`
};

/// Whether a motion begins in the middle of an expression. `at_rest`: the same points, by name, of
/// the person at rest in any position and size (the landmarks of the scan). Shapes are compared
/// after a similarity. Of all stretches of 0.3 s the one nearest to rest is taken; the motion
/// starts in an expression where between its first sample (the mean of the first 0.1 s) and that
/// stretch some point moves `least_moved_m` or more, and rest lies nearer to the stretch on the
/// line between both shapes: s = (start - rest) . (start - stretch) / |start - stretch|^2 > 0.65.
/// That the scan's points are not quite the recording's shifts both alike, and s by its part along
/// the line alone. Nothing for fewer than five common points, a motion shorter than two stretches,
/// or points on a line.
std::optional<StartedInExpression> started_in_expression(const Motion& motion,
                                                         const io::Landmarks& at_rest,
                                                         double least_moved_m = 3e-3);

}  // namespace hyperex::motion
