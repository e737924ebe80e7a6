// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "experiments/measured.hpp"
#include "experiments/models.hpp"
#include "experiments/physics.hpp"
#include "experiments/same_forces.hpp"

namespace hyperex::bench {

struct Experiments {
  std::vector<MeasuredFace> measured;
  std::vector<PhysicsFace> physics;
  std::vector<ModelsFace> models;
  std::vector<SameForcesFace> same_forces;
};

struct PageHead {
  std::string commit, machine;
  std::string pictures;  ///< their folder, relative to the page
};

/// docs/experiments.md: our measurements beside the results of the thesis. Every figure comes from
/// `all`, and the conclusions depend on the figures.
std::string experiments_page(const Experiments& all, const PageHead& head);

/// The parts of the page: the statements of the thesis, point by point, and the three experiments.
std::string point_by_point(const Experiments& all);
std::string measured_section(const std::vector<MeasuredFace>& faces, const std::string& pictures);
std::string physics_section(const std::vector<PhysicsFace>& faces, const std::string& pictures);
std::string models_section(const std::vector<ModelsFace>& faces, const std::string& pictures);

/// "embedded face 1.2; subject A 3.4": `text` of each face, with its name.
template <class Faces, class Text>
std::string of_each(const Faces& faces, const Text& text) {
  std::string all;
  for (const auto& face : faces) all += (all.empty() ? "" : "; ") + face.name + " " + text(face);
  return all;
}

}  // namespace hyperex::bench
