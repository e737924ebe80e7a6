// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/session/inputs.hpp"
#include "hyperex/session/misplaced_points.hpp"
#include "hyperex/session/reading_warnings.hpp"
#include "hyperex/session/stillness.hpp"

namespace hyperex::session {

// Checks that the files of a scene belong together. The thresholds are calibrated on real data.

/// The face at rest that a recording is compared with.
struct FaceAtRest {
  const io::Landmarks& landmarks;
  std::string whose;            ///< "the scan", "an average face": for messages
  double least_moved_m = 3e-3;  ///< distance from rest that counts as a start in an expression
};

/// The canonical face, for a recording whose scan has no landmarks yet. Since it is not the
/// person's own, a start must be 6 mm from rest to count.
FaceAtRest average_face();

/// Throws InputError where the recording fits the face far better with left and right exchanged: at
/// its common points, after a similarity, more than 6 mm apart (root mean square), and less than
/// half of that with its points mirrored.
void check_sides(const motion::Motion& stabilised, const FaceAtRest& face);

/// `sides.doubtful`: the same fit is more than 5 mm and, with the points mirrored, less than 0.7 of
/// that, but check_sides does not refuse it. Nothing where it does, and where pairs contradict each
/// other (exchanged_warning).
std::optional<Note> sides_warning(const motion::Motion& stabilised, const FaceAtRest& face);

/// Whose points a recording has.
enum class PointsOf {
  person,  ///< measured, in lengths that are known
  camera,  ///< tracked, in lengths by its depth or by an assumed size
  model    ///< of an average face that expressions move
};

/// `recording.fits_badly`: the recording fits the scan badly, as with another face, another unit,
/// or points that share only their names: more than 5 mm rms where it has 20 common points or more,
/// else 10 mm; or a scale outside 0.95 to 1.05. Of a model 10 mm, of a model and of a camera 0.8 to
/// 1.25. Where the scale alone is outside, the sentence is about the size. `unit_note`:
/// Motion::unit_note; where the scale is that of another unit, inches among them, the warning names
/// it.
std::optional<Note> misfit_warning(const Misfit& fit, const std::string& unit_note,
                                   PointsOf points_of);

/// `recording.rescaled`: says so where alignment changes the lengths of the recording by more than
/// 3 %. `scale`: of the similarity from the recording to the scan, above 0.
std::optional<Note> rescaled_note(double scale);

/// `recording.starts_in_expression`: the recording seems to begin in the middle of an expression
/// (motion::started_in_expression). `of_weights`: of blend shapes, whose rest is known; never.
std::optional<Note> start_warning(const motion::Motion& stabilised, const FaceAtRest& face,
                                  bool of_weights);

/// `recording.ends_in_expression`: the recording seems to break off in the middle of an expression
/// (motion::ended_in_expression).
std::optional<Note> end_warning(const motion::Motion& stabilised);

/// start_warning by an average face, and end_warning, of a recording that no scene belongs to: the
/// first says to give a recording that begins at rest.
std::vector<Note> extent_warnings(const motion::Motion& stabilised);

/// "the recording lasts 2.7 s: 81 samples, 33.3 ms apart (median)".
std::string timing_sentence(const motion::Motion& m);

/// `recording.time_unit_doubtful`: times look like another unit, with a median step above 0.5 s or
/// more than ten minutes in all. Steps of keyframes (are_keyframes()) of weights may be longer.
std::optional<Note> timing_warning(const motion::Motion& m, Readings readings = Readings::measured);

/// `recording.coarse`: the median step is above 0.1 s, up to the bound of the former. Never of
/// keyframes of weights.
std::optional<Note> coarse_warning(const motion::Motion& m, Readings readings = Readings::measured);

/// `recording.short`: two to four samples at the times `time_s`, no keyframes of weights. A
/// recording of one is no motion.
std::optional<Note> short_warning(const std::vector<double>& time_s,
                                  Readings readings = Readings::measured);

/// Throws InputError where single pairs of points (face::mirrored_landmark) have their names
/// exchanged in the first sample. The vector between the points of such a pair is opposite to the
/// same vector on the face, after a similarity fitted to the common points, by more than half of
/// its length, and exchanging the two would bring both nearer to their places. Nothing where at
/// least half of the pairs are opposite (check_sides and exchanged_warning report that).
void check_pairs(const motion::Motion& stabilised, const FaceAtRest& face);

/// `sides.exchanged_pair`: names the pairs whose vector is opposite by less than that, as of points
/// that are set wrongly. Call check_pairs first. An opposite vector that no exchange of names
/// mends has a misplaced point: the warning says so unless misplaced_points() names that point.
/// Where at least half of the pairs are opposite and another is not, the pairs contradict each
/// other: it names both kinds, and which to exchange where one exchange fits twice as well as the
/// other.
std::optional<Note> exchanged_warning(const motion::Motion& stabilised, const FaceAtRest& face);

/// Throws InputError where nothing would move: the recording is one sample, or the run ends before
/// its second frame.
void check_length(const scene::Scene& scene, const motion::Motion& m);

/// `time.beyond_recording`: time.end_s is more than a second after the end of the recording, which
/// lasts `lasts_s` of the run; 0: not known.
std::optional<Note> beyond_recording_warning(const scene::Scene& scene, double lasts_s);

/// `time.end_of_run`: time.end_s is after time.start_s, as if both were the recording's seconds.
/// `lead_s`: what the run spends before time.start_s, in the recording's seconds.
std::optional<Note> end_of_run_note(const scene::Scene& scene, double lead_s);

/// Where the simulated skin is farthest from the scan on the face, that is within 25 mm of a
/// landmark; ears, neck and border may be far off.
struct SkinOff {
  double distance_mm = 0;  ///< 0 where there is no landmark
  std::string landmark;    ///< the nearest one to that place
  double beside_mm = 0;    ///< its distance from that place
};
SkinOff skin_off_scan(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// `skin.far_from_scan`, if that distance exceeds 5 mm.
std::optional<Note> skin_warning(const SkinOff& off);

}  // namespace hyperex::session
