// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A layer of tissue on bone, driven by patches of its skin: a simple box with the features of a
// face.
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "support/fem_support.hpp"
#include "support/spline_course.hpp"

namespace hyperex::test {

struct LayerOptions {
  std::array<int, 3> cells{12, 10, 2};
  double viscosity_pa_s = 476.8;
  fem::ElementKind element = fem::ElementKind::tet4_star;
  bool bonded = false;  ///< true: the bottom is held; false: it stands on springs
};

struct Layer {
  BoxMesh box;
  fem::Material material;
  fem::System system;
  std::vector<int> prescribed;  ///< of patches, and of the bottom where bonded

  explicit Layer(const LayerOptions& o)
      : box(box_mesh(o.cells, Vec3(0.01 * o.cells[0], 0.01 * o.cells[1], 0.006 * o.cells[2]), 0.1)),
        material(uniform_material(box.tets.rows(), 192.4e3, 0.495, o.viscosity_pa_s, 1100)),
        bonded_(o.bonded) {
    system = fem::assemble(box.nodes, box.tets, material, o.element);
    for (const int u : unknowns_where(box.nodes, bottom)) {
      if (bonded_)
        prescribed.push_back(u);
      else
        system.stiffness.coeffRef(u, u) += u % 3 == 2 ? 1000 : 300;  // N/m
    }
  }
  static bool bottom(const Vec3& p) { return p.z() < 1e-9; }

  /// A drive with `patches` patches on top, each with its own course in each axis, and with
  /// `forces` also with forces on some nodes of the layer. The courses are set; there are as many
  /// steps as they last.
  fem::Drive drive(int patches, bool forces, const std::vector<SplineCourse>& courses, double dt_s,
                   unsigned seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return random() / static_cast<double>(std::mt19937::max()); };
    const Vec3 size = box.nodes.colwise().maxCoeff();
    std::vector<Vec3> centre;
    for (int p = 0; p < patches; ++p)
      centre.emplace_back(share() * size.x(), share() * size.y(), size.z());
    std::vector<int> patch_of(static_cast<std::size_t>(box.nodes.rows()), -1);
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n)
      for (int p = 0; p < patches; ++p)
        if ((box.nodes.row(n).transpose() - centre[p]).norm() < 0.009) patch_of[n] = p;
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n)
      for (int axis = 0; axis < 3 && patch_of[n] >= 0; ++axis)
        prescribed.push_back(static_cast<int>(3 * n) + axis);
    std::sort(prescribed.begin(), prescribed.end());
    const int r = static_cast<int>(courses.size());
    fem::Drive drive;
    drive.prescribed = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(prescribed.size()), r);
    if (forces) drive.force = Eigen::MatrixXd::Zero(box.nodes.size(), r);
    for (int k = 0; k < r; ++k) {
      Eigen::MatrixXd way = Eigen::MatrixXd::Zero(3, patches);
      for (double& w : way.reshaped()) w = 3e-3 * (2 * share() - 1);
      for (std::size_t i = 0; i < prescribed.size(); ++i)
        if (const int p = patch_of[prescribed[i] / 3]; p >= 0)
          drive.prescribed(static_cast<Eigen::Index>(i), k) = way(prescribed[i] % 3, p);
      if (forces)
        for (int j = 0; j < 5; ++j)
          drive.force(static_cast<Eigen::Index>(share() * (box.nodes.size() - 1)), k) =
              0.5 * (2 * share() - 1);
    }
    const int steps = static_cast<int>(courses.front().end_s() / dt_s);
    set_courses(courses, dt_s, steps, drive);
    return drive;
  }

 private:
  bool bonded_;
};

/// All steps of the full model, 3 |nodes| x (steps + 1).
inline Eigen::MatrixXd full_run(const fem::System& system, const std::vector<int>& prescribed,
                                const fem::Drive& drive, const fem::NewmarkOptions& options) {
  fem::Newmark newmark(system, prescribed, options);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(system.mass.cols()), v = d;
  const fem::Kinematics first = drive.prescribed_at(0);
  d(prescribed) = first.d;
  v(prescribed) = first.v;
  newmark.start(d, v, first.a, drive.force_at(0));
  Eigen::MatrixXd all(d.size(), drive.steps() + 1);
  all.col(0) = d;
  for (int i = 1; i <= drive.steps(); ++i) {
    newmark.step(drive.prescribed_at(i), drive.force_at(i));
    all.col(i) = newmark.displacement();
  }
  return all;
}

/// Greatest displacement of any node at any time.
inline double greatest_motion(const Eigen::MatrixXd& d) {
  double most = 0;
  for (Eigen::Index c = 0; c < d.cols(); ++c)
    for (Eigen::Index n = 0; n < d.rows(); n += 3)
      most = std::max(most, d.col(c).segment<3>(n).norm());
  return most;
}

inline Eigen::MatrixXd all_steps(const fem::Response& response) {
  return response.shapes * response.course;
}

/// The greatest error over all steps and nodes, relative to the greatest displacement.
inline double true_error(const fem::Response& response, const Eigen::MatrixXd& full) {
  return greatest_motion(all_steps(response) - full) / greatest_motion(full);
}

}  // namespace hyperex::test
