// SPDX-License-Identifier: GPL-3.0-or-later
// The tangent stiffness of FiniteStrain: second derivatives of the energy, element by element.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hyperex/fem/form/finite_kinematics.hpp"
#include "hyperex/fem/form/for_each_index.hpp"
#include "hyperex/geometry/cross_matrix.hpp"

namespace hyperex::fem {

using Eigen::Matrix3d;

namespace {

constexpr int kFirst[6] = {0, 0, 0, 1, 1, 2}, kSecond[6] = {1, 2, 3, 2, 3, 3};
/// The index of the pair that two different corners form.
constexpr int kPair[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

}  // namespace

/// Data for the second derivatives of the energy density of one element. The block (a, b) is d2 psi
/// / d x_a d x_b for F = sum_a x_a g_a^T. Each of its lines is the second variation of one term for
/// dF = u g_a^T and v g_b^T, written as u . K v.
struct FiniteStrain::Element {
  bool linear = false;
  double shear = 0, kept = 0;  // of `linear`
  Matrix3d f, b, cof;          // b = F F^T
  double i1 = 0;
  LawResponse law;  // dj and djj include the volumetric parts and the pressure of the groups
  bool viscous = false, stressed = false;
  double viscosity = 0;
  Matrix3d metric, spatial_metric, stress;  // A, F A F^T, S of viscosity and branches

  struct Corner {
    Vec3 g, f, second, cof, metric;  // g_a, F g_a, (dI2/dF g_a) / 2, cof F g_a, F A g_a
  };
  Corner corner(const Vec3& g) const {
    Corner c;
    c.g = g;
    c.f = f * g;
    if (law.d2 != 0) c.second = i1 * c.f - b * c.f;
    if (!linear) c.cof = cof * g;
    if (viscous) c.metric = f * (metric * g);
    return c;
  }

  Matrix3d block(const Corner& p, const Corner& q) const {
    const double gg = p.g.dot(q.g);
    Matrix3d k;
    double on_diagonal;
    if (linear) {
      k = shear * (q.g * p.g.transpose()) + (kept - 2 * shear / 3) * (p.g * q.g.transpose());
      on_diagonal = shear * gg;
    } else {
      const Vec3 first = 2 * (2 * law.d11 * p.f + law.d1j * p.cof);
      const Vec3 by_ratio = 2 * law.d1j * p.f + law.djj * p.cof;
      k = first * q.f.transpose() + by_ratio * q.cof.transpose();
      k -= law.dj * cross_matrix(f * p.g.cross(q.g));
      on_diagonal = 2 * law.d1 * gg;
      if (law.d2 != 0) {
        k += 2 * law.d2j * (p.second * q.cof.transpose() + p.cof * q.second.transpose());
        k += 2 * law.d2 * (2 * p.f * q.f.transpose() - q.f * p.f.transpose() - gg * b);
        on_diagonal += 2 * law.d2 * (i1 * gg - p.f.dot(q.f));
      }
    }
    if (viscous) {
      k += viscosity * (p.g.dot(metric * q.g) / 2 * spatial_metric +
                        q.metric * p.metric.transpose() / 2 - p.metric * q.metric.transpose() / 3);
    }
    if (stressed) on_diagonal += p.g.dot(stress * q.g);
    k.diagonal().array() += on_diagonal;
    return k;
  }

  /// Second derivatives with respect to F.
  Eigen::Matrix<double, 9, 9> by_gradient() const {
    Eigen::Matrix<double, 9, 9> h;
    const std::array<Corner, 3> c{corner(Vec3::UnitX()), corner(Vec3::UnitY()),
                                  corner(Vec3::UnitZ())};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) h.block<3, 3>(3 * k, 3 * l) = block(c[k], c[l]);
    return (h + h.transpose()) / 2;
  }
};

namespace {

/// An eigenvalue counts as non-negative if it is above minus this share of the largest diagonal
/// entry.
constexpr double kSemidefinite = 1e-9;

using Matrix9d = Eigen::Matrix<double, 9, 9>;

bool is_semidefinite(const Matrix9d& h) {
  Matrix9d raised = h;
  raised.diagonal().array() += kSemidefinite * h.diagonal().cwiseAbs().maxCoeff();
  return Eigen::LLT<Matrix9d>(raised).info() == Eigen::Success;
}

Matrix9d made_semidefinite(const Matrix9d& h) {
  const Eigen::SelfAdjointEigenSolver<Matrix9d> eigen(h);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// The six off-diagonal blocks of an element, from the second derivatives `h` with respect to F.
void blocks_of(const Tet4& shape, const Matrix9d& h, double* out) {
  for (int pair = 0; pair < 6; ++pair, out += 9) {
    Eigen::Map<Matrix3d> block(out);
    block.setZero();
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        block += shape.gradient(kFirst[pair], k) * shape.gradient(kSecond[pair], l) *
                 h.block<3, 3>(3 * k, 3 * l);
  }
}

}  // namespace

void FiniteStrain::find_group_gradients() {
  const Lists &groups = mesh_.groups(), &nodes = mesh_.group_nodes();
  for_each_index(groups.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    std::fill(group_gradient_.begin() + nodes.start[g],
              group_gradient_.begin() + nodes.start[g + 1], Vec3::Zero());
    for (int k = groups.start[g]; k < groups.start[g + 1]; ++k) {
      const int t = groups.item[k];
      const Tet4& shape = mesh_.shapes()[t];
      const Matrix3d by =
          shape.volume /
          (mesh_.group_volume()[g] * static_cast<double>(mesh_.groups_of()[t].size())) *
          ratio_gradient(f_[t]);
      for (int a = 0; a < 4; ++a)
        group_gradient_[group_places_[k][a]] += by * shape.gradient.row(a).transpose();
    }
  });
}

/// The element at its deformation gradient of the last evaluation.
FiniteStrain::Element FiniteStrain::element_at(Eigen::Index t) const {
  const double shear = moduli_[t].shear, kept = moduli_[t].kept(), j = ratio_[t];
  const double share = 1 + branch_share_;
  Element e;
  e.f = f_[t];
  e.linear = linear();
  if (e.linear) {
    e.shear = share * shear;
    e.kept = kept;
  } else {
    e.cof = cofactor(e.f);
    e.i1 = e.f.squaredNorm();
    e.law = respond(law_, shear, e.i1, e.cof.squaredNorm(), j);
    for (double LawResponse::*x :
         {&LawResponse::d1, &LawResponse::d2, &LawResponse::dj, &LawResponse::d11,
          &LawResponse::d1j, &LawResponse::d2j, &LawResponse::djj})
      e.law.*x *= share;
    e.law.dj += kept * (j - 1) + pressure_[t];
    e.law.djj += kept;
    if (law_.barrier) {
      const OfRatio barrier = volume_barrier(j);
      e.law.dj += shear * barrier.d;
      e.law.djj += shear * barrier.dd;
    }
    if (e.law.d2 != 0) e.b = e.f * e.f.transpose();
  }
  if (has_rates()) {
    const StepData& step = step_[t];
    e.viscous = step.viscosity > 0;
    e.viscosity = step.viscosity;
    e.metric = step.metric;
    if (e.linear) {
      e.spatial_metric.setIdentity();
      e.f.setIdentity();
    } else {
      e.spatial_metric = e.f * step.metric * e.f.transpose();
      metric_square(step.metric, strain_of(e.f) - step.strain, e.stress);
      e.stress = step.viscosity / 2 * e.stress + step.stress;
      e.stressed = true;
    }
  }
  return e;
}

void FiniteStrain::find_blocks(bool projected) {
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Tet4& shape = mesh_.shapes()[t];
    const Element e = element_at(t);
    double* out = blocks_.data() + 54 * t;
    Matrix9d h;
    if (projected && !is_semidefinite(h = e.by_gradient())) {
      h = shape.volume * made_semidefinite(h);
      blocks_of(shape, h, out);
      return;
    }
    std::array<Element::Corner, 4> corner;
    for (int a = 0; a < 4; ++a) corner[a] = e.corner(shape.gradient.row(a).transpose());
    for (int pair = 0; pair < 6; ++pair, out += 9)
      Eigen::Map<Matrix3d>(out).noalias() =
          shape.volume * e.block(corner[kFirst[pair]], corner[kSecond[pair]]);
  });
}

void FiniteStrain::tangent(const Eigen::VectorXd& d, double mass_share, bool projected,
                           SparseMatrix& matrix) {
  const Lists& neighbours = mesh_.stiffness_neighbours();
  if (!(matrix.cols() == d.size() && matrix.isCompressed() &&
        matrix.nonZeros() == 9 * static_cast<Eigen::Index>(neighbours.item.size())))
    matrix = mesh_.stiffness_pattern();
  find_kinematics(d);
  find_group_gradients();
  find_blocks(projected);
  const Lists& around = mesh_.tets_around();
  for_each_index(mesh_.node_count(), [&](Eigen::Index at) {
    const int n = static_cast<int>(at);
    const auto height = 3 * static_cast<Eigen::Index>(neighbours[n].size());
    // The three columns of the node as a matrix of their rows.
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3>> column(
        matrix.valuePtr() + matrix.outerIndexPtr()[3 * n], height, 3);
    column.setZero();
    for (int k = around.start[n]; k < around.start[n + 1]; ++k) {
      const int t = around.item[k];
      const auto& slot = mesh_.stiffness_slots()[k];
      int own = 0;
      while (mesh_.corners()[t][own] != n) ++own;
      // A translation takes no energy, so the diagonal block is minus the sum of the other blocks.
      Matrix3d diagonal = Matrix3d::Zero();
      for (int a = 0; a < 4; ++a) {
        if (a == own) continue;
        const Eigen::Map<const Matrix3d> stored(blocks_.data() + 54 * t + 9 * kPair[a][own]);
        auto block = column.block<3, 3>(3 * slot[a], 0);
        if (a < own) {
          block += stored;
          diagonal -= stored;
        } else {
          block += stored.transpose();
          diagonal -= stored.transpose();
        }
        block.diagonal().array() += mass_share * element_mass_[t];
      }
      diagonal.diagonal().array() += 2 * mass_share * element_mass_[t];
      column.block<3, 3>(3 * slot[own], 0) += diagonal;
    }
    if (mesh_.groups().size() > 0) mesh_.add_groups(n, group_stiffness_, group_gradient_, matrix);
  });
}

}  // namespace hyperex::fem
