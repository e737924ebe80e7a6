// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/muscles/muscle_template.hpp"

namespace hyperex::muscles {

/// The muscles that a wrong name in a gain ("zygomaticus_R", "frontalis medial part_L") may mean:
/// those on its side whose Latin name contains all of its words. Empty where the name has no side
/// or no muscle matches.
std::vector<std::string> muscles_called(const std::string& name,
                                        const MuscleTable& among = muscle_template());

/// What a wrong name in a gain may mean, best first. "right" means the whole side, "zygomatic" the
/// branch of the nerve on both sides, "zygomaticus_R" the muscles of that name. Empty where nothing
/// matches.
std::vector<std::string> gains_meant(const std::string& name,
                                     const MuscleTable& among = muscle_template());

/// "another name; did you mean side_R?"; for a name that resembles none, the list of sides and
/// branches.
std::string gain_expected(const std::string& name, const MuscleTable& among = muscle_template());

}  // namespace hyperex::muscles
