// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/motion/stays.hpp"

namespace hyperex::motion {

// Readings of a point at a wrong place for a short time: the tracker took another spot for it, or
// exchanged the names of two points.

struct BriefStay {
  Eigen::Index point = 0;  ///< its row
  Stay stay;               ///< of its path, in metres
};

/// The least jump of a brief stay, m.
inline constexpr double kStayJump_m = 0.005;

/// The stays (stays.hpp) in the paths of points, in the order of the points, then of time. Beyond
/// what makes a stay,
/// - the readings of each jump are at most 1 / 23.5 s apart,
/// - the step is eight times as long as the point usually bends its path,
/// - none of the four points beside it makes a third of the step at either time.
/// A stay of a single sample is only found where two points beside each other exchange their
/// places: each comes to lie within a third of the step of the other's place before, and back.
/// Eyelids really move that fast, so of their points only exchanges are found. `names`: one per
/// point; eyelids are recognised by them. `at`: without the shift of the head (m).
///
/// Measured: no stay is found in the recordings at hand. These are 41 markers at 60 Hz and 30 Hz, a
/// phone's take of 4,030 samples on 68, 26, 11 and 7 points, talks and smiles. Nor with 3 mm and
/// twice in place of 5 mm and three times, nor with noise of 1 mm. Of stays of 2 to 8 samples put
/// in at random, with noise of 0.3 mm, 89 % are found at 6 mm, 94 % at 10, 98 % at 15 and 99 %
/// at 20. Of exchanges of neighbours for 1 to 8 samples it is 97 %. Most that are missed begin or
/// end in a fast movement.
std::vector<BriefStay> brief_stays(const std::vector<Points>& at, const std::vector<double>& time_s,
                                   const std::vector<std::string>& names);

/// Whether a point is of an eyelid, by its name. A lid closes and opens within 0.2 s, by up to 12
/// mm.
bool is_of_lid(const std::string& name);

/// The path of a point of `at`, which must outlive it.
Path path_of(const std::vector<Points>& at, Eigen::Index point);

}  // namespace hyperex::motion
