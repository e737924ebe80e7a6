// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::motion {

/// Points that keep still against each other over the whole recording, as points fixed to the skull
/// do: the largest set whose points move by at most kStillPoints_m beyond their own jitter
/// (largest_rigid_set()), in the motion's order. Points of the mouth and the chin
/// (face::moves_with_mouth()) are left out, since the lower lip and the chin also move together.
/// Candidates may have gaps that a run fills by default (GapOptions::max_gap_s), as far as half of
/// the samples have them all (hardly_interrupted()), and the points found must give a pose in every
/// sample. Where that finds none, candidates without gaps are judged alone. Empty where fewer than
/// four points are found, or where they lie nearly on a line.
std::vector<std::string> find_still_points(const Motion& motion);
/// The same of several recordings of one face, not null: points that all of them have and that keep
/// still in each. How far they are apart may differ between the recordings. They may have
/// different names of one place (face::place_name) there; those of the first are returned.
std::vector<std::string> find_still_points(const std::vector<const Motion*>& motions);

/// What a motion calls these points, in their order: its name of the same place (face::place_name)
/// where it lacks the name itself. Points that it does not have keep their name.
std::vector<std::string> own_names(const Motion& motion, const std::vector<std::string>& points);

/// Allows for the motion of a marker glued to the skin over bone.
inline constexpr double kStillPoints_m = 1e-3;

/// Whether a motion has enough of the usual points of the skull (default_rigid_points) to estimate
/// the head pose.
bool has_pose_points(const Motion& motion);

/// A point that does not keep still against others, and how far it moves.
struct UnsteadyPoint {
  std::string name;
  double change_m = 0;
};

/// Those of `names` that move against the others, in that order; names that the motion lacks are
/// left out. The change of a distance is that from the first sample which 95 % of the samples do
/// not exceed, with points smoothed by a running median against noise. Points are taken out one by
/// one until no distance changes by more than `allowed_m`: each time the one with most such
/// distances. Where fewer than two are left, none can be trusted, and all with such a distance are
/// returned.
std::vector<UnsteadyPoint> unsteady_points(const Motion& motion,
                                           const std::vector<std::string>& names, double allowed_m);

/// The points to name as moving with the skull where has_pose_points() is false:
/// find_still_points().
std::vector<std::string> proposed_rigid_points(const Motion& motion);
/// One set for several recordings of one face, so that their poses have the same meaning: that of
/// find_still_points(), where has_pose_points() is false for one of them.
std::vector<std::string> proposed_rigid_points(const std::vector<const Motion*>& motions);

/// Points of the skull that a pose by the landmarks of the face leaves unused: markers of a band,
/// of the ears, of the upper teeth. `steady`: of stabilise() without given points. Candidates have
/// short gaps alone, as for find_still_points(), and names that are not those of landmarks. All of
/// this holds:
///  * They move against each other by at most 0.2 mm beyond what their jitter explains
///    (largest_rigid_set()). Skin over bone moves more: on a speaker's forehead 0.6 to 1.2 mm.
///  * They are at least half of the candidates, or six; and four, or three of three.
///  * They do not lie nearly on a line, and two are at least 50 mm apart.
///  * Some point of the face moves by more than 3 mm.
///  * By the landmarks they stay, too: root mean square displacement within the 95 % bound of the
///    landmarks' pose and their jitter, and kStillPoints_m, in 95 % of the samples. Points of the
///    lower teeth do not.
/// In the motion's order; else empty, as where `steady` has no poses.
std::vector<std::string> still_points_beside_landmarks(const StabilisedMotion& steady);

/// Points that keep still against each other, and those of the same kind that do not: no landmarks
/// of the face. `left_out` is empty where `names` is.
struct StillPoints {
  std::vector<std::string> names;
  std::vector<UnsteadyPoint> left_out;  ///< with their movement against the others
  /// Landmarks of the face would give a pose in every recording, too.
  bool beside_landmarks = false;
  /// Where `names` is empty: stabilise() by the landmarks, of the first recordings in their order,
  /// as far as the search has come. It need not be computed again.
  std::vector<StabilisedMotion> by_landmarks = {};
};

/// The points that hold the head's pose where the user names none: those of
/// still_points_beside_landmarks(), or where landmarks of the face give no pose
/// (has_pose_points()), those of find_still_points(). Of several recordings of one face, not null,
/// one set for all, by the first one's names: points that are still in each. Empty: none are found;
/// then the landmarks hold it.
StillPoints points_to_hold_the_head(const Motion& motion);
StillPoints points_to_hold_the_head(const std::vector<const Motion*>& motions);

}  // namespace hyperex::motion
