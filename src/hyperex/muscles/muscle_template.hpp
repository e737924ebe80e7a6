// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hyperex::muscles {

/// A place on or under the skin of any face: the mean of landmarks, an offset, a depth.
struct TemplatePlace {
  std::vector<std::pair<int, double>>
      ibug;                      ///< iBUG-68 numbers of the left side, weights summing to 1
  double out_mm = 0, up_mm = 0;  ///< on a face whose outer eye corners are kTemplateEyes_mm apart
  double depth = -1;             ///< 0 on the skin to 1 on the bone; below 0: interpolated
};
inline constexpr double kTemplateEyes_mm = 87.4;

enum class MuscleKind {
  pull,  ///< a body force towards the origin, its reaction taken by the bone
  ring   ///< a stress along the line, both ends in the tissue
};
enum class MuscleLip { both, upper, lower };

/// One muscle of the left side; the right one mirrors it.
struct TemplateMuscle {
  std::string name, latin, group, branch;
  std::vector<TemplatePlace> path;  ///< origin first, insertion last; two or more
  double width_mm = 5;
  double band = 0;  ///< reach of its force beside the line over the width; 0: as for all muscles
  MuscleKind kind = MuscleKind::pull;
  MuscleLip lip = MuscleLip::both;
  bool jaw = false;   ///< its origin rides on the mandible
  bool tone = false;  ///< may relax below rest
};

/// Reads [[muscle]] tables (data/muscles.toml says how). Throws InputError naming `source`, the
/// muscle and what was expected.
std::vector<TemplateMuscle> read_muscles(std::string_view toml, const std::string& source);

/// The template that the program carries.
const std::vector<TemplateMuscle>& muscle_template();
/// By its name without side; null where there is none.
const TemplateMuscle* find_muscle(const std::string& name);

/// What may name a muscle of one side ("zyg_major_R"), alone or with others: itself, its branch on
/// its side ("zygomatic_R"), its side ("side_R").
std::set<std::string> names_for(const std::string& muscle);
/// The same muscle, branch or side of the other side: "side_L" -> "side_R".
std::string other_side(std::string name);
/// All of these, of the template's muscles, sorted.
std::vector<std::string> gain_names();

}  // namespace hyperex::muscles
