// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly for a new mesh, and for new tissue values on the same mesh.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "support/face_case.hpp"

namespace hyperex::bench {
namespace {

const FaceCase& face() {
  static const FaceCase face(Face::subject_a_if_there);
  return face;
}
const tissue::VolumeMesh& mesh() {
  return face().mesh().volume;
}

void label(benchmark::State& state, fem::ElementKind kind, const fem::System& system) {
  state.SetLabel(std::string(to_string(kind)));
  state.counters["tets"] = static_cast<double>(mesh().tets.rows());
  state.counters["nonzeros"] = static_cast<double>(system.stiffness.nonZeros());
}

/// New values with existing patterns. Arguments: element kind, threads.
void reassemble(benchmark::State& state) {
  const auto kind = static_cast<fem::ElementKind>(state.range(0));
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  const fem::Assembler assembler(mesh().nodes, mesh().tets, kind);
  const fem::Material material = face().material();
  fem::System system;
  assembler.assemble(material, system);
  for (auto _ : state) assembler.assemble(material, system);
  label(state, kind, system);
}

/// Shapes, patterns and values: the first assembly on a mesh.
void assemble_anew(benchmark::State& state) {
  const auto kind = static_cast<fem::ElementKind>(state.range(0));
  const fem::Material material = face().material();
  fem::System system;
  for (auto _ : state) system = fem::assemble(mesh().nodes, mesh().tets, material, kind);
  label(state, kind, system);
}

const std::vector<int64_t> kKinds{static_cast<int64_t>(fem::ElementKind::tet4),
                                  static_cast<int64_t>(fem::ElementKind::tet4_star)};
BENCHMARK(reassemble)->ArgsProduct({kKinds, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(assemble_anew)->ArgsProduct({kKinds})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace hyperex::bench

BENCHMARK_MAIN();
