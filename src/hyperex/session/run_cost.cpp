// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/run_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/size_text.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/session/drive_choice.hpp"
#include "hyperex/session/read_scan.hpp"
#include "hyperex/session/track_recording.hpp"

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
constexpr double kNodeSeconds = 6e-4, kWriteNodeSeconds = 6e-7;

// The following were measured on runs of the embedded face with a recorded range of motion of 134 s
// (10, 40 and 134 s of it), a smile of 2 s and a mouth opening of 2.7 s, held for up to 240 s.
// Other programs kept the processors busy, so the constants are a fifth below what was measured.

/// A step of the reduced model, whatever the number of nodes: its unknowns are some 20 where the
/// face holds or has one expression, about 210 (muscles) or 70 (displacement) in a long take.
constexpr double kMuscleStepSeconds = 1.2e-3, kDisplacementStepSeconds = 1.2e-4;
constexpr double kHeldStepSeconds = 2e-5;
/// A step of the full model per node, at kStepNodes nodes (docs/performance.md: 3.34 ms on 1.69
/// processors at 6396 nodes). The entries of its factor grow as the 4/3rd power of the nodes.
constexpr double kFullStepNodeSeconds = 8.8e-7, kStepNodes = 6396;
/// A frame of each vertex of the skin; with performance.glb or report.html besides. Both take more
/// where the recording has more shapes, which long ones have, up to about kVariedFrames frames.
constexpr double kFrameVertexSeconds = 2.5e-7, kPageFrameVertexSeconds = 1.2e-7;
constexpr double kVariedSeconds = 7e-10, kVariedFrames = 1000;
/// A frame in which something touches, per node: 0.8e-5 to 1.4e-5 in three runs of a smile and of
/// the range of motion, in which lips or cheeks touched something in 10 to 50 % of the frames.
constexpr double kContactFrameNodeSeconds = 1.5e-5;

// The reduced model of a noisy recording that muscles re-enact has more vectors: one per sample, up
// to kLoadShapes, and kGrowth ln(noise / (kNoNoise tolerance)) for each driven coordinate, with
// noise the jitter over the greatest motion. Measured on a smile of 3.1 s in a mesh of 5973 nodes:
// with a noise of 2 % 159 vectors for 7 points and 405 for 34, with 0.3 % 144 for 34. One of 9.4 s
// had 385 for 34. Each pass adds some kPassVectors and takes time for the steps of all vectors and
// for their products with the nodes' forces (reduced_model.cpp). Runs took 7 to 34 s of the
// processors, and with four variants 116 s; the forecast is 0.7 to 1 of that. Driven by
// displacement, 34 points took no longer than without noise.
constexpr double kLoadShapes = 250, kGrowth = 1.4, kNoNoise = 2.2;
constexpr double kPassVectors = 30, kPassInstants = 35;
constexpr double kStepWork = 14, kShapeWork = 6, kInstantWork = 15;  // operations
constexpr double kWorkSeconds = 2e-10;

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

/// The recording's part of the run and the part after it, in which the face is held.
struct RunParts {
  double moving_s = 0, held_s = 0;
};

/// What the noise of the driven points adds to their motion.
struct DriveNoise {
  double coordinates = 0;  ///< of the driven points
  double samples = 0;      ///< of the recording in the run
  double share = 0;        ///< the jitter over the greatest displacement; 0: none known
};

DriveNoise noise_of(const Inputs& inputs, double moving_s) {
  const motion::Motion& motion = inputs.motion.motion;
  DriveNoise noise;
  double greatest_m = 0;
  for (const std::string& name : inputs.driven) {
    const int row = motion.index_of(name);
    if (row < 0) continue;
    noise.coordinates += 3;
    for (const Points& now : motion.positions)
      greatest_m = std::max(greatest_m, (now.row(row) - motion.positions.front().row(row)).norm());
  }
  if (!(greatest_m > 0)) return noise;
  noise.share = inputs.jitter_m / greatest_m;
  for (const double time_s : motion.time_s)
    if (time_s - motion.time_s.front() <= moving_s) ++noise.samples;
  return noise;
}

/// Making the reduced model of a noisy recording, with `steps` that move.
double noisy_basis_seconds(const DriveNoise& noise, double tolerance, double steps, double nodes) {
  constexpr double most = 400;  // fem::ReducedOptions::most_vectors
  const double orders = kGrowth * std::log(noise.share / (kNoNoise * tolerance));
  if (!(orders > 0)) return 0;
  const double shapes = std::min(noise.samples, kLoadShapes);
  const double vectors = std::min(most, shapes + orders * noise.coordinates);
  const double mean = (shapes + vectors) / 2, passes = 1 + (vectors - shapes) / kPassVectors;
  const double of_steps = kStepWork * mean * mean * steps;
  const double of_nodes = 3 * nodes * mean * (kShapeWork * shapes + kInstantWork * kPassInstants);
  return kWorkSeconds * passes * (of_steps + of_nodes);
}

double steps_seconds(const scene::Scene& scene, const RunParts& parts, const DriveNoise& noise,
                     double nodes) {
  const double moving = parts.moving_s / scene.time.step_s, held = parts.held_s / scene.time.step_s;
  const double full_step = kFullStepNodeSeconds * nodes * std::cbrt(nodes / kStepNodes);
  if (scene.solver.method == simulate::SolverMethod::direct) return (moving + held) * full_step;
  const bool muscles = drive_choice(scene).by == simulate::DriveBy::muscles;
  const double exact = moving * (muscles ? kMuscleStepSeconds : kDisplacementStepSeconds);
  const double noisy =
      muscles ? noisy_basis_seconds(noise, scene.solver.tolerance, moving, nodes) : 0;
  return std::max(exact, noisy) + held * kHeldStepSeconds +
         (scene.solver.verify ? (moving + held) * full_step : 0);
}

/// performance.glb and report.html.
double pages_seconds(const scene::Scene& scene, const RunParts& parts, double frames, double skin) {
  const double varied = std::min(kVariedFrames, parts.moving_s * scene.time.frame_rate_hz);
  const int pages = int(scene.output.glb) + int(scene.output.report);
  return pages * frames * skin * (kPageFrameVertexSeconds + kVariedSeconds * varied);
}

/// Sets the times. At finite strain they are not known: the iterations depend on the motion.
void add_seconds(const scene::Scene& scene, const MeshSize& mesh, const RunParts& parts,
                 const DriveNoise& noise, RunCost& cost) {
  const scene::OutputOptions& output = scene.output;
  const double mesh_s = kNodeSeconds * mesh.nodes;
  const double motion_s = steps_seconds(scene, parts, noise, mesh.nodes) +
                          kFrameVertexSeconds * cost.frames * mesh.skin;
  const double pages_s = pages_seconds(scene, parts, cost.frames, mesh.skin);
  const double variant_s = 0.3 * mesh_s + motion_s;
  cost.variants_seconds = cost.variants * (variant_s + pages_s);
  cost.seconds = kOwnSeconds + kVertexSeconds * mesh.skin + mesh_s + motion_s + pages_s +
                 cost.variants_seconds;
  if (output.vtu) cost.seconds += kWriteNodeSeconds * cost.frames * mesh.nodes / output.vtu_every;
  if (output.error_budget)
    cost.budget_seconds = kBudgetRuns * (mesh_s + motion_s + cost.variants * variant_s);
  cost.seconds += cost.budget_seconds;
  if (scene.contact.any())
    cost.contact_seconds = kContactFrameNodeSeconds * cost.frames * mesh.nodes *
                           (1 + cost.variants) * (output.error_budget ? 1 + kBudgetRuns : 1);
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
  cost.guessed = !volume && inputs.landmarks.empty();
  cost.frames = simulate::frame_count(scene.time, end_s);
  cost.variants = double(scene.variants.size());
  cost.from_s = scene.motion.start_s;
  const double last_frame_s = (cost.frames - 1) / scene.time.frame_rate_hz,
               shown_s = (lasts_s > 0 ? std::min(last_frame_s, lasts_s) : last_frame_s) /
                         scene.motion.time_scale;
  cost.to_s = cost.from_s + std::max(0.0, shown_s - inputs.lead_s);
  cost.lead_s = inputs.lead_s;
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
  if (finite) return cost;
  const double moving_s = lasts_s > 0 ? std::min(end_s, lasts_s) : end_s;
  add_seconds(scene, mesh, {moving_s, end_s - moving_s}, noise_of(inputs, moving_s), cost);
  return cost;
}

std::optional<RunCost> cost_before_tracking(const scene::Scene& scene) {
  if (scene.motion.recording.empty())
    return expected_cost(scene, read_inputs(scene, Extent::quick), Extent::quick);
  Inputs inputs;
  read_scan(scene, inputs);
  if (const io::Landmarks given = given_landmarks(scene); !given.empty())
    complete_landmarks(scene, given, inputs.scan, inputs);
  inputs.lasts_s = expected_length_s(scene.motion);
  return expected_cost(scene, inputs, Extent::quick);
}

std::string sentence_of(const RunCost& cost) {
  std::string text = fmt::format("a run: {:.0f} frames, from {:.4g} s to {:.4g} s of the recording",
                                 cost.frames, cost.from_s, cost.to_s);
  if (cost.lead_s > 0)
    text += fmt::format(", led in from rest over the {:.4g} s before: frame 0 is at {:.4g} s",
                        cost.lead_s, cost.from_s - cost.lead_s);
  text += fmt::format("; about {} on disk", size_text(cost.disk_bytes));
  if (cost.frames_bytes > 0.5 * cost.disk_bytes)
    text += fmt::format(" (frames/, for ParaView: {})", size_text(cost.frames_bytes));
  text += fmt::format(", {} of memory", size_text(cost.memory_bytes));
  if (cost.guessed) text += " (a guess without landmarks)";
  if (cost.seconds == 0) return text + "; its duration is not known in advance";
  text += fmt::format(", {} on two idle processors", time_text(cost.seconds));
  if (cost.budget_seconds > 0)
    text += fmt::format(", {} of them for the error budget", time_text(cost.budget_seconds));
  if (cost.contact_seconds > 0)
    text += fmt::format("; contact adds up to {}, where something touches in every frame",
                        time_text(cost.contact_seconds));
  if (cost.variants > 0)
    text += fmt::format("; without {}, {} less (--no-variants)",
                        cost.variants == 1 ? "its variant" : "its variants",
                        time_text(cost.variants_seconds));
  return text;
}

namespace {

/// An estimate may be too low by a fifth.
constexpr double kSpare = 1.2;

/// The bound (GB) that allows `bytes` plus a fifth.
double allowing_gb(double bytes) {
  return std::ceil(1e-8 * kSpare * bytes) / 10;
}

/// "4.1 or more, which leaves 20 % to spare"
std::string spare_text(double bytes) {
  return fmt::format("{:.3g} or more, which leaves {:.0f} % to spare", allowing_gb(bytes),
                     100 * (kSpare - 1));
}

void check_disk(const scene::Scene& scene, const RunCost& cost, const std::vector<Note>& notes) {
  if (cost.disk_bytes <= 1e9 * scene.output.most_gb) return;
  // If the times are in milliseconds, the unit is the mistake to report, not the size.
  for (const Note& note : notes)
    if (note.id == "recording.time_unit_doubtful")
      throw InputError(
          scene::problem_at(scene, note.key, fmt::format("times in seconds ({})", note.text)));
  const std::string frames = fmt::format(
      ", of them {} for ParaView (output.vtu = false leaves these out, output.vtu_every = 10 takes "
      "a tenth; time.start_s and time.end_s shorten the run)",
      size_text(cost.frames_bytes));
  throw InputError(scene::problem_at(
      scene, "output.most_gb",
      fmt::format(
          "{}, as the run would write about {}{}", spare_text(cost.disk_bytes),
          size_text(cost.disk_bytes),
          cost.frames_bytes > 0 ? frames : " (time.start_s and time.end_s shorten the run)")));
}

void check_memory(const scene::Scene& scene, const RunCost& cost) {
  if (cost.memory_bytes <= 1e9 * scene.output.most_memory_gb) return;
  const bool by_frames = 2 * cost.motion_bytes > cost.memory_bytes;
  throw InputError(scene::problem_at(
      scene, "output.most_memory_gb",
      fmt::format("{}, as the run would take about {} of memory ({})",
                  spare_text(cost.memory_bytes), size_text(cost.memory_bytes),
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

int vtu_every_within_bound(const scene::Scene& scene, const RunCost& cost) {
  const double bound = 1e9 * scene.output.most_gb / kSpare;
  if (cost.disk_bytes <= bound) return 1;
  const double others = cost.disk_bytes - cost.frames_bytes;
  if (cost.frames_bytes <= 0 || others >= bound) return 1;
  constexpr double most = 10000;  // the bound of output.vtu_every
  return int(
      std::min(most, std::ceil(scene.output.vtu_every * cost.frames_bytes / (bound - others))));
}

std::optional<RunCost> checked_cost(const scene::Scene& scene, const Inputs& inputs, Extent extent,
                                    const tissue::VolumeMesh* volume) {
  std::optional<RunCost> cost = expected_cost(scene, inputs, extent, volume);
  if (cost) check_cost(scene, *cost, inputs.notes);
  return cost;
}

}  // namespace hyperex::session
