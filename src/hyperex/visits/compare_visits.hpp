// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/metrics/error_budget.hpp"
#include "hyperex/visits/measured_face.hpp"
#include "hyperex/visits/measures.hpp"
#include "hyperex/visits/read_visits.hpp"

namespace hyperex::visits {

/// 95 % of the differences between two performances of a smile are below this: the minimal
/// detectable change of a posed smile repeated after a week, mean over the face, of 12 adults
/// (Tanikawa and Takada, Angle Orthod. 88, 2018, 319).
inline constexpr double kUsualRepetition_m = 1.5e-3;

/// A measure of one recording, to first order in its errors: each part is g' C g, with g the
/// derivative of the measure by the points or the pose, and C the covariance of that error.
struct Estimate {
  double value = 0;  ///< NaN: not measured
  metrics::ErrorBudget errors;
};
/// `repetition_m`: as VisitsFile has it. The person's own variation is taken as an error of each
/// point at the peak, independent between points and equal in all directions. For a measure of the
/// face at rest it is an error of the points at rest.
Estimate estimate(const Measure& measure, const MeasuredFace& face, double repetition_m);

struct Interval {
  double low = 0, high = 0;
};

/// A measure at one visit: the mean of its recordings.
struct VisitValue {
  double value = 0;
  std::optional<Interval> measured;  ///< 95 %, by measurement alone; nothing: unknown
  int recordings = 0;                ///< that measure it
  metrics::ErrorBudget errors;       ///< of the mean
};

enum class Beyond { no, yes, cannot_tell };

/// The difference of a visit from the first.
struct Change {
  double value = 0;
  std::optional<Interval> all = {};  ///< 95 %, with repetition; nothing: unknown, as `measured` is
  std::optional<Interval> measured = {};  ///< 95 %, by measurement alone; nothing: unknown
  /// Whether 0 lies outside `all`. If a part of the measurement's error is unknown, a change within
  /// repetition and the known parts is `no`, and one beyond them is cannot_tell.
  Beyond beyond = Beyond::no;
  bool within_repetition = false;  ///< whether it is within repetition alone
  std::string largest;             ///< the largest part of the error
};

struct MeasureOverVisits {
  Measure measure;
  std::vector<std::optional<VisitValue>> values;  ///< one per visit; nothing: not measured
  /// One per visit; nothing for the first, and where a visit's face has another scale than that of
  /// the first recording.
  std::vector<std::optional<Change>> changes;
  /// Standard deviation between the recordings of one visit, in the measure's unit; 0: too few.
  double recorded_repetition = 0;
};

/// A measure whose value at each visit is known by itself; nothing: not measured. Its change has
/// the interval of both estimates' errors.
MeasureOverVisits over_visits(const Measure& measure,
                              const std::vector<std::optional<Estimate>>& visits);

struct Comparison {
  VisitsFile file;
  std::vector<std::vector<MeasuredFace>> faces;  ///< by visit and recording
  std::vector<MeasureOverVisits> measures;       ///< those that some visit has
  double repetition_m = 0;
  std::vector<std::string> scan_remarks;  ///< what was guessed of scans, sentences
  /// Whether the repetition is measured from the visits' own recordings, which takes three or more
  /// visits' recordings beyond the first of each visit.
  bool repetition_measured = false;
};

/// Compares each visit with the first, unless a face of either has another scale
/// (MeasuredFace::other_scale). `faces`: by visit and recording, one or more per visit. With
/// several recordings per visit, at least kLeastFreedom of them beyond each visit's first, the
/// standard deviation s within visits is measured, and a change has the interval t s sqrt(1/n_1 +
/// 1/n_k), t by Student for that many degrees of freedom, but at least that of the measurement.
Comparison compare(const VisitsFile& file, std::vector<std::vector<MeasuredFace>> faces);

/// Measures all recordings and scans and compares the visits. `progress`: called with the number of
/// recordings measured. Throws InputError.
Comparison compare_visits(const VisitsFile& file,
                          const std::function<void(std::size_t)>& progress = {});

inline constexpr int kLeastFreedom = 3;

/// "no", "yes", "cannot tell".
std::string words_of(Beyond beyond);

}  // namespace hyperex::visits
