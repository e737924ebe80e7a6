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
  double out_mm = 0, up_mm = 0;  ///< on a face with its outer eye corners kTemplateEyes_mm apart
  double depth = -1;             ///< 0 on the skin to 1 on the bone; below 0: interpolated
  bool operator==(const TemplatePlace&) const = default;
};
inline constexpr double kTemplateEyes_mm = 87.4;

enum class MuscleKind {
  pull,  ///< a body force towards the origin; the bone carries the reaction
  ring   ///< a stress along the line, both ends in the tissue
};
enum class MuscleLip { both, upper, lower };

/// One muscle of the left side; the muscle of the right side is its mirror image.
struct TemplateMuscle {
  std::string name, latin, group, branch;
  std::vector<TemplatePlace> path;  ///< origin first, insertion last; two or more
  double width_mm = 5;
  double band = 0;  ///< as ForceShape::band; 0: the value for all muscles
  double ramp = 0;  ///< as ForceShape::ramp; 0: the value for all muscles
  MuscleKind kind = MuscleKind::pull;
  MuscleLip lip = MuscleLip::both;
  bool straight = false;  ///< runs straight between its places, not along the skin
  bool jaw = false;       ///< begins on the mandible, on which it is laid where its shape is known
  bool tone = false;      ///< its activation may fall below that at rest
  bool cheek = false;     ///< it moves the cheek as much as the lips: an elevator or a retractor
  double readiness = 1;   ///< prior sigma of its activation, relative to that of other muscles
  double yields = 0;      ///< readiness is divided by 1 + yields x opening of the jaw (rad)
  /// Near driven points the skin's shape is a mixture: this share of the shape that the muscle's
  /// force gives, and the rest of the field interpolated between the points. One share for few
  /// points, one for many; below 0: the value for all muscles of its kind.
  double few_share = -1, many_share = -1;
  /// The part of the fold from nose (0) to mouth (1) along which the muscle ends in the skin; both
  /// 0: none. There it also pulls the skin (fold_pull()), with a total force of `fold_strength`
  /// times that of its other pull.
  double fold_from = 0, fold_to = 0, fold_strength = 0.1;
  bool ends_in_fold() const { return fold_to > fold_from; }
  /// Prior correlations of its activation with that of other muscles of its side.
  std::vector<std::pair<std::string, double>> together = {};
  bool operator==(const TemplateMuscle&) const = default;
};
using MuscleTable = std::vector<TemplateMuscle>;

/// Reads tables [[muscle]]; data/muscles.toml describes the format. Throws InputError naming
/// `source`, the muscle and what was expected.
MuscleTable read_muscles(std::string_view toml, const std::string& source);

/// The template built into the program.
const MuscleTable& muscle_template();
/// The muscle of that name (without side), or null.
const TemplateMuscle* find_muscle(const std::string& name,
                                  const MuscleTable& among = muscle_template());
/// `table` with these changes: a muscle that `own` has too is replaced by that of `own`, the other
/// muscles of `own` are appended, and those named in `without` are removed.
MuscleTable changed_table(MuscleTable table, const MuscleTable& own,
                          const std::vector<std::string>& without);

/// The names whose gains act on a muscle of one side ("zyg_major_R"): its own, its branch on that
/// side ("zygomatic_R"), and the side ("side_R").
std::set<std::string> names_for(const std::string& muscle,
                                const MuscleTable& among = muscle_template());
/// The corresponding muscle, branch or side on the other side: "side_L" -> "side_R".
std::string other_side(std::string name);
/// The names of all muscles, branches and sides of a table, sorted.
std::vector<std::string> gain_names(const MuscleTable& among = muscle_template());

}  // namespace hyperex::muscles
