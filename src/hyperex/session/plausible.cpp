// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/plausible.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hyperex/core/quantile.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/session/keyframes.hpp"
#include "hyperex/session/unit_that_fits.hpp"
#include "hyperex/simulate/drive/common_points.hpp"

namespace hyperex::session {
namespace {

constexpr double kLongestStep_s = 0.5;
constexpr double kMirroredRms_m = 6e-3, kMirroredShare = 0.5;
// Measured in six people and all their recordings by 4 to 90 points, against an average face: right
// names never fit better mirrored. Exchanged ones fit 0.06 to 0.6 times as far mirrored, 5.4 mm or
// more as they are; above 0.5 only without a corner of the mouth.
constexpr double kDoubtfulRms_m = 5e-3, kDoubtfulShare = 0.7;
// Names that are exchanged give -1, sound ones about 1; between lie points that are set wrongly.
constexpr double kSurelyExchanged = 0.5;
constexpr double kMisfit_mm = 10;
// By the 68 points: 3.1 to 3.9 mm between the three people of one rig, 5.3 to 8.8 mm in ten of
// eleven other pairs of people; of one person 0 (exact points) to 3.5 mm (a depth camera).
constexpr double kMisfitOfPeople_mm = 5;
constexpr std::size_t kManyCommon = 20;
struct Scales {
  double least, most;
};
// A camera's lengths rest on its depth or on an assumed distance between the eyes.
constexpr Scales kCameraScales{0.8, 1.25};
// By seven points: 0.98 to 1.01 of one person; of two people 0.87 to 1.11, outside these bounds in
// seven of ten pairs.
constexpr Scales kPointScales{0.95, 1.05};
/// How far one person's two sizes may be apart, as a factor, where a unit is to be found.
constexpr double kSameSize = 1.05;
// Measured: 1.7 to 2.1 mm on faces (embedded face, Spacetime, AnimFace). At ears, necks and ragged
// borders 10 mm are reached, but these are not part of the face (38 mm from the nearest landmark
// for subject A, 27 mm for humface).
constexpr double kSkinOff_mm = 5, kOfTheFace_m = 0.025;

std::pair<std::string, double> nearest_landmark(const io::Landmarks& landmarks, const Vec3& p) {
  std::pair<std::string, double> nearest{"", std::numeric_limits<double>::infinity()};
  for (const auto& [name, position] : landmarks)
    if (const double d = (position - p).norm(); d < nearest.second) nearest = {name, d};
  return nearest;
}

/// What a device cannot record, keyframes of weights state.
bool have_keyframes(const std::vector<double>& time_s, Readings readings) {
  return readings == Readings::of_weights && are_keyframes(time_s);
}

double misfit_m(const Points& recorded, const Points& scanned) {
  return rms_distance(fit_similarity(recorded, scanned).apply(recorded), scanned);
}

/// How far the common points are from those of the face, rms, after a similarity.
struct SidesFit {
  double as_is_m = 0, mirrored_m = 0;
};

/// Nothing where the points are too few or on a line.
std::optional<SidesFit> fit_of_sides(const motion::Motion& stabilised, const FaceAtRest& face) {
  auto [names, recorded, scanned] = simulate::common_points(stabilised, face.landmarks);
  if (recorded.rows() < 4 || spread_off_line(scanned) < 0.05) return std::nullopt;
  SidesFit fit;
  fit.as_is_m = misfit_m(recorded, scanned);
  recorded.col(0) *= -1;
  fit.mirrored_m = misfit_m(recorded, scanned);
  return fit;
}

bool are_exchanged(const SidesFit& fit) {
  return fit.as_is_m > kMirroredRms_m && fit.mirrored_m < kMirroredShare * fit.as_is_m;
}

/// "ibug68_48 and ibug68_54 (corner of the mouth)".
std::string pair_in_words(const std::string& name, const std::string& other) {
  const std::string words = face::name_in_words(name);  // "ibug68_48 (corner of the mouth, right)"
  const auto from = words.find('('), to = words.rfind(',');
  const bool known = from != std::string::npos && to != std::string::npos && from < to;
  return name + " and " + other + (known ? " " + words.substr(from, to - from) + ")" : "");
}

/// Pairs of points whose vector is opposite to that on the face, and the others.
struct ExchangedPairs {
  std::vector<std::string> surely;   ///< by more than half of its length there
  std::vector<std::string> perhaps;  ///< by less
  struct Other {
    std::string pair, farther;
    double off_m = 0;  ///< of the farther one from its place
  };
  /// Their exchange would not bring both nearer to their places: a point is wrong in another way.
  std::vector<Other> others;
  using Names = std::vector<std::array<std::string, 2>>;
  Names opposite, right;  ///< the former are surely or perhaps exchanged

  /// Opposite ones are fewer than right ones, so that the fit lies on the side of these.
  bool are_few() const { return opposite.size() + others.size() < right.size(); }
};

/// How far both points of a pair are from these places, m.
std::array<double, 2> off_places(const std::array<Vec3, 2>& points,
                                 const std::array<Vec3, 2>& places) {
  return {(points[0] - places[0]).norm(), (points[1] - places[1]).norm()};
}

ExchangedPairs pairs_by_place(const motion::Motion& stabilised, const FaceAtRest& face) {
  const auto [names, recorded, scanned] = simulate::common_points(stabilised, face.landmarks);
  if (recorded.rows() < 4 || spread_off_line(scanned) < 0.05) return {};
  const Similarity recording_from_face = fit_similarity(scanned, recorded);
  const auto of_recording = [&](const std::string& name) -> Vec3 {
    return stabilised.positions.front().row(stabilised.index_of(name)).transpose();
  };
  ExchangedPairs pairs;
  for (const std::string& name : stabilised.names) {
    const std::string other = face::mirrored_landmark(name);
    const auto here = face.landmarks.find(name), there = face.landmarks.find(other);
    if (!(name < other) || stabilised.index_of(other) < 0 || here == face.landmarks.end() ||
        there == face.landmarks.end())
      continue;
    const std::array<Vec3, 2> at = {of_recording(name), of_recording(other)},
                              places = {recording_from_face * here->second,
                                        recording_from_face * there->second};
    const Vec3 expected = places[1] - places[0];
    const double along = (at[1] - at[0]).dot(expected);
    const auto off_m = off_places(at, places), off_exchanged_m = off_places({at[1], at[0]}, places);
    const bool both_nearer = off_exchanged_m[0] < off_m[1] && off_exchanged_m[1] < off_m[0];
    if (along >= 0)
      pairs.right.push_back({name, other});
    else if (both_nearer)
      pairs.opposite.push_back({name, other});
    if (along < 0 && !both_nearer)
      pairs.others.push_back({pair_in_words(name, other), off_m[0] > off_m[1] ? name : other,
                              std::max(off_m[0], off_m[1]) / recording_from_face.scale});
    else if (along < -kSurelyExchanged * expected.squaredNorm())
      pairs.surely.push_back(pair_in_words(name, other));
    else if (along < 0)
      pairs.perhaps.push_back(pair_in_words(name, other));
  }
  return pairs;
}

/// None where at least half of the pairs are exchanged.
ExchangedPairs exchanged_pairs(const motion::Motion& stabilised, const FaceAtRest& face) {
  ExchangedPairs pairs = pairs_by_place(stabilised, face);
  return pairs.are_few() ? pairs : ExchangedPairs{};
}

std::string pairs_in_words(const ExchangedPairs::Names& pairs) {
  std::vector<std::string> words;
  for (const auto& [name, other] : pairs) words.push_back(pair_in_words(name, other));
  return fmt::format("{}", fmt::join(words, "; "));
}

/// The misfit with the names of these pairs exchanged, m.
double misfit_exchanged_m(const motion::Motion& stabilised, const FaceAtRest& face,
                          const ExchangedPairs::Names& pairs) {
  motion::Motion exchanged;
  exchanged.names = stabilised.names;
  exchanged.time_s = {0};
  exchanged.positions = {stabilised.positions.front()};
  for (const auto& [name, other] : pairs)
    std::swap(exchanged.names[std::size_t(stabilised.index_of(name))],
              exchanged.names[std::size_t(stabilised.index_of(other))]);
  const auto fit = fit_of_sides(exchanged, face);
  return fit ? fit->as_is_m : std::numeric_limits<double>::quiet_NaN();
}

/// Some pairs are opposite to those of the face, others are not, and the others are no majority.
/// Where exchanging the names of one kind fits far better, the warning advises it.
std::optional<Note> contradiction_warning(const motion::Motion& stabilised,
                                          const FaceAtRest& face) {
  const ExchangedPairs pairs = pairs_by_place(stabilised, face);
  if (pairs.are_few() || pairs.opposite.empty() || pairs.right.empty()) return std::nullopt;
  const double opposite_m = misfit_exchanged_m(stabilised, face, pairs.opposite),
               right_m = misfit_exchanged_m(stabilised, face, pairs.right);
  const double nearer_m = std::min(opposite_m, right_m);
  std::string which = "left and right cannot be told; correct the names";
  if (nearer_m < kMirroredShare * std::max(opposite_m, right_m))
    which = fmt::format(
        "exchange the names of {}, after which the points are {:.1f} mm rms from their places",
        pairs_in_words(opposite_m < right_m ? pairs.opposite : pairs.right), 1e3 * nearer_m);
  return make_warning(
      "sides.exchanged_pair",
      fmt::format("pairs of points contradict each other about left and right: {} lie the other "
                  "way round than on {}, {} do not; {} (L and R are the subject's own sides)",
                  pairs_in_words(pairs.opposite), face.whose, pairs_in_words(pairs.right), which));
}

/// `advice`: what to do, given the stretch that looks most like rest.
template <typename Advice>
std::optional<Note> start_warning_with(const motion::Motion& stabilised, const FaceAtRest& face,
                                       const Advice& advice) {
  const auto started =
      motion::started_in_expression(stabilised, face.landmarks, face.least_moved_m);
  if (!started) return std::nullopt;
  return make_warning(
      "recording.starts_in_expression",
      fmt::format(
          "the recording seems to start in an expression: from {:.2f} s to {:.2f} s the face is "
          "nearer to {}, which is at rest, than at the start ({} differs by {:.1f} mm); "
          "displacements are taken from the first sample, so {}",
          started->stretch.from_s, started->stretch.to_s, face.whose,
          face::name_in_words(started->point), 1e3 * started->distance_m,
          advice(started->stretch)));
}

}  // namespace

FaceAtRest average_face() {
  static const io::Landmarks landmarks = [] {
    const face::CanonicalFace& face = face::canonical_face();
    io::Landmarks all;
    for (const auto& entry : face.landmarks)
      all[entry.first] = face.landmark(entry.first, face.mesh.points);
    return all;
  }();
  return {landmarks, "an average face", 6e-3};
}

void check_sides(const motion::Motion& stabilised, const FaceAtRest& face) {
  const auto fit = fit_of_sides(stabilised, face);
  if (!fit || !are_exchanged(*fit)) return;
  motion::refuse(stabilised,
                 fmt::format("left and right are exchanged: the points are {:.1f} mm rms from "
                             "those of the same names on {}, and {:.1f} mm with one axis negated; "
                             "L and R are the subject's own sides, and the axes right-handed",
                             1e3 * fit->as_is_m, face.whose, 1e3 * fit->mirrored_m));
}

std::optional<Note> sides_warning(const motion::Motion& stabilised, const FaceAtRest& face) {
  const auto fit = fit_of_sides(stabilised, face);
  if (!fit || are_exchanged(*fit) || fit->as_is_m <= kDoubtfulRms_m ||
      fit->mirrored_m >= kDoubtfulShare * fit->as_is_m || contradiction_warning(stabilised, face))
    return std::nullopt;
  return make_warning(
      "sides.doubtful",
      fmt::format(
          "left and right may be exchanged: the points are {:.1f} mm rms from those of the "
          "same names on {}, and {:.1f} mm with one axis negated; L and R are the subject's "
          "own sides, and the axes right-handed",
          1e3 * fit->as_is_m, face.whose, 1e3 * fit->mirrored_m));
}

std::optional<Note> misfit_warning(const Misfit& fit, const std::string& unit_note,
                                   PointsOf points_of) {
  const double most_mm =
      points_of == PointsOf::model || fit.common < kManyCommon ? kMisfit_mm : kMisfitOfPeople_mm;
  const Scales scales = points_of == PointsOf::person ? kPointScales : kCameraScales;
  if (fit.rms_mm <= most_mm && fit.scale >= scales.least && fit.scale <= scales.most)
    return std::nullopt;
  const auto unit = unit_that_fits(1 / fit.scale, unit_note, kSameSize,
                                   "correct the unit there or in motion.unit");
  const std::string by_size = fmt::format(
      "the recording has not the size of the scan: it fits at a scale of {:.3f} (expected: {:g} to "
      "{:g}), and so laid its points are {:.1f} mm rms from the scan's landmarks of the same "
      "names, "
      "as is usual; {}",
      fit.scale, scales.least, scales.most, fit.rms_mm,
      unit.value_or("check that the unit is right and that both are of one person"));
  const std::string by_points = fmt::format(
      "the recording fits the scan badly: its points are {:.1f} mm rms from the scan's landmarks "
      "of "
      "the same names, at a scale of {:.3f} (expected: under {:g} mm, {:g} to {:g}); {}",
      fit.rms_mm, fit.scale, most_mm, scales.least, scales.most,
      unit.value_or("check that names, axes and unit are right and that both are of one person"));
  return make_warning("recording.fits_badly", fit.rms_mm <= most_mm ? by_size : by_points);
}

std::optional<Note> rescaled_note(double scale) {
  constexpr double same_share = 0.03;
  if (std::abs(scale - 1) <= same_share) return std::nullopt;
  return make_note(
      "recording.rescaled",
      fmt::format("results are in millimetres of the scan, which is {:.3f} times as large as the "
                  "face of the recording: in the recording's own millimetres they are {:.3f} times "
                  "as large (of one person both sizes agree within {:g} %)",
                  scale, 1 / scale, 100 * same_share));
}

std::optional<Note> start_warning(const motion::Motion& stabilised, const FaceAtRest& face,
                                  bool of_weights) {
  if (of_weights) return std::nullopt;
  return start_warning_with(stabilised, face, [](const motion::RestStretch& rest) {
    return fmt::format("say motion.rest_s = [{:.2f}, {:.2f}]", rest.from_s, rest.to_s);
  });
}

std::optional<Note> end_warning(const motion::Motion& stabilised) {
  const auto ended = motion::ended_in_expression(stabilised);
  if (!ended) return std::nullopt;
  return make_warning(
      "recording.ends_in_expression",
      fmt::format(
          "the recording ends in an expression: {} is farthest from its first place ({:.1f} "
          "mm) {}, and is still on its way; the expression may not be complete",
          face::name_in_words(ended->point), 1e3 * ended->distance_m,
          ended->before_end_s > 0 ? fmt::format("{:.2f} s before the end", ended->before_end_s)
                                  : "in the last sample"));
}

std::vector<Note> extent_warnings(const motion::Motion& stabilised) {
  std::vector<Note> warnings;
  motion::Motion named = stabilised;
  for (std::string& name : named.names) name = face::full_name(name);
  add(warnings, start_warning_with(named, average_face(), [](const motion::RestStretch&) {
        return std::string("give a recording that begins at rest");
      }));
  add(warnings, end_warning(named));
  return warnings;
}

std::string timing_sentence(const motion::Motion& m) {
  if (m.time_s.size() < 2) return "the recording has one sample";
  return fmt::format("the recording lasts {:.4g} s: {} samples, {:.4g} ms apart (median)",
                     m.time_s.back() - m.time_s.front(), m.time_s.size(),
                     1e3 * median_step(m.time_s));
}

std::optional<Note> timing_warning(const motion::Motion& m, Readings readings) {
  constexpr double longest_s = 600;
  if (m.time_s.size() < 2) return std::nullopt;
  const double lasts_s = m.time_s.back() - m.time_s.front(), step_s = median_step(m.time_s);
  const bool steps_are_sound = step_s <= kLongestStep_s || have_keyframes(m.time_s, readings);
  if (steps_are_sound && lasts_s <= longest_s) return std::nullopt;
  return make_warning(
      "recording.time_unit_doubtful",
      fmt::format(
          "the recording's time rises to {:.4g} s in steps of {:.3g} s (median; expected: at most "
          "{:g} s in all, steps of at most {:g} s): milliseconds? Time is in seconds",
          m.time_s.back(), step_s, longest_s, kLongestStep_s));
}

std::optional<Note> coarse_warning(const motion::Motion& m, Readings readings) {
  if (m.time_s.size() < 3 || have_keyframes(m.time_s, readings)) return std::nullopt;
  const double step_s = median_step(m.time_s);
  constexpr double smooth_s = motion::Motion::kSmoothUpTo_s;
  if (step_s <= smooth_s || step_s > kLongestStep_s) return std::nullopt;
  return make_warning(
      "recording.coarse",
      fmt::format("the recording has a sample every {:.2g} s (median): quicker motions "
                  "are lost: between two samples a point stays within the range of both places; "
                  "expected: at most {:g} s apart",
                  step_s, smooth_s));
}

std::optional<Note> short_warning(const std::vector<double>& time_s, Readings readings) {
  constexpr std::size_t least = 5;
  if (time_s.size() < 2 || time_s.size() >= least) return std::nullopt;
  if (have_keyframes(time_s, readings)) return std::nullopt;
  return make_warning(
      "recording.short",
      fmt::format("the recording has {} samples in {:.3g} s: what the face does between them is "
                  "interpolated, and speeds and jitter are not known (expected: {} or more)",
                  time_s.size(), time_s.back() - time_s.front(), least));
}

void check_pairs(const motion::Motion& stabilised, const FaceAtRest& face) {
  const ExchangedPairs pairs = exchanged_pairs(stabilised, face);
  if (pairs.surely.empty()) return;
  motion::refuse(
      stabilised,
      fmt::format("left and right are exchanged in {}: they lie the other way round than "
                  "on {}, while the other points do not; exchange their names (L and R "
                  "are the subject's own sides)",
                  fmt::join(pairs.surely, "; "), face.whose));
}

std::optional<Note> exchanged_warning(const motion::Motion& stabilised, const FaceAtRest& face) {
  if (auto contradiction = contradiction_warning(stabilised, face)) return contradiction;
  const ExchangedPairs pairs = exchanged_pairs(stabilised, face);
  if (!pairs.perhaps.empty())
    return make_warning(
        "sides.exchanged_pair",
        fmt::format("left and right seem to be exchanged in {}: they lie the other way round than "
                    "on {}, while the other points do not; L and R are the subject's own sides",
                    fmt::join(pairs.perhaps, "; "), face.whose));
  if (pairs.others.empty()) return std::nullopt;
  if (!misplaced_points(stabilised, face.landmarks).points.empty()) return std::nullopt;
  std::vector<std::string> named;
  for (const ExchangedPairs::Other& other : pairs.others)
    named.push_back(fmt::format("{}: {} lies {:.1f} mm from its place", other.pair, other.farther,
                                1e3 * other.off_m));
  return make_warning(
      "sides.exchanged_pair",
      fmt::format("points lie the other way round than on {}, and exchanging left and right would "
                  "not bring both to their places: {}; correct them in the recording, or leave "
                  "them out",
                  face.whose, fmt::join(named, "; ")));
}

void check_length(const scene::Scene& scene, const motion::Motion& m) {
  if (m.time_s.size() < 2)
    motion::refuse(
        m, "has one sample, which is the face at rest: nothing moves; expected two or more");
  const double frame_s = 1 / scene.time.frame_rate_hz;
  const double slack = 1e-9;
  if (scene.time.end_s > 0 && scene.time.end_s < frame_s - slack)
    throw InputError(
        scene::problem_at(scene, "time.end_s",
                          fmt::format("at least {:.4g} s, a frame at time.frame_rate_hz = {:g}: a "
                                      "shorter run shows the face at rest alone",
                                      frame_s, scene.time.frame_rate_hz)));
  const double lasts_s = m.time_s.back() - m.time_s.front();
  if (scene.time.end_s == 0 && lasts_s < frame_s - slack)
    motion::refuse(m, fmt::format("lasts {:.4g} s, less than a frame at time.frame_rate_hz = {:g}: "
                                  "expected more, or a higher rate",
                                  lasts_s, scene.time.frame_rate_hz));
}

std::optional<Note> beyond_recording_warning(const scene::Scene& scene, double lasts_s) {
  constexpr double most_held_s = 1;
  const double held_s = scene.time.end_s - lasts_s;
  if (lasts_s <= 0 || held_s <= most_held_s) return std::nullopt;
  return make_warning(
      "time.beyond_recording",
      fmt::format("time.end_s = {:g} s is {:.4g} s after the end of the recording: until then the "
                  "face is held as its last sample shows it (expected: at most {:.4g} s, or 0 to "
                  "end with the recording)",
                  scene.time.end_s, held_s, lasts_s + most_held_s));
}

std::optional<Note> end_of_run_note(const scene::Scene& scene, double lead_s) {
  const double start_s = scene.motion.start_s, end_s = scene.time.end_s;
  const double scale = scene.motion.time_scale;
  if (start_s <= 0 || end_s <= start_s) return std::nullopt;
  return make_note(
      "time.end_of_run",
      fmt::format("time.end_s = {0:g} is counted from the start of the run, and so stands for "
                  "{1:.4g} s of the recording; to end at {0:g} s of the recording, write {2:.4g}",
                  end_s, start_s - lead_s + end_s / scale, scale * (end_s - start_s + lead_s)));
}

SkinOff skin_off_scan(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  SkinOff worst;
  for (Eigen::Index v = 0; v < mesh.skin.points.rows(); ++v) {
    const auto& anchor = mesh.anchors[std::size_t(v)];
    Vec3 simulated = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      simulated += anchor.weight[k] * mesh.volume.outer.points.row(anchor.node[k]).transpose();
    const Vec3 scanned = mesh.skin.points.row(v);
    const double off_mm = 1e3 * (simulated - scanned).norm();
    if (off_mm <= worst.distance_mm) continue;
    const auto [name, distance_m] = nearest_landmark(landmarks, scanned);
    if (distance_m <= kOfTheFace_m) worst = {off_mm, name, 1e3 * distance_m};
  }
  return worst;
}

std::optional<Note> skin_warning(const SkinOff& off) {
  if (off.distance_mm <= kSkinOff_mm) return std::nullopt;
  return make_warning(
      "skin.far_from_scan",
      fmt::format(
          "the simulated skin is up to {:.1f} mm off the scan, {:.0f} mm from {}. Figures of "
          "driven points stay as recorded; those of other points within a centimetre of there, and "
          "of variants there, are less accurate. A smaller mesh.element_size_mm or a cleaner scan "
          "helps",
          off.distance_mm, off.beside_mm, face::name_in_words(off.landmark)));
}

}  // namespace hyperex::session
