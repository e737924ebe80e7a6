// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/estimate/further_recordings.hpp"
#include "hyperex/estimate/proposal.hpp"
#include "hyperex/estimate/ratio_parts.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/scene/recording_file.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"

namespace hyperex::estimate {
namespace {

namespace fs = std::filesystem;

/// Where a recording shows no jitter, and the least that is assumed of the head's pose.
constexpr double kAssumedJitter_m = 2e-4, kLeastShift_m = 1e-4, kLeastTurn_rad = 1e-3;
constexpr double kDegree = std::numbers::pi / 180;
/// A further recording is proposed where it narrows an interval by this much.
constexpr double kWorthwhile = 0.9;
constexpr double kHeaviest_kg = 0.5;
constexpr const char* kSoftTissue = "soft tissue";

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
                     const std::string& name, bool under_load, std::vector<std::string>& remarks) {
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
  return under_load ? observe_load(in.motion, points, errors, name)
                    : observe(in.motion, points, errors, name);
}

KnownLoad load_of(const session::Inputs& in, const HungWeight& weight) {
  const auto refuse = [&](const std::string& key, const std::string& value,
                          const std::string& expected) {
    throw InputError(InputProblem{{}, 0, key, value, expected});
  };
  if (!(weight.mass_kg > 0 && weight.mass_kg <= kHeaviest_kg))
    refuse("weight", fmt::format("{:g}", 1e3 * weight.mass_kg), "grams, above 0 and at most 500");
  const auto known = in.landmarks.find(weight.point);
  if (known == in.landmarks.end())
    refuse("weight", weight.point, "a landmark of the scan that the weight hangs from");
  return hung_weight(in.landmarks, known->second, weight.mass_kg);
}

std::vector<KnownLoad> loads_of(const session::Inputs& in, const Request& request) {
  std::vector<KnownLoad> out;
  if (!request.lying.empty()) out.push_back(lying_down(in.landmarks));
  for (const HungWeight& weight : request.weights) out.push_back(load_of(in, weight));
  return out;
}

/// Recordings of expressions, then of known loads. Each counts as independent of the others.
std::vector<fs::path> files_of(const scene::Scene& scene, const Request& request) {
  std::vector<fs::path> out = request.recordings;
  if (!request.lying.empty()) out.push_back(request.lying);
  for (const HungWeight& weight : request.weights) out.push_back(weight.recording);
  std::set<fs::path> known;
  if (const fs::path& file = scene::recording_file(scene.motion); !file.empty())
    known.insert(fs::weakly_canonical(file));
  for (const fs::path& file : out)
    if (!known.insert(fs::weakly_canonical(file)).second)
      throw InputError(file, "is given twice: expected another recording");
  return out;
}

/// From unknowns to what is printed.
struct Scale {
  Finding::Kind kind;
  double unit;  ///< Young's modulus of the scene in kPa; else 1

  double value(double unknown) const {
    return kind == Finding::Kind::gain ? std::max(0.0, unknown) : unit * std::exp(unknown);
  }
  Range range(const Range& of) const { return {value(of.low), value(of.high)}; }
  bool narrow(const Range& of) const {
    return kind == Finding::Kind::gain ? of.high - of.low <= kWidestGain
                                       : of.high / of.low <= kWidestRatio;
  }
};

Scale scale_of(const Unknowns& u, Eigen::Index which, double scenes_young_kpa) {
  if (which < u.ratios) return {Finding::Kind::ratio, 1};
  if (u.is_gain(which)) return {Finding::Kind::gain, 1};
  return {Finding::Kind::young, scenes_young_kpa};
}

Finding finding_of(Posterior& posterior, const Mode& mode, const std::vector<Proposal>& further,
                   Eigen::Index which, const std::string& name, const Scale& scale) {
  const Unknowns& u = posterior.unknowns();
  Finding out;
  out.kind = scale.kind;
  out.name = name;
  const AskedInterval found = interval_of(posterior, mode, which);
  out.value = scale.value(found.value);
  out.interval = scale.range(found.profile);
  out.laplace = scale.range(found.laplace);
  out.determined = scale.narrow(out.interval);
  out.parts = error_parts(mode, u, which);
  const auto best = std::ranges::min_element(
      further, {}, [which](const Proposal& one) { return one.sigma[which]; });
  if (best->sigma[which] < kWorthwhile * found.sigma) {
    out.further = best->expression;
    const double reach = kWithin95 * best->sigma[which];
    out.further_interval = scale.range({found.value - reach, found.value + reach});
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
  if (!question.loads.empty()) names.emplace_back(kSoftTissue);
  out.alike = alike_pairs(posterior, mode, names);
  Progress progress("checking the intervals", long(names.size()));
  const std::vector<Proposal> further = proposals(face, posterior, mode, assumptions);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto which = Eigen::Index(i);
    out.findings.push_back(finding_of(posterior, mode, further, which, names[i],
                                      scale_of(posterior.unknowns(), which, out.scenes_young_kpa)));
    progress.update(long(i) + 1);
  }
}

}  // namespace

Estimate estimate(const scene::Scene& scene, const Request& request) {
  if (request.stiffness.empty() && request.gains.empty() && request.lying.empty() &&
      request.weights.empty())
    throw InputError("estimate",
                     "expected what to find: parts of the tissue (cheek_L:cheek_R), muscles "
                     "(zygomatic_R), or a known load");
  session::FaceSession session{scene::Scene(scene), {}};
  Question question;
  for (const std::string& asked : request.stiffness)
    question.ratios.push_back(ratio_of(session, asked));
  question.gains = request.gains;
  const FurtherRecordings reader(session);
  const std::vector<fs::path> files = files_of(session.scene(), request);
  const std::size_t expressions = request.recordings.size();
  std::vector<session::Inputs> others;
  for (std::size_t i = 0; i < files.size(); ++i)
    others.push_back(i < expressions ? reader.read(files[i]) : reader.read_points(files[i]));
  Estimate out;
  const session::Inputs& in = session.inputs();
  question.loads = loads_of(in, request);
  out.scenes_young_kpa = 1e-3 * session.options(0).tissue.uniform[tissue::young];
  out.points = observed_points(session.scene(), in, others);
  out.recordings.push_back(observed(in, out.points, name_of(scene.motion), false, out.remarks));
  for (std::size_t i = 0; i < others.size(); ++i) {
    const bool under_load = i >= expressions;
    out.recordings.push_back(
        observed(others[i], out.points, files[i].filename().string(), under_load, out.remarks));
    if (under_load) out.recordings.back().load = int(i - expressions);
  }
  const auto face = [&] {
    const Progress progress("finding how the points follow the muscles", 0);
    return face_model(session.mesh(), in.landmarks, session.options(0), out.points,
                      places_of(in.motion, out.points), question);
  };
  answer(face(), question, request.assumptions, out);
  return out;
}

}  // namespace hyperex::estimate
