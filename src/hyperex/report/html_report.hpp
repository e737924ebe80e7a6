// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/report/displacement_modes.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

struct FaceBacking;

/// A quantity on the skin, such as a parameter of the tissue.
struct SkinMap {
  std::string key = {};   ///< as the scene writes it: "young_kpa"
  std::string name = {};  ///< "Young's modulus"
  std::string unit = {};  ///< "kPa"
  /// Range over all maps of this key in the page, so that they share one colour bar; least <=
  /// greatest.
  double least = 0, greatest = 0;
  Eigen::VectorXd values = {};  ///< one per vertex of skin_rest, in `unit`
};

/// The same face with other tissue: mesh, rest shape and times as the scene's own.
struct ReportVariant {
  std::string name;
  std::vector<std::string> changes;          ///< what differs, "tissue.young_kpa = 1000"
  const simulate::Performance& performance;  ///< its landmarks are sampled as the scene's own
  DisplacementModes difference;              ///< of its displacement minus that of the scene itself
  const metrics::SymmetryCurve* symmetry = nullptr;
  std::vector<SkinMap> tissue;  ///< keys as the scene's own
  /// If muscles drive: its activations, one row for each of the scene's MuscleCourse::groups.
  Eigen::MatrixXd group_activation = {};
};

/// A muscle on this face, for the view.
struct ReportMuscle {
  std::string name;   ///< "zyg_major_L"
  std::string latin;  ///< without side
  Points line;        ///< n x 3, from origin to insertion, at rest
  Points sheet = {};  ///< as muscles::MuscleShape::sheet, at rest; no rows: none
};

/// The contents of the page. References must outlive the call.
struct ReportInput {
  const simulate::Performance& performance;
  const io::Scan& scan;
  /// Modes of performance.skin_displacement_m; their error and half a step of each mode (1/65534 of
  /// its largest component, or at most a micrometre) are the accuracy of the replay.
  const DisplacementModes& modes;
  const metrics::SymmetryCurve* symmetry = nullptr;  ///< null: no plots of it
  nlohmann::json summary = {};                       ///< an object; shown as tables
  std::vector<std::string> notes = {};               ///< warnings and remarks, a sentence each
  std::string title = {};
  /// Parameters that differ from place to place in any of the faces.
  std::vector<SkinMap> tissue = {};
  /// Expected distance of the scene's own skin from the true one (key "uncertainty"); without
  /// values if it is not known.
  SkinMap uncertainty = {};
  std::vector<ReportVariant> variants = {};
  /// The counterpart of each vertex on the other side; null: asymmetry is not shown.
  const metrics::RestAsymmetry* mirror = nullptr;
  std::vector<ReportMuscle> muscles = {};  ///< where performance.muscles drive
  const anatomy::Teeth* teeth = nullptr;   ///< at rest, scan frame; null: none
  /// face_backing() of performance and teeth where the caller has it; null: it is made.
  const FaceBacking* backing = nullptr;
  face::SkinTone skin_tone = face::SkinTone::light;  ///< where the scan has no colours
};

/// The data that the page reads; arrays are appended to `block`. If `face` is false, the parts that
/// do not depend on the motion are left out (skin, mirror, openings, eyeballs, teeth). Throws as
/// write_html_report.
nlohmann::json replay_manifest(const ReportInput& input, BinaryBlock& block, bool face = true);

/// Writes one HTML file that replays the performance in a browser without any network: the page
/// built from web/ with a JSON manifest (see web/src/replay/manifest.ts) and one base64 block of
/// little-endian arrays put into it. Throws InputError where the file cannot be written,
/// std::invalid_argument where performance, scan and modes do not belong together.
void write_html_report(const std::filesystem::path& file, const ReportInput& input);

}  // namespace hyperex::report
