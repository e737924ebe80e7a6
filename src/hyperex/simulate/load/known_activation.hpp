// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How far a recording determines a muscle's activation, and how far the prior does.
#include <string>

#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// Whether the recording distinguishes an activation from 0: its 95 % interval leaves 0 out.
/// `sigma`: its standard deviation, as MuscleCourse::sigma. False where one is not a number.
bool differs_from_zero(double activation, double sigma);

/// The share of the variance of an activation that the recording determines, 0 to 1:
///   1 - (sigma / prior_sigma)^2
/// `prior_sigma`: its standard deviation before a point is seen. Not a number where that is 0.
double determined_share(double sigma, double prior_sigma);

/// Of an activation that is mostly the prior's choice, the recording determines a smaller share:
/// the standard deviation is still more than 0.82 of that before a point is seen.
inline constexpr double kLeastDetermined = 1.0 / 3;
inline constexpr const char* kMostlyPriorWords = "mostly the prior's choice";

/// kMostlyPriorWords where that is so for a muscle in a sample, else empty. Empty too where its
/// prior is not known or leaves no choice, as for a gain of 0.
std::string muscle_words(const MuscleCourse& course, Eigen::Index muscle, Eigen::Index sample);
/// The same of one of MuscleCourse::groups, and its determined_share(): not a number where its
/// prior is not known.
std::string group_words(const MuscleCourse& course, Eigen::Index group, Eigen::Index sample);
double group_share(const MuscleCourse& course, Eigen::Index group, Eigen::Index sample);

}  // namespace hyperex::simulate
