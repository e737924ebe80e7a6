// SPDX-License-Identifier: GPL-3.0-or-later
// The statements of the thesis, point by point, and our measurements. Verdicts and reasons follow
// from the figures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/page.hpp"

namespace hyperex::bench {
namespace {

struct Point {
  std::string claim, measured, verdict, why;
};

std::string table(const std::vector<Point>& points) {
  std::string text = "| the thesis says | we measured | does it hold? | why |\n|---|---|---|---|\n";
  for (const Point& p : points)
    text += fmt::format("| {} | {} | **{}** | {} |\n", p.claim, p.measured, p.verdict, p.why);
  return text;
}

template <class Faces, class Test>
bool all_of(const Faces& faces, const Test& test) {
  return std::all_of(faces.begin(), faces.end(), test);
}

/// One word for all faces, or one for each.
template <class Faces, class Test>
std::string verdict(const Faces& faces, const Test& test, const std::string& yes,
                    const std::string& no) {
  if (all_of(faces, test)) return yes;
  if (std::none_of(faces.begin(), faces.end(), test)) return no;
  return of_each(faces, [&](const auto& face) { return test(face) ? yes : no; });
}

const MeasuredRegion& part_of(const MeasuredWay& way, const std::string& name) {
  return *std::find_if(way.regions.begin(), way.regions.end(),
                       [&](const MeasuredRegion& r) { return r.name == name; });
}

Point scale_of_displacement(const std::vector<MeasuredFace>& faces) {
  const bool near =
      all_of(faces, [](const MeasuredFace& f) { return f.largest_mm > 13 && f.largest_mm < 52; });
  return {
      "displacement of 0 to 26 mm",
      of_each(faces, [](const MeasuredFace& f) { return fmt::format("{:.1f} mm", f.largest_mm); }),
      near ? "yes, of that size" : "no",
      near ? "a mouth opened wide; how wide is the person's choice"
           : "the mouths were not opened as wide"};
}

void add_second_scan(const MeasuredFace& face, std::vector<Point>& points) {
  const MeasuredWay &own = face.ways[0], &true_points = face.ways[1];
  const MeasuredRegion &mouth = part_of(own, "mouth"), &cheeks = part_of(own, "nose and cheeks"),
                       &rest = part_of(own, "rest of the face"),
                       &mouth_true = part_of(true_points, "mouth");
  points.push_back(
      {"about 2 mm around the mouth, against a second scan",
       fmt::format("{}: {:.2f} mm in the mean, 95 % below {:.2f}", face.name, mouth.closest.mean_mm,
                   mouth.closest.p95_mm),
       mouth.closest.mean_mm < 2 ? "yes, nearer" : "no, farther",
       fmt::format("closest points flatter: against the truth of each point it is {:.2f} mm in the "
                   "mean, {:.2f} in the median",
                   mouth.corresponding.mean_mm, mouth.corresponding.median_mm)});
  const bool over = cheeks.closest.max_mm > 10;
  points.push_back(
      {"over 10 mm in places (nose and cheeks)",
       fmt::format(
           "{}: at most {:.2f} mm there; farther than 10 mm are {:.2f} % of the mouth, {:.2f} "
           "% of the rest (at most {:.1f} mm)",
           face.name, cheeks.closest.max_mm, 100 * mouth.over_10_mm, 100 * rest.over_10_mm,
           rest.closest.max_mm),
       over                        ? "yes"
       : own.over_below_chin > 0.5 ? "not there, but below the chin"
                                   : "no",
       fmt::format("the second scan holds the very pose of the recording, where the thesis' person "
                   "had to repeat it; of what is farther than 10 mm, {:.0f} % lies below the chin, "
                   "where the tracked mesh ends",
                   100 * own.over_below_chin)});
  const double seen = cheeks.moved_mm / cheeks.truth_moved_mm;
  points.push_back(
      {"the spreading of the cheeks is real, and the tracked mesh cannot see it",
       fmt::format(
           "nose and cheeks move {:.2f} mm in truth, {:.2f} mm as tracked; against the truth "
           "{:.2f} mm are left in the mean",
           cheeks.truth_moved_mm, cheeks.moved_mm, cheeks.corresponding.mean_mm),
       std::abs(seen - 1) < 0.25 ? "no, it is seen" : "yes",
       fmt::format("{} tracked points with depth, where the thesis had 121", face.points)});
  const double fault = mouth.corresponding.max_mm / std::max(mouth_true.corresponding.max_mm, 1e-9);
  points.push_back(
      {"faults around the mouth, from wrong correspondences",
       fmt::format(
           "at the mouth 95 % of the points are within {:.1f} mm of the truth, the worst {:.1f} "
           "mm off; driven by the true 68 points {:.1f} and {:.1f} mm",
           mouth.corresponding.p95_mm, mouth.corresponding.max_mm, mouth_true.corresponding.p95_mm,
           mouth_true.corresponding.max_mm),
       fault > 2 ? "yes, here too" : "no",
       fault > 2
           ? "points between the lips are matched to the other lip and stretch across the mouth "
             "as it opens; where a driven boundary and physics take the place of the matching "
             "they do not"
           : "lips are told apart by walking on the skin and on the tracked mesh, not by what is "
             "nearest"});
}

void add_physics(const std::vector<PhysicsFace>& faces, std::vector<Point>& points) {
  const auto lag = [](const PhysicsFace& f) {
    const PhysicsRow& r = f.elements.front();
    return fmt::format("{:+.2f} ms in the median ({:+.2f} to {:+.2f})", r.lag_median_ms,
                       r.lag_least_ms, r.lag_most_ms);
  };
  constexpr double tenth_of_frame_ms = 100.0 / 30;
  const bool visible = std::any_of(faces.begin(), faces.end(), [](const PhysicsFace& f) {
    return f.elements.front().lag_most_ms > tenth_of_frame_ms;
  });
  const bool printed_alike =
      all_of(faces, [](const PhysicsFace& f) { return f.elements[1].from_base_mm < 0.1; });
  const bool locking = all_of(faces, [](const PhysicsFace& f) {
    return f.elements[2].from_base_mm > 10 * f.elements[0].behind_mm;
  });
  const PhysicsRow& thick = faces.front().viscosities.back();
  points.push_back({"the mouth opens with the input", "pictures at the five times below", "yes",
                    "it is driven"});
  points.push_back(
      {"tissue without input comes back late, because of viscosity (likely reading)",
       fmt::format("{}; behind the run without delay by at most {}", of_each(faces, lag),
                   of_each(faces,
                           [](const PhysicsFace& f) {
                             return fmt::format("{:.3f} mm", f.elements.front().behind_mm);
                           })),
       visible ? "yes" : "no: not by a tenth of a frame",
       fmt::format(
           "eta / G is {:.1f} ms, a frame 33 ms, the opening {:.1f} s; patches, bones and border "
           "hold "
           "most of the tissue without any viscosity. With {:.0f} times the viscosity the lag "
           "reaches {:.0f} ms: such a delay is not in the stated parameters",
           faces.front().relaxation_ms, faces.front().slowest_input_s,
           thick.viscosity_pa_s / faces.front().viscosity_pa_s, thick.lag_most_ms)});
  points.push_back({"(printed viscous tensor, not isotropic)",
                    of_each(faces,
                            [](const PhysicsFace& f) {
                              return fmt::format("{:.3f} mm from Stokes' law at most, over time",
                                                 f.elements[1].from_base_mm);
                            }),
                    printed_alike ? "of no weight here" : "of some weight",
                    "viscosity is of little weight as a whole at this speed"});
  points.push_back({"(plain linear tetrahedra at nu = 0.495)",
                    of_each(faces,
                            [](const PhysicsFace& f) {
                              return fmt::format(
                                  "{:.1f} mm from the element that does not lock, at most",
                                  f.elements[2].from_base_mm);
                            }),
                    locking ? "of far more weight than viscosity" : "of little weight",
                    "they lock; but displacements are prescribed at the mouth, so what differs is "
                    "how they spread"});
}

/// Mean of the spread in the window divided by its mean over the whole time.
double in_window(const ModelsFace& f) {
  return f.rows.front().share_in_window * f.end_s / (kSourceWindow_s[1] - kSourceWindow_s[0]);
}

const SpreadRow& row_of(const ModelsFace& f, const std::string& condition) {
  return *std::find_if(f.rows.begin(), f.rows.end(),
                       [&](const SpreadRow& r) { return r.condition == condition; });
}

void add_maps(const std::vector<ModelsFace>& faces, std::vector<Point>& points) {
  const auto pair_text = [](const ModelsFace& f, const auto& text) {
    return fmt::format("{} (models 1 and 2), {} (1 and 3)", text(f.pairs[0]), text(f.pairs[1]));
  };
  const bool alike = all_of(faces, [](const ModelsFace& f) { return f.pairs[1].largest_mm < 1; });
  points.push_back({"the shapes at 1.3 s look alike",
                    of_each(faces,
                            [&](const ModelsFace& f) {
                              return pair_text(f, [](const ModelPair& p) {
                                return fmt::format("{:.3f} mm", p.largest_mm);
                              });
                            }) +
                        " apart at most",
                    alike ? "yes" : "no",
                    "the motion is given at the mouth; the tissue only decides how it spreads "
                    "between the points"});
  const bool near = all_of(faces, [](const ModelsFace& f) {
    return f.pairs[0].share_near_cphs > 0.5 && f.pairs[1].share_near_cphs > 0.5;
  });
  points.push_back(
      {"differences around the mouth and upper lip (likely reading)",
       of_each(faces,
               [&](const ModelsFace& f) {
                 return pair_text(f, [](const ModelPair& p) {
                   return fmt::format("{:.0f} %", 100 * p.share_near_cphs);
                 });
               }) +
           " of the summed squared distance within 25 mm of the right cphs",
       near ? "yes" : "no",
       near ? "the tissue differs nowhere else, and a layer on bone carries it no farther"
            : "see the maps"});
  const bool less = all_of(faces, [](const ModelsFace& f) {
    return f.pairs[0].change_mm < 0 && f.pairs[1].change_mm > 0;
  });
  points.push_back(
      {"(the stiffer side moves less, or later)",
       of_each(faces,
               [](const ModelsFace& f) {
                 return fmt::format(
                     "{:+.4f} mm where stiffer, {:+.4f} mm where softer, of {:.2f} mm; "
                     "{:+.2f} and {:+.2f} ms",
                     f.pairs[0].change_mm, f.pairs[1].change_mm, f.pairs[0].moved_mm,
                     f.pairs[0].lag_ms, f.pairs[1].lag_ms);
               }),
       fmt::format(
           "{}; {}", less ? "less: yes" : "less: not everywhere",
           verdict(
               faces,
               [](const ModelsFace& f) { return f.pairs[0].lag_ms > 0 && f.pairs[1].lag_ms < 0; },
               "later: by milliseconds at most", "not later")),
       "stiff tissue is stretched less by the driven lip; times are those of the shape, which "
       "changes "
       "with the opening, not of a delay"});
}

/// The longest time by which a landmark of experiment 2 lags or leads its input, ms.
double longest_lag_ms(const std::vector<PhysicsFace>& faces) {
  double most = 0;
  for (const PhysicsFace& f : faces)
    most = std::max({most, std::abs(f.elements.front().lag_least_ms),
                     std::abs(f.elements.front().lag_most_ms)});
  return most;
}

void add_curves(const std::vector<ModelsFace>& faces, double lag_ms, std::vector<Point>& points) {
  points.push_back({"S(t) between -10 and -4",
                    of_each(faces,
                            [](const ModelsFace& f) {
                              return fmt::format("{:.1f} to {:.1f} from 0.1 s on", f.s_least,
                                                 f.s_most);
                            }),
                    of_each(faces,
                            [](const ModelsFace& f) {
                              const bool lower = f.s_least <= -10, higher = f.s_most >= -4;
                              if (lower && higher) return "no, lower and higher";
                              if (lower || higher)
                                return lower ? "in part, else lower" : "in part, else higher";
                              return by_mesh(f.meshes) ? "yes, by chance of its mesh" : "yes";
                            }),
                    "where S lies is the asymmetry of the face, of its motion and of its mesh, not "
                    "of the tissue: see D_1 below; a tracked person's lies higher, at the noise "
                    "floor of the tracking"});
  points.push_back(
      {"S(t) of the three differ",
       of_each(faces,
               [](const ModelsFace& f) {
                 return fmt::format("by {:.2f} at most (a factor of {:.2f})", f.rows[0].spread,
                                    std::exp(f.rows[0].spread));
               }),
       all_of(faces, [](const ModelsFace& f) { return f.rows[0].spread > 0.01; }) ? "yes"
                                                                                  : "hardly",
       "the sides differ by what the tissue adds to or takes from their own asymmetry"});
  const auto held = [](const ModelsFace& f) { return in_window(f) > 1.25; };
  std::string why;
  for (const ModelsFace& f : faces) {
    if (!why.empty()) why += "; ";
    why += f.name;
    why += !held(f)
               ? " all along alike: D grows in proportion, and a ratio is the same at any opening"
           : std::abs(f.rows[0].spread_at_s - f.own_least_s) < 0.015
               ? fmt::format(
                     " where the own difference xi_L - xi_R of model 1 is least ({:.2f} s): a "
                     "logarithm makes much of little near zero",
                     f.own_least_s)
               : " there";
  }
  points.push_back(
      {"they part most between about 0.25 and 0.6 s",
       of_each(faces,
               [](const ModelsFace& f) {
                 return fmt::format(
                     "most at {:.2f} s (with E alone at {:.2f} s); in that window, {:.0f} % of the "
                     "time, {:.0f} % of the spread; the size of D_2 - D_3 itself is greatest at "
                     "{:.2f} s",
                     f.rows[0].spread_at_s, row_of(f, "E alone differs").spread_at_s,
                     100 * (kSourceWindow_s[1] - kSourceWindow_s[0]) / f.end_s,
                     100 * f.rows[0].share_in_window, f.parted_most_s);
               }),
       verdict(faces, held, "yes", "no, all along"), why});
  const auto by_eta = [](const ModelsFace& f) {
    return std::abs(row_of(f, "eta alone differs").tissue_2 / f.rows[0].tissue_2);
  };
  const auto by_young = [](const ModelsFace& f) {
    return std::abs(row_of(f, "E alone differs").tissue_2 / f.rows[0].tissue_2);
  };
  const bool stiffness =
      all_of(faces, [&](const ModelsFace& f) { return by_eta(f) < 0.1 && by_young(f) > 0.9; });
  points.push_back(
      {"put down to viscosity",
       of_each(faces,
               [&](const ModelsFace& f) {
                 return fmt::format(
                     "with E alone {:.1f} % of D_2 - D_1, with eta alone {:.2f} %; with a "
                     "hundredth of viscosity and mass S changes by {:.3f} at most",
                     100 * by_young(f), 100 * by_eta(f), f.at_once_change);
               }),
       stiffness ? "no: stiffness parts the curves" : "in part",
       fmt::format(
           "the response follows its input to within {:.1f} ms (experiment 2), so what shows is "
           "the ratio of stiffnesses; for both viscous tensors and both elements see the table "
           "below",
           lag_ms)});
  points.push_back(
      {"tissue parameters could be estimated from S(t)",
       of_each(faces,
               [](const ModelsFace& f) {
                 return fmt::format(
                     "models 2 and 3, {:.0f} and {:.0f} kPa, are told apart if points are "
                     "known to {:.1f} um",
                     1e-3 * f.pairs[0].young_change_pa, 1e-3 * f.pairs[1].young_change_pa,
                     1e3 * f.jitter_to_tell_mm);
               }),
       all_of(faces, [](const ModelsFace& f) { return f.jitter_to_tell_mm > 0.05; })
           ? "perhaps"
           : "not from such measurements",
       "one run against another on the same mesh: yes. In recordings jitter is a tenth of a "
       "millimetre and more" +
           std::string(all_of(faces, [](const ModelsFace& f) { return tissue_stays(f.meshes); })
                           ? ""
                           : ", and another mesh changes what the tissue adds: see below")});
}

/// The answers in brief, from the same figures.
std::string in_short(const Experiments& all) {
  std::string text = "**In short.** ";
  for (const MeasuredFace& face : all.measured)
    if (!face.ways.empty())
      text += fmt::format(
          "Measured deformation lies {:.1f} mm from a second scan around the mouth, where the "
          "thesis "
          "reports about 2. ",
          part_of(face.ways[0], "mouth").closest.mean_mm);
  text += fmt::format(
      "With the thesis' parameters viscosity shifts the tissue by {:.1f} ms at most, of a frame's "
      "33. ",
      longest_lag_ms(all.physics));
  double share = 1, eta = 0;
  for (const ModelsFace& f : all.models) {
    for (const ModelPair& p : f.pairs) share = std::min(share, p.share_near_cphs);
    eta = std::max(eta, std::abs(row_of(f, "eta alone differs").tissue_2 / f.rows[0].tissue_2));
  }
  text += fmt::format(
      "Of the differences between the motions of the three tissues, at least {:.0f} % lie within "
      "25 mm of the point where the tissues differ. The difference in viscosity alone makes "
      "{:.1f} % of the change in xi_L - xi_R that S(t) measures; the rest is stiffness.\n\n",
      100 * share, 100 * eta);
  return text;
}

}  // namespace

std::string point_by_point(const Experiments& all) {
  std::vector<Point> first = {scale_of_displacement(all.measured)}, second, third;
  for (const MeasuredFace& face : all.measured)
    if (!face.ways.empty()) add_second_scan(face, first);
  add_physics(all.physics, second);
  add_maps(all.models, third);
  add_curves(all.models, longest_lag_ms(all.physics), third);
  return in_short(all) +
         "## Point by point\nIn brackets: what the thesis does not report, and one would ask.\n\n"
         "**Experiment 1, measured deformation**\n\n" +
         table(first) + "\n**Experiment 2, mouth opening by physics**\n\n" + table(second) +
         "\n**Experiment 3, three tissues**\n\n" + table(third);
}

}  // namespace hyperex::bench
