// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "hyperex/core/printable.hpp"
#include "hyperex/expression/arkit_names.hpp"

namespace hyperex::cli {
namespace {

/// How deep the lips lie in each other where both shapes of a corrective are at weight 1.
std::string lips_of(const rig::FaceRig& made, const report::RigShape& corrective) {
  const auto& [first, second] = *corrective.corrects;
  const PointsF sum = made.shapes[first].displacement_m + made.shapes[second].displacement_m;
  return fmt::format("; lips {:.1f} mm in each other without it, {:.1f} mm with it",
                     1e3 * made.lips->depth(sum),
                     1e3 * made.lips->depth(sum + corrective.displacement_m));
}

/// By how much a shape turns an eye; empty where it turns none.
std::string turn_of_eyes(const report::RigShape& shape) {
  double most_rad = 0;
  for (const auto& eye : {shape.right_eye, shape.left_eye})
    if (eye) most_rad = std::max(most_rad, std::hypot(eye->up_rad, eye->left_rad));
  return most_rad > 0
             ? fmt::format("; eyes turn by {:.0f} degrees", most_rad * 180 / std::numbers::pi)
             : "";
}

/// What else there is to say of a shape, behind its displacement. The shapes have ARKit's names.
std::string remark_on(const rig::FaceRig& made, std::size_t place,
                      const std::vector<rig::Recipe>& recipes) {
  const report::RigShape& shape = made.shapes[place];
  std::string text = turn_of_eyes(shape);
  if (shape.corrects) text += lips_of(made, shape);
  if (std::ranges::find(recipes, shape.name, &rig::Recipe::name) != recipes.end())
    text += place < expression::arkit_shapes().size() ? "; a recipe in the place of ARKit's shape"
                                                      : "; a recipe";
  return text;
}

}  // namespace

std::vector<std::string> remarks_on_shapes(const rig::FaceRig& made,
                                           const std::vector<rig::Recipe>& recipes) {
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < made.shapes.size(); ++i)
    remarks.push_back(remark_on(made, i, recipes));
  return remarks;
}

void print_shapes(const rig::FaceRig& made, const std::vector<std::string>& remarks,
                  const std::string& file, double bytes) {
  std::size_t width = 20;
  for (const report::RigShape& shape : made.shapes) width = std::max(width, shape.name.size());
  for (std::size_t i = 0; i < made.shapes.size(); ++i)
    std::cout << fmt::format("{:<{}} {:5.1f} mm{}\n", made.shapes[i].name, width,
                             1e3 * made.shapes[i].displacement_m.rowwise().norm().maxCoeff(),
                             remarks[i]);
  const auto correctives = std::ranges::count_if(
      made.shapes, [](const report::RigShape& shape) { return shape.corrects.has_value(); });
  std::cout << fmt::format(
      "{} shapes{} of {} vertices of the skin (greatest displacement at weight 1); tongueOut moves "
      "nothing: the tongue stays in the mouth\n"
      "written to {}: {:.1f} MB\n",
      made.shapes.size() - std::size_t(correctives),
      correctives > 0 ? fmt::format(" and {} correctives", correctives) : "",
      made.performance.skin_rest.points.rows(), printable(file), bytes / 1e6);
}

}  // namespace hyperex::cli
