// SPDX-License-Identifier: GPL-3.0-or-later
// Obstacles for contact: teeth and eyeballs.
#include "obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bind.hpp"
#include "hyperex/anatomy/teeth/teeth_fit.hpp"
#include "hyperex/core/error.hpp"
#include "meshes.hpp"

namespace hyperex::python {
namespace {

using simulate::Obstacle;

Obstacles obstacles(const SharedTissueMesh& mesh, const io::Landmarks& landmarks, bool teeth,
                    bool eyes) {
  auto all = std::make_shared<std::vector<Obstacle>>();
  if (teeth) {
    const anatomy::TeethFit fit =
        anatomy::fit_teeth(mesh->volume.outer, tissue::boundary_of(mesh->volume), landmarks);
    if (!fit.why_none.empty())
      throw InputError(
          InputProblem{{}, 0, "teeth", fit.why_none, "an open mouth with room behind its lips"});
    *all = simulate::teeth_obstacles(fit.teeth);
  }
  if (eyes)
    for (Obstacle& eye : simulate::eye_obstacles(mesh->skin.points, landmarks))
      all->push_back(std::move(eye));
  return {all->empty() ? nullptr : std::move(all)};
}

std::size_t count(const Obstacles& obstacles, Obstacle::Kind kind) {
  if (!obstacles.all) return 0;
  return static_cast<std::size_t>(
      std::count_if(obstacles.all->begin(), obstacles.all->end(),
                    [&](const Obstacle& one) { return one.kind == kind; }));
}

}  // namespace

void bind_obstacles(py::module_& m) {
  py::class_<Obstacles>(m, "Obstacles",
                        "Rigid bodies that the tissue may touch: obstacles(), Scene.obstacles.")
      .def_property_readonly(
          "rows_of_teeth", [](const Obstacles& o) { return count(o, Obstacle::Kind::teeth); },
          "0 to 2.")
      .def_property_readonly(
          "eyes", [](const Obstacles& o) { return count(o, Obstacle::Kind::eye); }, "0 to 2.")
      .def("__repr__", [](const Obstacles& o) {
        return fmt::format("<hyperex.Obstacles: {} rows of teeth, {} eyes>",
                           count(o, Obstacle::Kind::teeth), count(o, Obstacle::Kind::eye));
      });
  m.def("obstacles", &obstacles, "mesh"_a, "landmarks"_a, "teeth"_a = true, "eyes"_a = true,
        Unlocked(),
        "Average teeth fitted behind the lips, and eyeballs behind the lids, for "
        "Simulator.set_obstacles(). InputError where there is no room for the teeth. Scans of "
        "teeth come through a Scene (teeth.upper, teeth.lower).");
}

}  // namespace hyperex::python
