// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.hpp"
#include "described_option.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/io/vtu.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::cli {
namespace {

constexpr const char* kThickness = "thickness (mm)";

struct MeshOptions {
  std::filesystem::path scan, landmarks, out;
  std::string unit;
  tissue::TissueMeshOptions mesh;
};

/// NAME_landmarks.json or NAME.mrk.json beside NAME.ply; empty where there is neither.
std::filesystem::path landmarks_beside(const std::filesystem::path& scan) {
  const auto stem = scan.stem().string();
  for (const std::string& name : {stem + "_landmarks.json", stem + ".mrk.json"})
    if (const auto file = scan.parent_path() / name; std::filesystem::exists(file)) return file;
  return {};
}

/// Reads the landmarks from `file`; if there is no file, finds them on the scan.
io::Landmarks landmarks_of(const io::Scan& scan, const std::filesystem::path& file) {
  if (!file.empty()) return io::read_landmarks(file);
  std::vector<Note> notes;
  auto found =
      session::find_landmarks(scan, "no landmarks beside the scan, and no --landmarks", notes);
  for (const Note& note : notes) std::cerr << note.text << '\n';
  return found;
}

void print(const tissue::TissueMesh& mesh, const std::filesystem::path& out) {
  const auto& q = mesh.quality;
  for (const Note& note : mesh.notes) std::cout << note.text << '\n';
  std::cout << fmt::format(
      "{} nodes, {} tetrahedra, {:.1f} cm^3\n"
      "volume of a tetrahedron: least {:.3f} mm^3, mean {:.2f} mm^3\n"
      "dihedral angles: {:.1f} to {:.1f} degrees; worst radius ratio {:.4f}\n"
      "least dihedral angle of a tetrahedron:",
      mesh.volume.nodes.rows(), mesh.volume.tets.rows(), q.total_volume_mm3 / 1000,
      q.least_volume_mm3, q.mean_volume_mm3, q.least_dihedral_deg, q.greatest_dihedral_deg,
      q.worst_radius_ratio);
  for (std::size_t b = 0; b < q.least_dihedral_shares.size(); ++b)
    std::cout << fmt::format("  {:g}-{:g} deg {:.1f} %", tissue::dihedral_bounds_deg[b],
                             tissue::dihedral_bounds_deg[b + 1], 100 * q.least_dihedral_shares[b]);
  std::cout << fmt::format(
      "\nscan to the outer surface: mean {:.3f} mm, greatest {:.2f} mm\nwritten to {}\n",
      mesh.mean_distance_mm, mesh.max_distance_mm, printable(out.string()));
}

void run(const MeshOptions& options) {
  const auto file = options.landmarks.empty() ? landmarks_beside(options.scan) : options.landmarks;
  check_outputs({options.out}, {options.scan, file});
  check_output_kinds({{options.out, {".vtu"}, "<?xml", {"type=\"UnstructuredGrid\"", kThickness}}});
  take_library_memory();
  const auto unit = options.unit.empty() ? std::nullopt : io::length_unit(options.unit);
  const io::Scan scan = io::read_scan(options.scan, unit);
  if (scan.unit_guessed)
    std::cerr << fmt::format("{}: unit {}\n", printable(options.scan.string()),
                             io::unit_note(scan));
  const io::Landmarks given = landmarks_of(scan, file);
  if (const auto unknown = anatomy::unknown_landmarks(given); !unknown.empty())
    std::cerr << anatomy::unknown_landmarks_note(unknown).text << '\n';
  const auto landmarks =
      anatomy::complete_landmarks(given, scan.mesh, (file.empty() ? options.scan : file).string());
  tissue::TissueMesh mesh;
  {
    Progress progress("meshing the soft tissue", 0);
    mesh = tissue::build_tissue_mesh(scan.mesh, landmarks.landmarks, options.mesh,
                                     options.scan.string());
  }
  Eigen::VectorXf thickness(mesh.volume.nodes.rows());
  for (int level = 0; level <= mesh.volume.layers; ++level)
    thickness.segment(level * mesh.volume.surface_nodes(), mesh.volume.surface_nodes()) =
        1e3F * mesh.volume.thickness_m.cast<float>();
  io::write_vtu(options.out, mesh.volume.nodes, mesh.volume.tets, {{kThickness, thickness}});
  print(mesh, options.out);
}

}  // namespace

void add_mesh(CLI::App& program) {
  auto options = std::make_shared<MeshOptions>();
  CLI::App* command = program.add_subcommand(
      "mesh", "Make the soft-tissue mesh under a scan and report its quality");
  command->add_option("SCAN", options->scan, "PLY, OBJ, STL, glTF or GLB")->required();
  command->add_option("--out", options->out, "Where to write it (.vtu)")->required();
  command->add_option("--landmarks", options->landmarks,
                      "Landmarks on the scan (default: SCAN_landmarks.json or SCAN.mrk.json beside "
                      "it, else they are "
                      "found on the scan)");
  command->add_option("--unit", options->unit, "Unit of the scan")
      ->check(CLI::IsMember({"mm", "cm", "m"}));
  using Mesh = tissue::TissueMeshOptions;
  add_described(*command, "--element-size-mm", options->mesh, &Mesh::element_size_m);
  add_described(*command, "--layers", options->mesh, &Mesh::layers);
  add_described(*command, "--thickness-mm", options->mesh, &Mesh::thickness_m);
  add_described(*command, "--trim-border-mm", options->mesh, &Mesh::trim_border_m);
  command->footer("Example: hyperex mesh scan.ply --out tissue.vtu");
  command->callback([options] { run(*options); });
}

}  // namespace hyperex::cli
