// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/measured_face.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/nan.hpp"
#include "hyperex/motion/lowpass.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/still_points.hpp"
#include "hyperex/motion/try_stabilise.hpp"
#include "hyperex/session/check_alone.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/recording_jitter.hpp"
#include "hyperex/visits/scale_between.hpp"

namespace hyperex::visits {
namespace fs = std::filesystem;
namespace {

using metrics::kNan;
const Vec3 kUnknown = Vec3::Constant(kNan);

/// A sentence with the recording's file name in the place of its path, whose folders may name a
/// patient.
std::string with_file_name(std::string text, const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  for (auto at = path.empty() ? std::string::npos : text.find(path); at != std::string::npos;
       at = text.find(path, at + name.size()))
    text.replace(at, path.size(), name);
  return text;
}

/// The motion without head pose, and the pose's errors where it was taken out.
motion::StabilisedMotion without_head(const motion::Motion& motion, const VisitsFile& visits,
                                      const motion::StillPoints& still_points,
                                      std::size_t recording, MeasuredFace& face) {
  motion::TriedPose tried;
  if (!visits.rigid_points.empty())
    tried.steady =
        motion::stabilise(motion, {.rigid_points = motion::own_names(motion, visits.rigid_points)});
  else if (recording < still_points.by_landmarks.size())
    tried.steady = still_points.by_landmarks[recording];
  else
    tried = motion::try_stabilise(motion, motion::own_names(motion, still_points.names),
                                  "rigid_points of the visits");
  face.head_known = tried.why_not.empty();
  if (!face.head_known) {
    face.remarks.push_back("head pose is not taken out and is in every figure: " +
                           with_file_name(tried.why_not, motion.source));
    return tried.steady;
  }
  if (const auto unused = motion::still_points_beside_landmarks(tried.steady); !unused.empty())
    face.choices.push_back(motion::unused_still_points_sentence(unused) +
                           ", as not every recording shows them to be still");
  if (!still_points.names.empty())
    face.choices.push_back(motion::still_points_sentence(still_points) +
                           "; the same in every recording; rigid_points of the visits changes "
                           "that");
  if (const auto far = session::check_steady(tried.steady.motion))
    face.remarks.push_back(with_file_name(far->text, motion.source));
  return tried.steady;
}

void settle_jitter(const motion::Motion& steady, std::optional<double> stated_m,
                   MeasuredFace& face) {
  if (stated_m) {
    face.jitter_m = *stated_m;
    face.jitter_known = true;
    return;
  }
  const session::RecordedJitter found = session::recorded_jitter(steady);
  face.jitter_m = found.jitter_m;
  face.jitter_known = found.known;
  if (!face.jitter_known)
    face.remarks.push_back(
        fmt::format("{}: {}; what its noise makes of a change is unknown (jitter_mm of the visit "
                    "states it, 0 for exact points)",
                    fs::path(steady.source).filename().string(), found.how));
}

std::size_t peak_of(const std::vector<double>& movement, const VisitsFile& visits,
                    const fs::path& recording) {
  std::size_t peak = movement.size();
  for (std::size_t k = 0; k < movement.size(); ++k)
    if (!std::isnan(movement[k]) && (peak == movement.size() || movement[k] > movement[peak]))
      peak = k;
  if (peak == movement.size())
    throw InputError(recording,
                     fmt::format("measures no points of the {}, which \"{}\" is judged by",
                                 moved_part(visits.expression.movement), visits.expression.name));
  return peak;
}

/// The first sample with half of the movement from the first sample to the peak.
std::size_t first_half_of(const std::vector<double>& movement, std::size_t peak) {
  const double rest = std::isnan(movement.front()) ? 0 : movement.front();
  for (std::size_t k = 0; k < peak; ++k)
    if (movement[k] >= (rest + movement[peak]) / 2) return k;
  return peak;
}

/// The points that are measured in a sample, by all their names.
io::Landmarks points_at(const motion::Motion& motion, std::size_t sample) {
  io::Landmarks out;
  for (std::size_t p = 0; p < motion.names.size(); ++p) {
    const Vec3 place = motion.positions[sample].row(Eigen::Index(p)).transpose();
    if (place.allFinite()) out[face::full_name(motion.names[p])] = place;
  }
  // Visits may be recorded with different sets of names.
  const io::Landmarks named = out;
  for (const auto& [name, place] : named)
    if (const std::string other = face::other_name(name); !other.empty())
      out.try_emplace(other, place);
  return out;
}

double eye_distance(const io::Landmarks& rest) {
  if (!rest.contains("exocanthion_R") || !rest.contains("exocanthion_L")) return kNan;
  return (rest.at("exocanthion_R") - rest.at("exocanthion_L")).norm();
}

/// Those of `names` that both recordings measure.
std::vector<std::string> measured_by_both(const MeasuredFace& a, const MeasuredFace& b,
                                          const std::vector<std::string>& names) {
  std::vector<std::string> common;
  for (const std::string& name : names)
    if (a.rest.contains(name) && b.rest.contains(name)) common.push_back(name);
  return common;
}

Points places_of(const std::map<std::string, Vec3>& rest, const std::vector<std::string>& names) {
  Points out(Eigen::Index(names.size()), 3);
  for (std::size_t i = 0; i < names.size(); ++i)
    out.row(Eigen::Index(i)) = rest.at(names[i]).transpose();
  return out;
}

/// Whether one skull can be laid on another by these points of it.
bool give_axes(const Points& at) {
  return at.rows() >= 3 && spread_off_line(at) >= 0.05;
}

/// The points of the head by which it is compared between visits. A band sits elsewhere on another
/// day, landmarks do not: they lay one skull on the other where there are enough. Stated points
/// that are all landmarks do it themselves.
std::vector<std::string> head_points(const VisitsFile& visits,
                                     const motion::StillPoints& still_points,
                                     const MeasuredFace& first, const MeasuredFace& face) {
  const bool stated = !visits.rigid_points.empty();
  const std::vector<std::string>& points = stated ? visits.rigid_points : still_points.names;
  const std::vector<std::string>& landmarks = motion::default_rigid_points();
  if (points.empty() || (!stated && still_points.beside_landmarks)) return landmarks;
  std::vector<std::string> names;
  for (const std::string& name : points) names.push_back(face::full_name(name));
  const bool all_are_landmarks = std::ranges::all_of(
      names, [](const std::string& name) { return face::is_known_landmark(name); });
  if (stated && !all_are_landmarks &&
      give_axes(places_of(first.rest, measured_by_both(first, face, landmarks))))
    return landmarks;
  return names;
}

/// The axes of the first recording, carried by the skull to this one.
void carry_axes(const MeasuredFace& first, const std::vector<std::string>& of_head,
                const fs::path& recording, MeasuredFace& face) {
  const std::vector<std::string> common = measured_by_both(first, face, of_head);
  const Points there = places_of(first.rest, common), here = places_of(face.rest, common);
  face.state.axes.setConstant(kNan);
  if (!give_axes(there)) {
    face.remarks.push_back(
        fmt::format("{}: fewer than three still points in common with the first visit, so that "
                    "directions cannot be compared",
                    recording.filename().string()));
    return;
  }
  const Eigen::Isometry3d here_from_there = fit_rigid(there, here);
  Points fitted = there;
  for (Eigen::Index i = 0; i < fitted.rows(); ++i)
    fitted.row(i) = (here_from_there * Vec3(there.row(i).transpose())).transpose();
  face.head_fit_m = rms_distance(fitted, here);
  face.state.axes = first.state.axes * here_from_there.linear().transpose();
  // Least squares of a rotation: variance of a coordinate times the inverse of sum |a|^2 I - a a'.
  const double freedom = std::max(1.0, 3.0 * double(common.size()) - 6);
  const double variance = (fitted - here).squaredNorm() / freedom;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  const Eigen::RowVector3d mean = here.colwise().mean();
  for (Eigen::Index i = 0; i < here.rows(); ++i) {
    const Vec3 arm = (here.row(i) - mean).transpose();
    normal += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
  }
  face.axes_covariance = variance * normal.inverse();
}

void settle_axes(const MeasuredFace* first, const VisitsFile& visits,
                 const motion::StillPoints& still_points, const fs::path& recording,
                 MeasuredFace& face) {
  if (first)
    return carry_axes(*first, head_points(visits, still_points, *first, face), recording, face);
  face.state.axes.setConstant(kNan);
  if (const auto frame = face::face_frame_of_corners(face.rest))
    face.state.axes = frame->face_from_scan();
  else
    face.remarks.push_back(
        fmt::format("{}: without the outer corners of the eyes and the corners "
                    "of the mouth no directions are measured",
                    recording.filename().string()));
}

void settle_points(const ByFacePoint<std::vector<int>>& columns, const ByFacePoint<Points>& tracks,
                   std::size_t peak, MeasuredFace& face) {
  for (std::size_t i = 0; i < kFacePoints; ++i) {
    const bool known = !columns[i].empty();
    face.state.rest[i] = known ? Vec3(tracks[i].row(0).transpose()) : kUnknown;
    face.state.peak[i] = known ? Vec3(tracks[i].row(Eigen::Index(peak)).transpose()) : kUnknown;
  }
}

/// `rest`, `peak`: what the filter leaves of white noise in these samples (lowpassed_noise).
void settle_noise(const ByFacePoint<std::vector<int>>& columns, double rest, double peak,
                  MeasuredFace& face) {
  for (std::size_t i = 0; i < kFacePoints; ++i) {
    // A point is the mean of its columns.
    const double averaged = std::sqrt(double(std::max<std::size_t>(1, columns[i].size())));
    face.rest_jitter_m[i] = face.jitter_m * rest / averaged;
    face.peak_jitter_m[i] = face.jitter_m * peak / averaged;
  }
}

/// The pose's errors at the peak, relative to rest.
void settle_pose(const motion::UncertainPose& pose, double rest, double peak, MeasuredFace& face) {
  face.pose_covariance = pose.filtered((rest * rest + peak * peak) / 2);
  face.pose_centre = pose.centre;
}

void settle_curves(const ByFacePoint<std::vector<int>>& columns, const motion::Motion& motion,
                   MeasuredFace& face) {
  for (const double time : motion.time_s) face.time_s.push_back(time - motion.time_s.front());
  for (const Side side : {Side::right, Side::left}) {
    const auto& corner = at(columns, of_side(FacePoint::corner_R, side));
    if (!corner.empty())
      face.corner_mm[std::size_t(side)] = metrics::distance_from_rest_mm(motion, corner);
  }
}

void settle_first_way(const MeasuredFace* first, MeasuredFace& face) {
  if (first) {
    face.state.first_direction = first->state.first_direction;
    face.state.first_excursion_m = first->state.first_excursion_m;
    return;
  }
  for (const Side side : {Side::right, Side::left}) {
    const FacePoint corner = of_side(FacePoint::corner_R, side);
    const Vec3 way = face.state.axes * (at(face.state.peak, corner) - at(face.state.rest, corner));
    face.state.first_direction[std::size_t(side)] =
        way.norm() >= kLeastMovement_m ? Vec3(way.normalized()) : kUnknown;
    face.state.first_excursion_m[std::size_t(side)] = way.norm();
  }
}

/// Whether the faces of both recordings are of one size; else a remark names both.
bool have_one_scale(const MeasuredFace& first, MeasuredFace& face) {
  const ScaleBetween scale = scale_between(first.rest, face.rest);
  if (!(std::abs(scale.ratio - 1) > scale.bound)) return true;
  face.other_scale = scale.ratio;
  face.remarks.push_back(fmt::format(
      "{}: the face at rest is {:.3g} times as large as in {}, by {} points that both measure "
      "(expected: 1, to within {:.2g} %): it may be another person or another scale, and so "
      "changes are not judged; check the units of both",
      face.file, scale.ratio, first.file, scale.common, 100 * scale.bound));
  return false;
}

/// The shape of the face at rest is that of another person. By the 68 points of iBUG two people
/// are 3.1 to 8.8 mm rms apart, recordings of one person at most 3.5 mm (session::misfit_warning).
void note_shape(const MeasuredFace& first, MeasuredFace& face) {
  constexpr double kOnePerson_m = 5e-3;
  constexpr std::size_t kFewest = 20;
  std::vector<std::string> common;
  for (const auto& [name, place] : first.rest) {
    const std::string other = face::place_name(name);  // a place that has two names counts once
    if (face.rest.contains(name) &&
        (other == name || !first.rest.contains(other) || !face.rest.contains(other)))
      common.push_back(name);
  }
  const Points there = places_of(first.rest, common), here = places_of(face.rest, common);
  if (common.size() < kFewest || spread_off_line(there) < 0.05) return;
  const double rms_m = rms_distance(fit_similarity(here, there).apply(here), there);
  if (rms_m <= kOnePerson_m) return;
  face.doubts.push_back(
      fmt::format("{}: the points at rest are {:.1f} mm rms from those of {} after a fit of place "
                  "and size (expected of one person: at most {:g} mm): it may be another person",
                  face.file, 1e3 * rms_m, first.file, 1e3 * kOnePerson_m));
}

/// A corner of the mouth that is at rest elsewhere than at the first visit, relative to brows, eyes
/// and nose. A movement is counted from there, so a recording that begins in an expression would
/// show a loss.
void note_corners_at_rest(const MeasuredFace& first, MeasuredFace& face) {
  constexpr double kElsewhere_m = 3e-3;
  constexpr std::size_t kFewest = 12;
  const auto all = face::all_ibug().begin();
  const std::vector<std::string> upper = measured_by_both(first, face, {all + 17, all + 48});
  if (upper.size() < kFewest) return;
  const auto fit = fit_similarity(places_of(face.rest, upper), places_of(first.rest, upper));
  std::vector<std::string> moved;
  for (const std::string& name : measured_by_both(first, face, {face::ibug(48), face::ibug(54)})) {
    const double off_m =
        rms_distance(fit.apply(places_of(face.rest, {name})), places_of(first.rest, {name}));
    if (off_m > kElsewhere_m)
      moved.push_back(fmt::format("the {} one {:.1f} mm", name == face::ibug(48) ? "right" : "left",
                                  1e3 * off_m));
  }
  if (moved.empty()) return;
  face.doubts.push_back(fmt::format(
      "{}: corners of the mouth are elsewhere at rest than in {}, relative to brows, eyes and "
      "nose: {}; the face has changed at rest, or one of both recordings begins in an expression, "
      "and then its movement is measured too small",
      face.file, first.file, fmt::join(moved, ", ")));
}

void note_size(const MeasuredFace* first, const fs::path& recording, MeasuredFace& face) {
  constexpr double kLargestShare = 0.03;
  if (!first || !have_one_scale(*first, face) ||
      !(std::abs(face.eye_distance_m / first->eye_distance_m - 1) > kLargestShare))
    return;
  face.doubts.push_back(fmt::format(
      "{}: the outer corners of the eyes are {:.1f} mm apart and {:.1f} mm at the first "
      "visit: it may be another person or another scale, and lengths may not be comparable",
      recording.filename().string(), 1e3 * face.eye_distance_m, 1e3 * first->eye_distance_m));
}

}  // namespace

MeasuredFace measure(const motion::Motion& motion, const VisitsFile& visits,
                     std::optional<double> stated_jitter_m, const MeasuredFace* first,
                     const motion::StillPoints& still_points, std::size_t recording) {
  MeasuredFace face;
  const fs::path name = motion::named(motion);
  face.file = name.filename().string();
  const motion::StabilisedMotion steady =
      without_head(motion, visits, still_points, recording, face);
  if (face.head_known)
    for (const Note& doubt : session::extent_warnings(steady.motion))
      face.extent_doubts.push_back(doubt.text);
  if (const auto still = session::stillness_warning(steady.motion, false))
    face.extent_doubts.push_back(still->text);
  settle_jitter(steady.motion, stated_jitter_m, face);
  const double cutoff_hz = face.jitter_m > 0 ? metrics::kUsualLowpass_hz : 0;
  const motion::Motion smooth = motion::lowpassed(steady.motion, cutoff_hz);
  const auto columns = face_points_of(smooth);
  ByFacePoint<Points> tracks;
  for (std::size_t i = 0; i < kFacePoints; ++i)
    if (!columns[i].empty()) tracks[i] = track_of(smooth, columns[i]);
  const std::vector<double> movement = movement_of(visits.expression.movement, tracks);
  const std::size_t peak = peak_of(movement, visits, name);
  face.rest = points_at(smooth, 0);
  face.peak = points_at(smooth, peak);
  face.peak_s = smooth.time_s[peak] - smooth.time_s.front();
  face.half_s = smooth.time_s[first_half_of(movement, peak)] - smooth.time_s.front();
  settle_points(columns, tracks, peak, face);
  const double rest_noise = motion::lowpassed_noise(smooth.time_s, 0, cutoff_hz),
               peak_noise = motion::lowpassed_noise(smooth.time_s, peak, cutoff_hz);
  settle_noise(columns, rest_noise, peak_noise, face);
  if (!steady.poses.empty()) settle_pose(steady.poses[peak], rest_noise, peak_noise, face);
  settle_curves(columns, smooth, face);
  face.eye_distance_m = eye_distance(face.rest);
  settle_axes(first, visits, still_points, name, face);
  settle_first_way(first, face);
  note_size(first, name, face);
  if (first) {
    note_shape(*first, face);
    note_corners_at_rest(*first, face);
  }
  return face;
}

session::CleanedRecording read_recording(const fs::path& recording, const VisitEntry& visit,
                                         const VisitsFile& visits) {
  session::CleanedRecording cleaned = session::cleaned_recording(
      motion::until(motion::read_motion(recording, visits.unit), visit.end_s, "end_s"));
  append(cleaned.warnings, session::check_alone(cleaned.motion));
  return cleaned;
}

MeasuredFace measure_recording(const session::CleanedRecording& recording, const VisitEntry& visit,
                               const VisitsFile& visits, const MeasuredFace* first,
                               const motion::StillPoints& still_points, std::size_t number) {
  const motion::Motion& motion = recording.motion;
  MeasuredFace face = measure(motion, visits, visit.jitter_m, first, still_points, number);
  if (const std::string unit = session::guessed_unit(motion); !unit.empty())
    face.choices.push_back(
        fmt::format("{}: the unit is {}; unit of the visits states it", face.file, unit));
  const auto of_visit = [&](const std::string& doubt) {
    return fmt::format("{} ({}): {}", visit.label, face.file, doubt);
  };
  for (const std::string& doubt : face.extent_doubts) face.doubts.push_back(of_visit(doubt));
  for (const Note& warning : recording.warnings) {
    const std::string text = with_file_name(warning.text, motion.source);
    if (session::doubts_figures(warning))
      face.doubts.push_back(of_visit(text));
    else
      face.remarks.push_back(text);
  }
  return face;
}

}  // namespace hyperex::visits
