// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly on the face that comes with the program: for a new mesh, and for new tissue values.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/tissue/canonical_face.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex {
namespace {

const tissue::VolumeMesh& face() {
  static const tissue::VolumeMesh mesh = [] {
    const auto embedded = tissue::embedded_face();
    return tissue::build_tissue_mesh(embedded.mesh, embedded.landmarks, {}, "embedded").volume;
  }();
  return mesh;
}

fem::Material tissue_of(Eigen::Index tets) {
  const auto n = static_cast<std::size_t>(tets);
  fem::Material m;
  m.young_pa.assign(n, 192.4e3);
  m.poisson.assign(n, 0.495);
  m.viscosity_pa_s.assign(n, 476.8);
  m.density_kg_m3.assign(n, 1100);
  return m;
}

void label(benchmark::State& state, fem::ElementKind kind, const fem::System& system) {
  state.SetLabel(std::string(to_string(kind)));
  state.counters["tets"] = static_cast<double>(face().tets.rows());
  state.counters["nonzeros"] = static_cast<double>(system.stiffness.nonZeros());
}

/// Values anew, patterns kept. Arguments: element kind, threads.
void reassemble(benchmark::State& state) {
  const auto kind = static_cast<fem::ElementKind>(state.range(0));
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  const fem::Assembler assembler(face().nodes, face().tets, kind);
  const fem::Material material = tissue_of(face().tets.rows());
  fem::System system;
  assembler.assemble(material, system);
  for (auto _ : state) assembler.assemble(material, system);
  label(state, kind, system);
}

/// Shapes, patterns and values: the first assembly on a mesh.
void assemble_anew(benchmark::State& state) {
  const auto kind = static_cast<fem::ElementKind>(state.range(0));
  const fem::Material material = tissue_of(face().tets.rows());
  fem::System system;
  for (auto _ : state) system = assemble(face().nodes, face().tets, material, kind);
  label(state, kind, system);
}

const std::vector<int64_t> kKinds{static_cast<int64_t>(fem::ElementKind::tet4),
                                  static_cast<int64_t>(fem::ElementKind::tet4_star)};
BENCHMARK(reassemble)->ArgsProduct({kKinds, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assemble_anew)->ArgsProduct({kKinds})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace hyperex

BENCHMARK_MAIN();
