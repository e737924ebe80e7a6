// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// A quantity over the skin, as a parameter of the tissue.
struct SkinMap {
  std::string key = {};   ///< as the scene writes it: "young_kpa"
  std::string name = {};  ///< "Young's modulus"
  std::string unit = {};  ///< "kPa"
  /// Range over all maps of this key in the page, so that one colour bar serves all; least <=
  /// greatest.
  double least = 0, greatest = 0;
  Eigen::VectorXd values = {};  ///< a vertex of skin_rest, in `unit`
};

/// The same face with other tissue: mesh, rest shape and times as the scene's own.
struct ReportVariant {
  std::string name;
  std::vector<std::string> changes;          ///< what differs, "tissue.young_kpa = 1000"
  const simulate::Performance& performance;  ///< its landmarks are sampled as the scene's own
  DisplacementModes difference;              ///< of its displacement less the scene's own
  const metrics::SymmetryCurve* symmetry = nullptr;
  std::vector<SkinMap> tissue;  ///< keys as the scene's own
  /// Where muscles drive: its activations, a row each of the scene's MuscleCourse::groups.
  Eigen::MatrixXd group_activation = {};
};

/// A muscle on this face, for the view.
struct ReportMuscle {
  std::string name;   ///< "zyg_major_L"
  std::string latin;  ///< without side
  Points line;        ///< n x 3, from origin to insertion, at rest
};

/// What the page shows. References must outlive the call.
struct ReportInput {
  const simulate::Performance& performance;
  const io::Scan& scan;
  /// Modes of performance.skin_displacement_m; their error and half a step of each mode (1/65534 of
  /// its largest component, or at most a micrometre) are the accuracy of the replay.
  const DisplacementModes& modes;
  const metrics::SymmetryCurve* symmetry = nullptr;  ///< its plots are left out where null
  nlohmann::json summary = {};                       ///< an object; shown as tables
  std::vector<std::string> notes = {};               ///< warnings and remarks, a sentence each
  std::string title = {};
  /// Parameters that differ from place to place in any of the faces.
  std::vector<SkinMap> tissue = {};
  /// How far the scene's own skin is expected to be from the true one (key "uncertainty"); without
  /// values where that is not known.
  SkinMap uncertainty = {};
  std::vector<ReportVariant> variants = {};
  /// Where each vertex has its counterpart on the other side; no asymmetry is shown where null.
  const metrics::RestAsymmetry* mirror = nullptr;
  std::vector<ReportMuscle> muscles = {};  ///< where performance.muscles drive
  const anatomy::Teeth* teeth = nullptr;   ///< at rest, scan frame; null: none
};

/// What the page reads, its arrays in `block`: all of it, or without `face`, the parts that stay
/// the same however the face moves (skin, mirror, openings, eyeballs, teeth). Throws as
/// write_html_report.
nlohmann::json replay_manifest(const ReportInput& input, BinaryBlock& block, bool face = true);

/// Writes one HTML file that replays the performance in a browser without any network: the page
/// built from web/ with a JSON manifest (see web/src/replay/manifest.ts) and one base64 block of
/// little-endian arrays put into it. Throws InputError where the file cannot be written,
/// std::invalid_argument where performance, scan and modes do not belong together.
void write_html_report(const std::filesystem::path& file, const ReportInput& input);

}  // namespace hyperex::report
