// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that repeated work does not leak: resident memory after 100 and after 1,000 cycles of
// set_tissue() and run() on a small face, through the library's own calls.
//   memory_bench RESULT.json
// Exit status 1 where memory has grown by more than kMostGrowth in between.
#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::bench {
namespace {

constexpr int kEarly = 100, kLate = 1000;
constexpr double kMostGrowth = 1.02;

/// Resident memory of this process. Free memory is returned to the system first; otherwise memory
/// kept by the allocator would be counted.
double resident_bytes() {
  ::malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double whole = 0, resident = 0;
  file >> whole >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

simulate::Simulator small_simulator(simulate::DriveBy by) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  tissue::TissueMeshOptions coarse;
  coarse.element_size_m = 0.007;
  const auto mesh = std::make_shared<const tissue::TissueMesh>(
      tissue::build_tissue_mesh(face.mesh, face.landmarks, coarse, "embedded face"));
  simulate::SimulationOptions options;
  options.drive.by = by;
  options.time.step_s = 0.01;
  const motion::Motion opening = motion::embedded_mouth_opening(face.landmarks);
  return {mesh, face.landmarks, simulate::align(motion::stabilise(opening).motion, face.landmarks),
          options};
}

nlohmann::json measured(simulate::DriveBy by) {
  simulate::Simulator simulator = small_simulator(by);
  double early = 0;
  for (int cycle = 1; cycle <= kLate; ++cycle) {
    simulate::TissueValues tissue = simulator.options().tissue;
    tissue.uniform[tissue::young] = 1e5 + 1e3 * (cycle % 7);
    simulator.set_tissue(tissue);
    simulator.run();
    if (cycle == kEarly) early = resident_bytes();
  }
  const double late = resident_bytes();
  return {{"nodes", simulator.mesh().volume.nodes.rows()},
          {"early_cycles", kEarly},
          {"late_cycles", kLate},
          {"early_bytes", early},
          {"late_bytes", late},
          {"ratio", late / early},
          {"most", kMostGrowth}};
}

}  // namespace
}  // namespace hyperex::bench

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "memory_bench RESULT.json\n";
    return 2;
  }
  using namespace hyperex;
  nlohmann::json out;
  bool leaks = false;
  for (const auto& [name, by] : {std::pair("displacement", simulate::DriveBy::displacement),
                                 std::pair("muscles", simulate::DriveBy::muscles)}) {
    out[name] = bench::measured(by);
    leaks = leaks || out[name]["ratio"] > bench::kMostGrowth;
    std::cout << name << ": " << out[name].dump() << std::endl;
  }
  std::ofstream(arguments[1]) << out.dump(1) << '\n';
  return leaks ? 1 : 0;
}
