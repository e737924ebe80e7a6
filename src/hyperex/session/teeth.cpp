// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/teeth.hpp"

#include <fmt/format.h>

#include <utility>

#include "hyperex/anatomy/teeth/teeth_fit.hpp"
#include "hyperex/anatomy/teeth/tongue.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/close_mesh.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::session {
namespace {

/// A jaw's scan is a few centimetres across and some way behind the lips.
constexpr double kLargest_m = 0.15, kSmallest_m = 0.01, kFarthest_m = 0.08;

TriMesh read_jaw(const scene::Scene& scene, const std::string& key,
                 const std::filesystem::path& file, io::LengthUnit unit,
                 const io::Landmarks& landmarks, std::vector<Note>& notes) {
  TriMesh mesh = io::read_mesh(file, unit);
  const auto refuse = [&](const std::string& expected) {
    throw InputError(scene::problem_at(scene, key, expected));
  };
  const Vec3 low = mesh.points.colwise().minCoeff(), high = mesh.points.colwise().maxCoeff();
  const double across = (high - low).maxCoeff();
  if (across < kSmallest_m || across > kLargest_m)
    refuse(
        fmt::format("the teeth of one jaw, {:g} to {:g} mm across (this is {:.3g} mm; teeth.unit "
                    "states its unit)",
                    1e3 * kSmallest_m, 1e3 * kLargest_m, 1e3 * across));
  if (const auto upper = landmarks.find(face::ibug(62)), lower = landmarks.find(face::ibug(66));
      upper != landmarks.end() && lower != landmarks.end()) {
    const double off = ((low + high) / 2 - (upper->second + lower->second) / 2).norm();
    if (off > kFarthest_m)
      refuse(
          fmt::format("teeth that lie in the frame of the scan, behind the lips (this lies {:.0f} "
                      "mm from them)",
                      1e3 * off));
  }
  const Closing closing = close_mesh(mesh);
  if (!closing.why_not.empty())
    refuse("a closed surface, or one that can be closed: " + closing.why_not);
  if (closing.borders > 0)
    notes.push_back(
        make_note("teeth.closed",
                  fmt::format("{} ({}): {} border{} filled, the longest of {:.0f} mm", key,
                              file.string(), closing.borders,
                              closing.borders > 1 ? "s were" : " was", 1e3 * closing.longest_m),
                  key));
  return mesh;
}

}  // namespace

anatomy::Teeth read_teeth(const scene::Scene& scene, io::LengthUnit scan_unit,
                          const io::Landmarks& landmarks, std::vector<Note>& notes) {
  const scene::TeethOptions& options = scene.teeth;
  const io::LengthUnit unit = options.unit.value_or(scan_unit);
  anatomy::Teeth out;
  if (!options.upper.empty())
    out.upper.crowns = read_jaw(scene, "teeth.upper", options.upper, unit, landmarks, notes);
  if (!options.lower.empty())
    out.lower.crowns = read_jaw(scene, "teeth.lower", options.lower, unit, landmarks, notes);
  return out;
}

std::shared_ptr<const anatomy::Teeth> teeth_of(const scene::Scene& scene, const Inputs& inputs,
                                               const tissue::TissueMesh& mesh,
                                               std::vector<Note>& notes) {
  auto teeth = std::make_shared<anatomy::Teeth>(inputs.teeth);
  const bool wanted = scene.teeth.shape == scene::TeethShape::arch;
  if (wanted && (teeth->upper.empty() || teeth->lower.empty())) {
    anatomy::TeethFit fit =
        anatomy::fit_teeth(mesh.volume.outer, tissue::boundary_of(mesh.volume), inputs.landmarks);
    if (!fit.why_none.empty()) {
      notes.push_back(
          make_note("teeth.none", "no teeth were fitted behind the lips: " + fit.why_none));
    } else {
      notes.push_back(make_note(
          "teeth.average",
          fmt::format(
              "average teeth (scale {:.2f}{}) were fitted behind the lips, edges {:.1f} mm behind "
              "the line where the lips meet; teeth.upper and teeth.lower read scans of teeth",
              fit.size.scale,
              fit.size.breadth < 1 ? fmt::format(", arches {:g} of their breadth", fit.size.breadth)
                                   : "",
              1e3 * fit.behind_lips_m)));
      if (teeth->upper.empty()) teeth->upper = std::move(fit.teeth.upper);
      if (teeth->lower.empty()) teeth->lower = std::move(fit.teeth.lower);
    }
  }
  if (teeth->upper.empty() && teeth->lower.empty()) return nullptr;
  if (const auto frame = face::face_frame_of_corners(inputs.landmarks))
    teeth->tongue = anatomy::tongue_in(*teeth, *frame);
  return teeth;
}

}  // namespace hyperex::session
