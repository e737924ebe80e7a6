// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/estimate/proposal.hpp"
#include "hyperex/estimate/ratio_parts.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::estimate {
namespace {

/// Where a recording shows no jitter, and the least that is assumed of the head's pose.
constexpr double kAssumedJitter_m = 2e-4, kLeastShift_m = 1e-4, kLeastTurn_rad = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;
/// A further recording is proposed where it narrows an interval by this much.
constexpr double kWorthwhile = 0.9;

/// The outline of the face, which trackers of pictures let slide along the skin; its chin does not.
bool slides(const std::string& point) {
  const auto number = face::ibug_number(point);
  return number && *number <= 16 && (*number < 6 || *number > 10);
}

std::vector<std::string> observed_points(const scene::Scene& scene, const session::Inputs& first,
                                         const std::vector<session::Inputs>& others) {
  std::vector<std::string> out = first.driven;
  if (!scene.origins.contains("drive.points")) {
    simulate::DriveOptions all;
    all.all_points = true;
    out = all.names_in(first.motion.motion);
    std::erase_if(out, slides);
  }
  std::erase_if(out, [&](const std::string& name) {
    return std::ranges::any_of(others, [&](const session::Inputs& other) {
      return other.motion.motion.index_of(name) < 0;
    });
  });
  if (out.size() < 3)
    throw InputError("recordings", fmt::format("expected three or more points that all recordings "
                                               "have; they have {} in common",
                                               out.size()));
  return out;
}

Points places_of(const simulate::AlignedMotion& motion, const std::vector<std::string>& points) {
  Points out(Eigen::Index(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.row(Eigen::Index(i)) = motion.rest.row(motion.motion.index_of(points[i]));
  return out;
}

Observation observed(const session::Inputs& in, const std::vector<std::string>& points,
                     const std::string& name, std::vector<std::string>& remarks) {
  RecordingErrors errors;
  errors.jitter_m = in.jitter_m;
  if (errors.jitter_m <= 0) {
    errors.jitter_m = kAssumedJitter_m;
    remarks.push_back(
        fmt::format("{} shows no jitter: {:.1f} mm is assumed", name, 1e3 * kAssumedJitter_m));
  }
  errors.head_shift_m = std::max(kLeastShift_m, 1e-3 * in.head_shift_uncertainty_mm / kWithin95);
  errors.head_turn_rad =
      std::max(kLeastTurn_rad, kDegree * in.head_turn_uncertainty_deg / kWithin95);
  return observe(in.motion, points, errors, name);
}

/// The file of the recording: a further one is of the same kind.
std::filesystem::path& recording_of(scene::MotionOptions& motion) {
  for (auto* file : {&motion.recording, &motion.openface, &motion.arkit})
    if (!file->empty()) return *file;
  return motion.source.file;
}

std::string name_of(scene::MotionOptions motion) {
  const auto& file = recording_of(motion);
  if (!file.empty()) return file.filename().string();
  return "the embedded recording";
}

Range natural(const Range& range, Finding::Kind kind) {
  if (kind == Finding::Kind::gain) return {std::max(0.0, range.low), range.high};
  return {std::exp(range.low), std::exp(range.high)};
}

Finding finding_of(Posterior& posterior, const Mode& mode, const std::vector<Proposal>& further,
                   Eigen::Index which, const std::string& name) {
  const Unknowns& u = posterior.unknowns();
  Finding out;
  out.kind = which < u.ratios ? Finding::Kind::ratio : Finding::Kind::gain;
  out.name = name;
  const AskedInterval found = interval_of(posterior, mode, which);
  out.value = out.kind == Finding::Kind::ratio ? std::exp(found.value) : found.value;
  out.interval = natural(found.profile, out.kind);
  out.laplace = natural(found.laplace, out.kind);
  out.determined = out.kind == Finding::Kind::ratio
                       ? out.interval.high / out.interval.low <= kWidestRatio
                       : out.interval.high - out.interval.low <= kWidestGain;
  out.parts = error_parts(mode, u, which);
  const auto best = std::ranges::min_element(
      further, {}, [which](const Proposal& one) { return one.sigma[which]; });
  if (best->sigma[which] < kWorthwhile * found.sigma) {
    out.further = best->expression;
    const double reach = kWithin95 * best->sigma[which];
    out.further_interval = natural({found.value - reach, found.value + reach}, out.kind);
  }
  return out;
}

std::vector<Alike> alike_pairs(Posterior& posterior, const Mode& mode,
                               const std::vector<std::string>& names) {
  const Eigen::MatrixXd information = posterior.information(mode);
  std::vector<Alike> out;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j) {
      const auto a = Eigen::Index(i), b = Eigen::Index(j);
      const double lengths = std::sqrt(information(a, a) * information(b, b));
      const double cosine = lengths > 0 ? information(a, b) / lengths : 0;
      if (std::abs(cosine) >= kAlike) out.push_back({names[i], names[j], cosine});
    }
  return out;
}

/// Sets the findings and how well the recordings are met.
void answer(FaceModel face, const Question& question, const Assumptions& assumptions,
            Estimate& out) {
  Posterior posterior(face, out.recordings, assumptions);
  const Mode mode = [&] {
    const Progress progress("fitting tissue and muscles to the recordings", 0);
    return posterior.find(posterior.start(), {});
  }();
  out.rms_m = mode.rms_m;
  out.error_scale = mode.error_scale;
  std::vector<std::string> names;
  for (const StiffnessRatio& ratio : question.ratios) names.push_back(ratio.name);
  names.insert(names.end(), question.gains.begin(), question.gains.end());
  out.alike = alike_pairs(posterior, mode, names);
  Progress progress("checking the intervals", long(names.size()));
  const std::vector<Proposal> further = proposals(face, posterior, mode, assumptions);
  for (std::size_t i = 0; i < names.size(); ++i) {
    out.findings.push_back(finding_of(posterior, mode, further, Eigen::Index(i), names[i]));
    progress.update(long(i) + 1);
  }
}

}  // namespace

Estimate estimate(const scene::Scene& scene, const Request& request) {
  if (request.stiffness.empty() && request.gains.empty())
    throw InputError("estimate",
                     "expected what to find: parts of the tissue (cheek_L:cheek_R) or muscles "
                     "(zygomatic_R)");
  session::FaceSession session{scene::Scene(scene), {}};
  Question question;
  for (const std::string& asked : request.stiffness)
    question.ratios.push_back(ratio_of(session, asked));
  question.gains = request.gains;
  std::vector<session::Inputs> others;
  scene::Scene other = session.scene();
  // Scan and landmarks are known; only the recordings are read.
  other.given.scan = std::make_shared<const io::Scan>(session.scan());
  other.given.landmarks = session.inputs().landmarks;
  for (const auto& file : request.recordings) {
    recording_of(other.motion) = file;
    other.motion.source.embedded = false;
    others.push_back(session::read_inputs(other));
  }
  Estimate out;
  const session::Inputs& in = session.inputs();
  out.points = observed_points(session.scene(), in, others);
  out.recordings.push_back(observed(in, out.points, name_of(scene.motion), out.remarks));
  for (std::size_t i = 0; i < others.size(); ++i)
    out.recordings.push_back(
        observed(others[i], out.points, request.recordings[i].filename().string(), out.remarks));
  const auto face = [&] {
    const Progress progress("finding how the points follow the muscles", 0);
    return face_model(session.mesh(), in.landmarks, session.options(0), out.points,
                      places_of(in.motion, out.points), question);
  };
  answer(face(), question, request.assumptions, out);
  return out;
}

}  // namespace hyperex::estimate
