// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/face_model.hpp"

#include "hyperex/core/error.hpp"
#include "hyperex/muscles/muscle_names.hpp"
#include "hyperex/simulate/load/muscle_prior.hpp"

namespace hyperex::estimate {
namespace {

MusclePrior muscle_pairs(const std::vector<muscles::MuscleLine>& lines,
                         const simulate::MuscleOptions& options) {
  const simulate::FitPriors fit = simulate::muscle_prior(lines, options);
  MusclePrior out{{}, {}, {}, {}, {}, fit.opening_rad, fit.turn_rad, fit.tilt_rad, fit.slide_m};
  for (std::size_t m = 0; m < lines.size(); ++m) {
    out.tone.push_back(options.table()[std::size_t(lines[m].row)].tone);
    if (!lines[m].left) continue;
    for (std::size_t other = 0; other < lines.size(); ++other)
      if (lines[other].row == lines[m].row && !lines[other].left) {
        out.left.push_back(int(m));
        out.right.push_back(int(other));
      }
  }
  out.sigma.resize(Eigen::Index(out.left.size()));
  for (Eigen::Index i = 0; i < out.sigma.size(); ++i) {
    const int m = out.left[std::size_t(i)];
    const bool ring =
        options.table()[std::size_t(lines[std::size_t(m)].row)].kind == muscles::MuscleKind::ring;
    out.sigma[i] = fit.readiness[m] * (ring ? fit.ring : fit.activation);
  }
  out.together = fit.correlation(out.left, out.left);
  return out;
}

std::vector<int> muscles_of(const std::string& gain, const std::vector<muscles::MuscleLine>& lines,
                            const muscles::MuscleTable& table) {
  std::vector<int> out;
  for (std::size_t m = 0; m < lines.size(); ++m)
    if (muscles::names_for(lines[m].name, table).contains(gain)) out.push_back(int(m));
  if (out.empty())
    throw InputError({.file = {},
                      .line = 0,
                      .key = "gain",
                      .value = gain,
                      .expected = muscles::gain_expected(gain, table)});
  return out;
}

}  // namespace

FaceModel face_model(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                     const simulate::SimulationOptions& options,
                     const std::vector<std::string>& points, const Points& places,
                     const Question& question) {
  FaceModel out{
      FaceResponses(mesh, landmarks, options, points, places, question.ratios, question.loads),
      simulate::JawKinematics(landmarks, mesh.bones.get()),
      options.muscles.half,
      {},
      {},
      places,
      question.loads};
  out.prior = muscle_pairs(out.responses.lines(), options.muscles);
  for (const std::string& gain : question.gains)
    out.acts.push_back(muscles_of(gain, out.responses.lines(), options.muscles.table()));
  return out;
}

}  // namespace hyperex::estimate
