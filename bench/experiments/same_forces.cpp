// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/same_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/page.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/metrics/variant_difference.hpp"

namespace hyperex::bench {
namespace {

double greatest(const std::vector<double>& values) {
  const int at = metrics::greatest_sample(values);
  return at < 0 ? std::nan("") : values[std::size_t(at)];
}

/// Jitter of the landmarks above which models 2 and 3 cannot be distinguished in any sample.
double jitter_to_tell_mm(const motion::Motion& landmarks, const std::vector<double>& parted) {
  constexpr double trial_m = 1e-4;
  const std::vector<double> noise = metrics::symmetry_noise(landmarks, trial_m);
  double most = 0;
  for (std::size_t k = 0; k < noise.size(); ++k)
    if (std::isfinite(parted[k]))
      most = std::max(most, 1e3 * trial_m * std::abs(parted[k]) / noise[k]);
  return most;
}

DrivenWay driven(const std::filesystem::path& file, const std::string& by) {
  Study study(file, {"drive.by=" + by});
  std::vector<Trial> trials(3, study.own_trial());
  for (std::size_t m = 1; m < 3; ++m)
    trials[m].tissue = study.tissue_of(study.scene().variants[m - 1].scene);
  const std::vector<simulate::SimulationResult> runs = study.by_same_forces(trials);
  DrivenWay way;
  std::vector<metrics::SymmetryCurve> curves;
  for (std::size_t m = 0; m < 3; ++m) {
    const motion::Motion& tracks = runs[m].performance.landmarks;
    curves.push_back(study.symmetry_of(tracks));
    const Points lip = track_of(tracks, face::ibug(51));
    way.upper_lip_mm[m] = 1e3 * (lip.bottomRows<1>() - lip.topRows<1>()).norm();
  }
  for (std::size_t m = 1; m < 3; ++m) {
    way.pairs[m - 1] =
        pair_of(study, fmt::format("1 and {}", m + 1), runs[0].performance, runs[m].performance);
    way.added[m - 1] = greatest(metrics::added_difference(curves[m], curves[0]));
  }
  way.spread = greatest(metrics::spread_of(curves));
  way.jitter_to_tell_mm = jitter_to_tell_mm(runs[0].performance.landmarks,
                                            metrics::added_difference(curves[1], curves[2]));
  way.driven_off_mm = runs[0].report.driven_off_mm;
  return way;
}

std::string row_of(const std::string& face, const std::string& by, const DrivenWay& way) {
  std::string row = fmt::format("| {} | {} |", face, by);
  for (const ModelPair& p : way.pairs) row += fmt::format(" {:.3f} |", p.largest_mm);
  for (const ModelPair& p : way.pairs) row += fmt::format(" {:.0f} % |", 100 * p.share_near_cphs);
  for (const ModelPair& p : way.pairs)
    row += fmt::format(" {:+.3f} of {:.2f} |", p.change_mm, p.moved_mm);
  return row +
         fmt::format(" {:.2f}, {:.2f}, {:.2f} | {:+.3f}, {:+.3f} | {:.2f} | {:.1f} | {:.2f} |\n",
                     way.upper_lip_mm[0], way.upper_lip_mm[1], way.upper_lip_mm[2],
                     1e3 * way.added[0], 1e3 * way.added[1], way.spread,
                     1e3 * way.jitter_to_tell_mm, way.driven_off_mm);
}

/// "1.9 and 2.1 times as far apart"
std::string factors(const SameForcesFace& f) {
  const auto of = [&](std::size_t m) {
    return f.by_muscles.pairs[m].largest_mm / f.by_displacement.pairs[m].largest_mm;
  };
  return fmt::format(
      "{:.1f} and {:.1f} times the largest distance, {:.1f} times the change of "
      "xi_L - xi_R",
      of(0), of(1), f.by_muscles.added[0] / f.by_displacement.added[0]);
}

}  // namespace

std::vector<SameForcesFace> hyper_expression_by_muscles(const Setting& setting) {
  std::vector<SameForcesFace> faces;
  for (const bool subject_a : setting.faces()) {
    const std::filesystem::path scene = setting.scene(3, subject_a);
    faces.push_back({subject_a ? "subject A" : "embedded face", driven(scene, "displacement"),
                     driven(scene, "muscles")});
  }
  return faces;
}

std::string same_forces_section(const std::vector<SameForcesFace>& faces) {
  std::string page =
      "\n### The same forces in three tissues\n"
      "`hyperex run examples/experiment_3_embedded.toml --set drive.by=muscles --out out/a`. "
      "The thesis prescribes where points go, in every tissue: what differs is only the skin "
      "between them. The same scenes with\n`drive.by = \"muscles\"` ([muscles.md](muscles.md)) "
      "find "
      "forces of muscles and jaw in model 1, which meet the recording there, and let\nmodels 2 and "
      "3 answer them. Against the printed way: " +
      of_each(faces, factors) +
      ".\n\n| face | driven by | 1 and 2: largest distance, mm | 1 and 3 | 1 and 2: within 25 mm "
      "of "
      "the right cphs | 1 and 3 | 1 and 2: change within 10 mm of it, mm | 1 and 3 | middle of the "
      "upper lip, models 1 to 3, mm | D_2 - D_1, D_3 - D_1, x 1000 | greatest spread of S | jitter "
      "at which 2 and 3 are told apart, um | model 1 off the recording, mm |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const SameForcesFace& f : faces)
    page +=
        row_of(f.name, "displacement", f.by_displacement) + row_of(f.name, "muscles", f.by_muscles);
  page +=
      "\nDistances stay of that size either way. A mouth is opened by the jaw, whose pose is part "
      "of "
      "what is held and the same in all three models,\nand tissue at one point of the upper lip "
      "has "
      "little to hold back. Where muscles move the corner of the mouth, the same forces make far "
      "larger\ndifferences ([muscles.md](muscles.md): about a third less beside a stiff cheek).\n";
  return page;
}

}  // namespace hyperex::bench
