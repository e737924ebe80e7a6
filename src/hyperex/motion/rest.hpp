// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// A stretch of a motion in which the face is at rest, in seconds from the first sample. If both
/// times are equal, it is the sample nearest to that time.
struct RestStretch {
  double from_s = 0, to_s = 0;
};

/// A motion whose first sample shows the face at rest, as all later steps require. The positions at
/// rest are the means over the stretch, of the samples in which the point is measured. If every
/// point of the first sample is within 1 mm of its position at rest, the positions at rest replace
/// the first sample. Otherwise a transition of length `lead_s` from rest to the first sample is put
/// before it, along a minimum-jerk course (10 u^3 - 15 u^4 + 6 u^5): a face that was pulled at once
/// into the middle of an expression would oscillate. `motion`: without head pose (stabilise).
struct RestedMotion {
  Motion motion;
  double lead_s = 0;  ///< how much earlier the motion now starts; 0 where nothing was put before it
};
inline constexpr double rest_lead_s = 0.5;
/// How far that course has gone, 0 to 1, at the share `u` (0 to 1) of its length.
double lead_course(double u);
/// `start_s`: the samples before that time, counted from the first sample, are left out. Throws
/// InputError where the stretch lies outside the motion, a point is never measured in it, or fewer
/// than two samples are left.
RestedMotion with_rest(const Motion& motion, const RestStretch& stretch, double start_s = 0);

/// A stretch of the motion that is nearer to the face at rest than its first sample.
struct StartedInExpression {
  RestStretch stretch;    ///< in seconds from the first sample
  std::string point;      ///< the point farthest at the start from its position in that stretch
  double distance_m = 0;  ///< that distance, in the unit of `at_rest`
};

/// Whether a motion begins in the middle of an expression. `at_rest`: the same points, by name, of
/// the person at rest in any position and size (the landmarks of the scan). Shapes are compared
/// after a similarity transform. Among all stretches of 0.3 s, the one whose shape is nearest to
/// rest is chosen. The motion starts in an expression if two conditions hold between its first
/// sample (the mean of the first 0.1 s) and that stretch. First, some point moves by
/// `least_moved_m` or more. Second, the projection of the shape at rest on the line from the start
/// to the stretch lies nearer to the stretch: s = (start - rest) . (start - stretch) / |start -
/// stretch|^2 > 0.65. A difference between the points of the scan and those of the recording
/// affects both shapes alike; it changes s only by its component along that line. Nothing for fewer
/// than five common points, a motion shorter than two stretches, or points on a line.
std::optional<StartedInExpression> started_in_expression(const Motion& motion,
                                                         const io::Landmarks& at_rest,
                                                         double least_moved_m = 3e-3);

/// The end of a motion that breaks off in the middle of an expression.
struct EndedInExpression {
  std::string point;        ///< the point that goes farthest from its place in the first sample
  double distance_m = 0;    ///< how far it goes
  double before_end_s = 0;  ///< when, before the last sample: 0 to 0.1 s
};

/// Whether a motion ends in the middle of an expression: its farthest point is 2 mm or more from
/// its place in the first sample, this is so in the last 0.1 s, and the point is still on its way.
/// It is on its way if its mean distance over the last 0.1 s exceeds that over the 0.1 s which end
/// 0.2 s earlier by more than 0.3 of the farthest distance. An expression that is held for 0.3 s at
/// its peak is complete. Measured: 0.10 in a real smile that ends at its peak, 0.20 in ramps of a
/// rig that go evenly to their peak within a second, 0.5 in a smile that breaks off at a third of
/// its way. A slow or nearly finished expression cannot be distinguished from a complete one.
/// `motion`: without head pose, the first sample at rest. Nothing for a motion shorter than 0.6 s
/// or with samples more than 0.1 s apart (median).
std::optional<EndedInExpression> ended_in_expression(const Motion& motion);

}  // namespace hyperex::motion
