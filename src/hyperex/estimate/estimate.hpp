// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/estimate/assumptions.hpp"
#include "hyperex/estimate/intervals.hpp"
#include "hyperex/estimate/observation.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::estimate {

/// A recording of the relaxed upright face, at the end with a weight that hangs from its skin.
struct HungWeight {
  std::filesystem::path recording;
  std::string point;  ///< a landmark of the scan
  double mass_kg = 0;
};

/// What the user wants to know.
struct Request {
  /// Recordings of the same face beside the scene's, each of another expression, of the same
  /// kind: points, or weights where the scene has motion.arkit.
  std::vector<std::filesystem::path> recordings;
  /// Parts of the tissue: "cheek_L:cheek_R" is the ratio of two, "cheek_L" that of a part to what
  /// the scene has there, "tissue.region[0]" that of an entry of the scene, as a scar or a painted
  /// part.
  std::vector<std::string> stiffness;
  std::vector<std::string> gains;  ///< "zygomatic_R", as muscles.gain
  /// Known loads on the relaxed face; then the stiffness of its tissue is found too. Points over
  /// time, upright in the first sample and lying face up at the end; empty: none. One recording of
  /// each load: errors of the model are the same in another.
  std::filesystem::path lying;
  std::vector<HungWeight> weights;
  Assumptions assumptions;
};

/// One answer.
struct Finding {
  enum class Kind { ratio, gain, young } kind = Kind::ratio;
  std::string name;
  double value = 1;  ///< of Young's modulus: kPa, as all in this struct
  Range interval;    ///< 95 %, by profile likelihood
  Range laplace;     ///< 95 %, from the curvature
  /// Whether the interval is narrow enough to be an answer: a ratio or Young's modulus known
  /// to a factor of kWidestRatio from end to end, a gain to kWidestGain. Where it is not, the
  /// interval may still exclude 1, and so show on which side a ratio or a gain lies.
  bool determined = false;
  std::vector<ErrorPart> parts;  ///< largest first
  /// The standard expression whose recording is expected to narrow the interval most, and to what;
  /// empty where none narrows it by a tenth.
  std::string further;
  Range further_interval;
};

/// Two quantities that move the observed points alike.
struct Alike {
  std::string a, b;
  double cosine = 0;  ///< between the points' derivatives, in units of their errors
};
inline constexpr double kAlike = 0.9;

struct Estimate {
  /// Ratios, then gains, in the order of the request; then Young's modulus.
  std::vector<Finding> findings;
  std::vector<Alike> alike;  ///< pairs whose |cosine| is kAlike or more
  std::vector<Observation> recordings;
  std::vector<std::string> points;
  double scenes_young_kpa = 0;       ///< of the soft tissue in the scene
  double rms_m = 0;                  ///< observed less modelled, of a coordinate
  double error_scale = 1;            ///< Mode::error_scale
  std::vector<std::string> remarks;  ///< sentences
};

/// Finds ratios of stiffness and gains of muscles that explain recordings of a face. The muscles'
/// forces are free but for their priors; both sides are assumed to be tried alike (posterior.hpp).
/// Throws InputError for a request that names nothing, an unknown part or muscle, and for absolute
/// stiffness without a known load.
Estimate estimate(const scene::Scene& scene, const Request& request);

}  // namespace hyperex::estimate
