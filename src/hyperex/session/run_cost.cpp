// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/run_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::session {
namespace {

// Measured on runs of the canonical face, 30 to 1200 frames, elements of 3 and 3.3 mm.

/// Nodes of the skin side over area / (element size)^2; triangles over nodes; the elements grow
/// away from the mouth.
constexpr double kNodesOfArea = 0.51, kTrianglesOfNodes = 1.93;
/// Bytes of a compressed frame for ParaView: for each node; for each tetrahedron its corners and
/// stress; its strain; at finite strain stress and stretches besides.
constexpr double kNodeBytes = 12.5, kTetBytes = 13.2, kStrainBytes = 24, kFiniteBytes = 60;
/// Other files of each face, measured on faces of 7,000 and 36,000 vertices, in bytes: pictures;
/// tables per frame (5 to 80 kB, by the number of points and muscles); a PLY file per vertex;
/// performance.glb per vertex and pose. That file has at most kPoses poses.
constexpr double kPictureBytes = 1.7e6, kTableBytes = 20e3, kPlyBytes = 46;
constexpr double kPoseBytes = 22, kPoses = 24;
/// The report's page; of each face in it each vertex and each frame.
constexpr double kPageBytes = 0.7e6, kPageVertexBytes = 150, kPageFrameBytes = 8e3;
/// Memory in bytes: of the program itself, per vertex of the skin, and per node of the tissue. Nine
/// runs (three faces, elements of 5, 3.3 and 2.2 mm, 2,200 to 14,400 nodes) took 0.28 to 2.00 GB;
/// the estimate is within 15 % of each.
constexpr double kOwnMemory = 0.03e9, kVertexMemory = 1.5e3, kNodeMemory = 120e3;
/// The processors' seconds of those nine runs (2.1 to 17.8) are 0.7 to 1.4 of the estimate.
constexpr double kOwnSeconds = 0.7, kVertexSeconds = 5e-5;
constexpr double kNodeSeconds = 6e-4, kFrameNodeSeconds = 8e-7, kWriteNodeSeconds = 6e-7;

/// An error budget, relative to a run without outputs: twelve runs, of which five share the mesh
/// and one is of the other law.
constexpr double kBudgetRuns = 7;

struct MeshSize {
  double nodes = 0, tets = 0, skin = 0;
};

MeshSize size_of(const scene::Scene& scene, const Inputs& inputs,
                 const tissue::VolumeMesh* volume) {
  const auto vertices = double(inputs.scan.mesh.points.rows());
  const double skin = std::min(vertices, double(tissue::thinned_above_vertices));
  if (volume) return {double(volume->nodes.rows()), double(volume->tets.rows()), skin};
  const tissue::TissueMeshOptions& mesh = scene.mesh;
  const double surface =
      inputs.landmarks.empty()
          ? kNodesOfArea * triangle_areas(inputs.scan.mesh).sum() /
                (mesh.element_size_m * mesh.element_size_m)
          : tissue::expected_surface_nodes(inputs.scan.mesh, inputs.landmarks, mesh);
  return {surface * (mesh.layers + 1), 3 * mesh.layers * kTrianglesOfNodes * surface, skin};
}

/// Size of the files of all faces, without frames/.
double files_bytes(const scene::OutputOptions& output, double frames, double skin, double faces) {
  double each = kPictureBytes + kTableBytes * frames + kPlyBytes * skin;
  if (output.glb)
    each += std::min(1e6 * output.glb_max_mb, kPoseBytes * skin * (1 + std::min(frames, kPoses)));
  if (output.report) each += kPageVertexBytes * skin + kPageFrameBytes * frames;
  return faces * each + (output.report ? kPageBytes : 0);
}

/// Without the frames.
double memory_of(const MeshSize& mesh) {
  return kOwnMemory + kVertexMemory * mesh.skin + kNodeMemory * mesh.nodes;
}

std::string size_text(double bytes) {
  if (bytes < 1e8) return fmt::format("{:.0f} MB", std::max(1.0, bytes / 1e6));
  return bytes < 1e10 ? fmt::format("{:.2f} GB", bytes / 1e9)
                      : fmt::format("{:.0f} GB", bytes / 1e9);
}

std::string time_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  return seconds < 6000 ? fmt::format("{:.1f} min", seconds / 60)
                        : fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::optional<RunCost> expected_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                     const tissue::VolumeMesh* volume) {
  const auto& times = inputs.motion.motion.time_s;
  const bool whole = scene.motion.recording.empty() || extent == Extent::full;
  const double lasts_s = whole && times.size() > 1 ? times.back() - times.front() : inputs.lasts_s;
  if (scene.time.end_s <= 0 && lasts_s <= 0) return std::nullopt;
  const double end_s = scene.time.end_s > 0 ? scene.time.end_s : lasts_s;
  const MeshSize mesh = size_of(scene, inputs, volume);
  const scene::OutputOptions& output = scene.output;
  const bool finite = scene.model.strain == simulate::Strain::finite;

  RunCost cost;
  cost.nodes = mesh.nodes;
  cost.frames = std::max(1.0, std::ceil(end_s * scene.time.frame_rate_hz - 1e-6));
  cost.variants = double(scene.variants.size());
  cost.from_s = scene.motion.start_s;
  const double shown_s = (lasts_s > 0 ? std::min(end_s, lasts_s) : end_s) / scene.motion.time_scale;
  cost.to_s = cost.from_s + std::max(0.0, shown_s - inputs.lead_s);
  const double faces = 1 + cost.variants;
  if (output.vtu) {
    const double strain = output.vtu_strain ? finite ? kFiniteBytes : kStrainBytes : 0;
    const double each = kNodeBytes * mesh.nodes + (kTetBytes + strain) * mesh.tets;
    cost.frames_bytes =
        each * std::ceil(cost.frames / output.vtu_every) * (output.variants_vtu ? faces : 1);
  }
  cost.disk_bytes = cost.frames_bytes + files_bytes(output, cost.frames, mesh.skin, faces);
  // In single precision, of skin and nodes; twins keep the skin alone.
  cost.motion_bytes = 12 * faces * cost.frames * (mesh.skin + mesh.nodes);
  cost.memory_bytes = memory_of(mesh) + cost.motion_bytes;
  if (output.error_budget) cost.memory_bytes += memory_of(mesh);  // of one more face at a time
  if (finite || scene.contact.any()) return cost;
  const double each_s = kFrameNodeSeconds * cost.frames * mesh.nodes;
  cost.variants_seconds = cost.variants * (0.3 * kNodeSeconds * mesh.nodes + each_s);
  cost.seconds = kOwnSeconds + kVertexSeconds * mesh.skin + kNodeSeconds * mesh.nodes + each_s +
                 cost.variants_seconds +
                 (output.vtu ? kWriteNodeSeconds * cost.frames * mesh.nodes / output.vtu_every : 0);
  if (output.error_budget)
    cost.budget_seconds =
        kBudgetRuns * (kNodeSeconds * mesh.nodes + each_s + cost.variants_seconds);
  cost.seconds += cost.budget_seconds;
  return cost;
}

std::string sentence_of(const RunCost& cost) {
  std::string text = fmt::format(
      "a run: {:.0f} frames, from {:.4g} s to {:.4g} s of the recording; about {} on disk",
      cost.frames, cost.from_s, cost.to_s, size_text(cost.disk_bytes));
  if (cost.frames_bytes > 0.5 * cost.disk_bytes)
    text += fmt::format(" (frames/, for ParaView: {})", size_text(cost.frames_bytes));
  text += fmt::format(", {} of memory", size_text(cost.memory_bytes));
  if (cost.seconds == 0) return text + "; its duration is not known in advance";
  text += fmt::format(", {} on two idle processors", time_text(cost.seconds));
  if (cost.budget_seconds > 0)
    text += fmt::format(", {} of them for the error budget", time_text(cost.budget_seconds));
  if (cost.variants > 0)
    text += fmt::format("; without {}, {} less (--no-variants)",
                        cost.variants == 1 ? "its variant" : "its variants",
                        time_text(cost.variants_seconds));
  return text;
}

namespace {

/// The bound (GB) that allows `bytes` plus a fifth.
double allowing_gb(double bytes) {
  return std::ceil(1.2e-8 * bytes) / 10;
}

void check_disk(const scene::Scene& scene, const RunCost& cost, const std::vector<Note>& notes) {
  if (cost.disk_bytes <= 1e9 * scene.output.most_gb) return;
  // If the times are in milliseconds, the unit is the mistake to report, not the size.
  for (const Note& note : notes)
    if (note.id == "recording.time_unit_doubtful")
      throw InputError(scene::problem_at(
          scene, note.key,
          fmt::format("times in seconds ({}); where they are, output.most_gb = {:.3g} or more",
                      note.text, allowing_gb(cost.disk_bytes))));
  const std::string frames = fmt::format(
      ", of them {} for ParaView (output.vtu = false leaves these out, output.vtu_every = 10 takes "
      "a tenth; time.start_s and time.end_s shorten the run)",
      size_text(cost.frames_bytes));
  throw InputError(scene::problem_at(
      scene, "output.most_gb",
      fmt::format(
          "{:.3g} or more, as the run would write about {}{}", allowing_gb(cost.disk_bytes),
          size_text(cost.disk_bytes),
          cost.frames_bytes > 0 ? frames : " (time.start_s and time.end_s shorten the run)")));
}

void check_memory(const scene::Scene& scene, const RunCost& cost) {
  if (cost.memory_bytes <= 1e9 * scene.output.most_memory_gb) return;
  const bool by_frames = 2 * cost.motion_bytes > cost.memory_bytes;
  throw InputError(scene::problem_at(
      scene, "output.most_memory_gb",
      fmt::format("{:.3g} or more, as the run would take about {} of memory ({})",
                  allowing_gb(cost.memory_bytes), size_text(cost.memory_bytes),
                  by_frames ? "time.start_s and time.end_s shorten it, --no-variants leaves its "
                              "variants out"
                            : fmt::format("for a mesh of {:.0f} nodes; a larger "
                                          "mesh.element_size_mm needs fewer",
                                          cost.nodes))));
}

}  // namespace

void check_cost(const scene::Scene& scene, const RunCost& cost, const std::vector<Note>& notes) {
  check_disk(scene, cost, notes);
  check_memory(scene, cost);
}

std::optional<RunCost> checked_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                    const tissue::VolumeMesh* volume) {
  std::optional<RunCost> cost = expected_cost(scene, inputs, extent, volume);
  if (cost) check_cost(scene, *cost, inputs.notes);
  return cost;
}

}  // namespace hyperex::session
