// SPDX-License-Identifier: GPL-3.0-or-later
#include "twins/twins.hpp"

#include <fmt/format.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"

namespace hyperex::bench {
namespace {

constexpr double kNoise_m = 0.0003;

test::TwinFace embedded_twin() {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  test::TwinFace out;
  out.landmarks = face.landmarks;
  out.mesh = std::make_shared<const tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded"));
  out.options.time.step_s = 0.005;
  return out;
}

/// Factor on E for each tetrahedron.
std::vector<double> stiff_region(const test::TwinFace& face, const std::string& region,
                                 double factor) {
  const anatomy::EmbeddedFace scan = anatomy::embedded_face();
  const anatomy::RegisteredFace registered =
      anatomy::register_canonical_face(face.landmarks, scan.mesh);
  const tissue::TissueFieldMaker maker(*face.mesh, face.landmarks, &registered);
  tissue::TissueFieldOptions options;
  tissue::TissueRegion change;
  change.name = region;
  change.factor[tissue::young] = factor;
  options.regions = {change};
  std::vector<double> young = maker.make(options).element[tissue::young];
  for (double& e : young) e /= tissue::default_parameters[tissue::young];
  return young;
}

std::vector<test::TwinChange> changes_on(const test::TwinFace& face) {
  return {
      {"left cheek E x 5", stiff_region(face, "cheek_L", 5)},
      {"all E x 2", std::vector<double>(std::size_t(face.mesh->volume.tets.rows()), 2.0)},
      {"zyg_major_L = 0.3", {}, {{"zyg_major_L", 0.3}}},
  };
}

}  // namespace

Twins run_twins(int draws) {
  const test::TwinFace face = embedded_twin();
  const std::vector<test::TwinChange> changes = changes_on(face);
  Twins out;
  out.nodes = int(face.mesh->volume.nodes.rows());
  for (const test::TwinChange& change : changes) out.changes.push_back(change.name);
  const std::vector<World> worlds = {{"as the program knows it", 1, 0},
                                     {"tissue twice as stiff", 2, 0},
                                     {"tissue half as stiff", 0.5, 0},
                                     {"lines off by 2 mm", 1, 2},
                                     {"lines off by 4 mm", 1, 4}};
  const std::vector<std::vector<std::string>> point_sets = {face::all_ibug(),
                                                            face.options.drive.points};
  for (const World& world : worlds) {
    const std::size_t first = out.rows.size();
    for (const auto& points : point_sets) out.rows.push_back({world, points.size(), {}, {}, {}});
    for (int draw = 0; draw < draws; ++draw) {
      fmt::print(stderr, "twins: {}, {} of {}\n", world.name, draw + 1, draws);
      const unsigned seed = 11 + 100 * unsigned(draw);
      const test::TwinTruth truth(
          face, test::displaced_lines(muscles::muscle_template(), world.lines_off_mm, seed),
          world.young_factor, changes);
      for (std::size_t p = 0; p < point_sets.size(); ++p) {
        TwinRow& row = out.rows[first + p];
        const auto answer = [&](const test::Activations& activations) {
          return test::twin_answer(face, truth, activations, changes, point_sets[p], kNoise_m,
                                   seed + 1);
        };
        row.smiles.push_back(answer(test::left_smile()));
        row.other_smiles.push_back(answer(test::other_smile()));
        row.drawn.push_back(answer(test::drawn_expression(truth.lines(), seed + 2)));
      }
    }
  }
  return out;
}

}  // namespace hyperex::bench
