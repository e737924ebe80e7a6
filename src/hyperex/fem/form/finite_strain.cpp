// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/finite_strain.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/core/assert.hpp"
#include "hyperex/fem/form/for_each_index.hpp"

namespace hyperex::fem {
namespace {

using Eigen::Matrix3d;

Matrix3d cross_matrix(const Vec3& w) {
  Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

/// |X|^2 of the deviatoric part in the metric whose inverse is A, and its derivative.
double metric_square(const Matrix3d& a, const Matrix3d& x, Matrix3d& derivative) {
  const Matrix3d ax = a * x;
  const double trace = ax.trace();
  derivative = 2 * (ax * a - trace / 3 * a);
  return ax.cwiseProduct(ax.transpose()).sum() - trace * trace / 3;
}

double determinant(const Matrix3d& m) {
  return m.col(0).dot(m.col(1).cross(m.col(2)));
}

/// Where the strain changed by more in the last step, its rate is taken from this step alone: to
/// extrapolate such a change makes BDF2 unstable.
constexpr double kMostExtrapolated = 0.1;

constexpr int kFirst[6] = {0, 0, 0, 1, 1, 2}, kSecond[6] = {1, 2, 3, 2, 3, 3};
/// Which of the six pairs two different corners are.
constexpr int kPair[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};

}  // namespace

/// What second derivatives of one element's energy density need: the block of (a, b) is
/// d2 psi / d x_a d x_b for F = sum_a x_a g_a^T. Every line of it is the second variation of one
/// term for dF = u g_a^T and v g_b^T, as u . K v.
struct FiniteStrain::Element {
  bool linear = false;
  double shear = 0, kept = 0;  // of `linear`
  Matrix3d f, b, cof;          // b = F F^T
  double i1 = 0;
  LawResponse law;  // volumetric parts and pressure of the groups included in dj and djj
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

  /// Second derivatives by F.
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

/// An eigenvalue above minus this share of the largest diagonal entry counts as none below zero.
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

}  // namespace

FiniteStrain::FiniteStrain(const Assembler& mesh, const Material& material, const Hyperelastic& law)
    : mesh_(mesh), law_(law) {
  HX_ASSERT(is_admissible(law));
  const auto elements = static_cast<std::size_t>(mesh.element_count());
  mass_.resize(mesh.mass_neighbours().item.size());
  step_.resize(elements);
  law_stress_.resize(elements);
  branch_.assign(law.branches.size(), std::vector<Matrix3d>(elements));
  fade_.resize(law.branches.size());
  share_.resize(law.branches.size());
  f_.resize(elements);
  piola_.resize(elements);
  ratio_.resize(elements);
  element_energy_.resize(elements);
  pressure_.assign(elements, 0);
  blocks_.resize(54 * elements);

  const Lists &groups = mesh.groups(), &nodes = mesh.group_nodes();
  group_ratio_.resize(groups.size());
  group_gradient_.resize(nodes.item.size());
  group_places_.resize(groups.item.size());
  for_each_index(groups.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    for (int k = groups.start[g]; k < groups.start[g + 1]; ++k)
      for (int a = 0; a < 4; ++a)
        group_places_[k][a] =
            static_cast<int>(std::lower_bound(nodes.item.begin() + nodes.start[g],
                                              nodes.item.begin() + nodes.start[g + 1],
                                              mesh.corners()[groups.item[k]][a]) -
                             nodes.item.begin());
  });
  set_material(material);
}

void FiniteStrain::set_material(const Material& material) {
  HX_ASSERT(material.viscous_form == ViscousForm::isotropic);
  const auto count = static_cast<std::size_t>(mesh_.element_count());
  HX_ASSERT(material.young_pa.size() == count && material.poisson.size() == count);
  HX_ASSERT(material.viscosity_pa_s.size() == count && material.density_kg_m3.size() == count);
  moduli_ = mesh_.moduli(material);
  group_stiffness_ = mesh_.group_stiffness(moduli_);
  energy_rounding_ = 0;
  for (std::size_t t = 0; t < count; ++t)
    energy_rounding_ +=
        std::numeric_limits<double>::epsilon() * moduli_[t].shear * mesh_.shapes()[t].volume;
  viscosity_ = material.viscosity_pa_s;
  viscous_ = std::any_of(viscosity_.begin(), viscosity_.end(), [](double eta) { return eta > 0; });
  std::fill(mass_.begin(), mass_.end(), 0.0);
  element_mass_.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    element_mass_[t] = mass_entry(mesh_.shapes()[t], material.density_kg_m3[t], 0, 1);
  for_each_index(mesh_.node_count(), [&](Eigen::Index at) {
    const int n = static_cast<int>(at);
    const Lists& around = mesh_.tets_around();
    double* const row = mass_.data() + mesh_.mass_neighbours().start[n];
    for (int k = around.start[n]; k < around.start[n + 1]; ++k) {
      const int t = around.item[k];
      for (int a = 0; a < 4; ++a)
        row[mesh_.mass_slots()[k][a]] += element_mass_[t] * (mesh_.corners()[t][a] == n ? 2 : 1);
    }
  });
  rest_at(Eigen::VectorXd::Zero(3 * mesh_.node_count()));
}

Matrix3d FiniteStrain::gradient_at(const Eigen::VectorXd& d, Eigen::Index t) const {
  const auto& corner = mesh_.corners()[t];
  const auto& g = mesh_.shapes()[t].gradient;
  Matrix3d f = Matrix3d::Identity();
  for (int a = 0; a < 4; ++a) f += d.segment<3>(3 * corner[a]) * g.row(a);
  return f;
}

double FiniteStrain::ratio_of(const Matrix3d& f) const {
  return linear() ? f.trace() - 2 : determinant(f);
}
Matrix3d FiniteStrain::ratio_gradient(const Matrix3d& f) const {
  return linear() ? Matrix3d::Identity() : cofactor(f);
}
Matrix3d FiniteStrain::strain_of(const Matrix3d& f) const {
  Matrix3d e = linear() ? Matrix3d(f + f.transpose()) : Matrix3d(f.transpose() * f);
  e.diagonal().array() -= linear() ? 2 : 1;
  return e / 2;
}

/// S = F^-1 dW/dF.
Matrix3d FiniteStrain::law_stress(const Matrix3d& f, double shear_pa) const {
  if (linear()) {
    Hyperelastic plain;
    plain.law = HyperelasticLaw::linear;
    return first_piola_pa(plain, shear_pa, f);
  }
  const Matrix3d cof = cofactor(f), c = f.transpose() * f;
  const double i1 = f.squaredNorm(), j = determinant(f);
  const LawResponse r = respond(law_, shear_pa, i1, cof.squaredNorm(), j);
  // F^-1 cof F = (cof C) / J, which for a flat element has no value.
  const double divisor = std::abs(j) > kLeastRatio ? j : std::copysign(kLeastRatio, j);
  Matrix3d s = -2 * r.d2 * c + r.dj / divisor * cofactor(c);
  s.diagonal().array() += 2 * (r.d1 + r.d2 * i1);
  return s;
}

/// E^, C*^-1 and 2 eta J* now of element t, F being that at the last displacement.
void FiniteStrain::set_viscous_step(Eigen::Index t, const RateRule& rule, double w,
                                    const Matrix3d& f, const Eigen::VectorXd& before) {
  StepData& step = step_[t];
  double now = 1 / rule.step_s;
  step.strain = strain_of(f);
  Matrix3d c = f.transpose() * f, inverse = c.inverse();
  if (linear() || !inverse.allFinite()) {
    c.setIdentity();
    inverse.setIdentity();
  }
  if (rule.before != 0) {
    const Matrix3d g = gradient_at(before, t), change = step.strain - strain_of(g);
    if (linear() || (inverse * change).norm() < kMostExtrapolated) {
      now = rule.now;
      step.strain += rule.before / rule.now * change;
      // C* = C (w C_before^-1 + (1 - w) C^-1) C = C + w (C - C_before) + ..., positive definite for
      // 0 <= w <= 1.
      if (!linear()) c = w * (c * (g.transpose() * g).inverse() * c) + (1 - w) * c;
      inverse = c.inverse();
    }
  }
  step.metric = inverse;
  // An element that is all but flat keeps a little of its viscosity.
  step.viscosity =
      2 * viscosity_[t] * std::sqrt(std::max(determinant(c), kLeastRatio * kLeastRatio)) * now;
}

void FiniteStrain::begin_step(const RateRule& rule, const Eigen::VectorXd& last,
                              const Eigen::VectorXd& before) {
  HX_ASSERT(last.size() == 3 * mesh_.node_count() && before.size() == last.size());
  HX_ASSERT(rule.now >= 0 && rule.step_s >= 0);
  branch_share_ = 0;
  for (std::size_t i = 0; i < fade_.size(); ++i) {
    const MaxwellBranch& branch = law_.branches[i];
    const double x = rule.step_s / branch.relaxation_s;
    fade_[i] = std::exp(-x);
    share_[i] = x > 0 ? -branch.ratio * std::expm1(-x) / x : branch.ratio;
    branch_share_ += share_[i];
  }
  if (!has_rates()) return;
  // Extrapolated with the ratio of the steps, as `before` tells it; never further than by one.
  const double size = rule.now > 0 ? rule.before / rule.now : 0;  // w^2 / (1 + 2 w)
  const double w = std::min(1.0, size + std::sqrt(size * size + size));
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    StepData& step = step_[t];
    const Matrix3d f = gradient_at(last, t);
    step.viscosity = 0;
    step.metric.setIdentity();
    step.strain.setZero();
    step.stress.setZero();
    if (viscosity_[t] > 0 && rule.now > 0) set_viscous_step(t, rule, w, f, before);
    for (std::size_t i = 0; i < branch_.size(); ++i)
      step.stress += fade_[i] * branch_[i][t] - share_[i] * law_stress_[t];
  });
}

void FiniteStrain::accept(const Eigen::VectorXd& d) {
  if (branch_.empty()) return;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Matrix3d now = law_stress(gradient_at(d, t), moduli_[t].shear);
    for (std::size_t i = 0; i < branch_.size(); ++i)
      branch_[i][t] = fade_[i] * branch_[i][t] + share_[i] * (now - law_stress_[t]);
    law_stress_[t] = now;
  });
}

void FiniteStrain::rest_at(const Eigen::VectorXd& d) {
  branch_share_ = 0;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    step_[t] = {Matrix3d::Identity(), Matrix3d::Zero(), Matrix3d::Zero(), 0};
    if (branch_.empty()) return;
    law_stress_[t] = law_stress(gradient_at(d, t), moduli_[t].shear);
    for (auto& q : branch_) q[t].setZero();
  });
}

void FiniteStrain::find_kinematics(const Eigen::VectorXd& d) {
  HX_ASSERT(d.size() == 3 * mesh_.node_count());
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    f_[t] = gradient_at(d, t);
    ratio_[t] = ratio_of(f_[t]);
  });
  const Lists& groups = mesh_.groups();
  if (groups.size() == 0) return;
  for_each_index(groups.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    double sum = 0;
    for (const int t : groups[g])
      sum += mesh_.shapes()[t].volume / static_cast<double>(mesh_.groups_of()[t].size()) *
             (ratio_[t] - 1);
    group_ratio_[g] = sum / mesh_.group_volume()[g];
  });
  for_each_index(mesh_.element_count(), [&](Eigen::Index at) {
    const int t = static_cast<int>(at);
    const auto of = mesh_.groups_of()[t];
    double sum = 0;
    for (const int g : of) sum += group_stiffness_[g] / mesh_.group_volume()[g] * group_ratio_[g];
    pressure_[t] = sum / static_cast<double>(of.size());
  });
}

double FiniteStrain::evaluate(const Eigen::VectorXd& d, bool step, Eigen::VectorXd* gradient) {
  find_kinematics(d);
  const bool rates = step && has_rates();
  const double share = step ? 1 + branch_share_ : 1;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Matrix3d& f = f_[t];
    const double shear = moduli_[t].shear, kept = moduli_[t].kept(), j = ratio_[t];
    double energy = kept / 2 * (j - 1) * (j - 1), by_ratio = kept * (j - 1) + pressure_[t];
    Matrix3d& p = piola_[t];
    if (linear()) {
      Matrix3d e = (f + f.transpose()) / 2;
      e.diagonal().array() -= e.trace() / 3;
      energy += share * shear * e.squaredNorm();
      p = 2 * share * shear * e;
      p.diagonal().array() += by_ratio;
    } else {
      const Matrix3d cof = cofactor(f);
      const double i1 = f.squaredNorm();
      const LawResponse r = respond(law_, shear, i1, cof.squaredNorm(), j);
      energy += share * r.w;
      by_ratio += share * r.dj;
      if (law_.barrier) {
        const OfRatio barrier = volume_barrier(j);
        energy += shear * barrier.w;
        by_ratio += shear * barrier.d;
      }
      p = 2 * share * r.d1 * f + by_ratio * cof;
      if (r.d2 != 0) p += 2 * share * r.d2 * (i1 * f - f * (f.transpose() * f));
    }
    if (rates) {
      const Matrix3d e = strain_of(f);
      Matrix3d s;
      energy += step_[t].viscosity / 2 * metric_square(step_[t].metric, e - step_[t].strain, s);
      s *= step_[t].viscosity / 2;
      s += step_[t].stress;
      energy += step_[t].stress.cwiseProduct(e).sum();
      p += linear() ? s : Matrix3d(f * s);
    }
    element_energy_[t] = mesh_.shapes()[t].volume * energy;
    p *= mesh_.shapes()[t].volume;
  });
  double sum = 0;
  for (const double e : element_energy_) sum += e;
  for (std::size_t g = 0; g < group_ratio_.size(); ++g)
    sum += group_stiffness_[g] / 2 * group_ratio_[g] * group_ratio_[g];
  if (gradient) {
    gradient->resize(d.size());
    for_each_index(mesh_.node_count(), [&](Eigen::Index at) {
      const int n = static_cast<int>(at);
      Vec3 f = Vec3::Zero();
      for (const int t : mesh_.tets_around()[n]) {
        int a = 0;
        while (mesh_.corners()[t][a] != n) ++a;
        f += piola_[t] * mesh_.shapes()[t].gradient.row(a).transpose();
      }
      gradient->segment<3>(3 * at) = f;
    });
  }
  return sum;
}

double FiniteStrain::energy_and_gradient(const Eigen::VectorXd& d, Eigen::VectorXd& gradient) {
  return evaluate(d, true, &gradient);
}
double FiniteStrain::energy(const Eigen::VectorXd& d) {
  return evaluate(d, true, nullptr);
}
double FiniteStrain::elastic_energy(const Eigen::VectorXd& d) {
  return evaluate(d, false, nullptr);
}

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

void FiniteStrain::find_blocks(bool projected) {
  const bool rates = has_rates();
  const double share = 1 + branch_share_;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Tet4& shape = mesh_.shapes()[t];
    const double shear = moduli_[t].shear, kept = moduli_[t].kept(), j = ratio_[t];
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
    if (rates) {
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
    double* out = blocks_.data() + 54 * t;
    Matrix9d h;
    if (projected && !is_semidefinite(h = e.by_gradient())) {
      h = shape.volume * made_semidefinite(h);
      for (int pair = 0; pair < 6; ++pair, out += 9) {
        Eigen::Map<Matrix3d> block(out);
        block.setZero();
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            block += shape.gradient(kFirst[pair], k) * shape.gradient(kSecond[pair], l) *
                     h.block<3, 3>(3 * k, 3 * l);
      }
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
      // A translation costs nothing: the block on the diagonal is less the sum of the others.
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

void FiniteStrain::mass_product(const Eigen::VectorXd& u, Eigen::VectorXd& out) const {
  const Lists& neighbours = mesh_.mass_neighbours();
  out.resize(u.size());
  for_each_index(mesh_.node_count(), [&](Eigen::Index n) {
    Vec3 sum = Vec3::Zero();
    for (int k = neighbours.start[n]; k < neighbours.start[n + 1]; ++k)
      sum += mass_[k] * u.segment<3>(3 * neighbours.item[k]);
    out.segment<3>(3 * n) = sum;
  });
}

std::vector<Matrix3d> FiniteStrain::deformation_gradient(const Eigen::VectorXd& d) const {
  std::vector<Matrix3d> f(static_cast<std::size_t>(mesh_.element_count()));
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) { f[t] = gradient_at(d, t); });
  return f;
}

Eigen::VectorXd FiniteStrain::volume_ratio(const Eigen::VectorXd& d) const {
  Eigen::VectorXd ratio(mesh_.element_count());
  for_each_index(ratio.size(), [&](Eigen::Index t) { ratio[t] = determinant(gradient_at(d, t)); });
  return ratio;
}

namespace {

void set_voigt(const Matrix3d& m, double shear, Eigen::Index row, VoigtRows& out) {
  out.row(row) << m(0, 0), m(1, 1), m(2, 2), shear * m(0, 1), shear * m(1, 2), shear * m(2, 0);
}

}  // namespace

VoigtRows FiniteStrain::green_lagrange(const Eigen::VectorXd& d) const {
  VoigtRows strain(mesh_.element_count(), 6);
  for_each_index(strain.rows(), [&](Eigen::Index t) {
    const Matrix3d f = gradient_at(d, t);
    set_voigt((f.transpose() * f - Matrix3d::Identity()) / 2, 2, t, strain);
  });
  return strain;
}

VoigtRows FiniteStrain::cauchy_stress_pa(const Eigen::VectorXd& d) {
  evaluate(d, false, nullptr);
  VoigtRows stress(mesh_.element_count(), 6);
  for_each_index(stress.rows(), [&](Eigen::Index t) {
    const double j = determinant(f_[t]);
    if (!(j > 0)) {
      stress.row(t).setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const Matrix3d p = piola_[t] / mesh_.shapes()[t].volume;
    set_voigt(linear() ? p : Matrix3d(p * f_[t].transpose() / j), 1, t, stress);
  });
  return stress;
}

Eigen::VectorXd von_mises_of(const VoigtRows& stress) {
  Eigen::VectorXd out(stress.rows());
  for_each_index(out.size(), [&](Eigen::Index t) {
    const auto s = stress.row(t);
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    out[t] = std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s.tail<3>().squaredNorm());
  });
  return out;
}

Points FiniteStrain::principal_stretches(const Eigen::VectorXd& d) const {
  Points stretch(mesh_.element_count(), 3);
  for_each_index(stretch.rows(), [&](Eigen::Index t) {
    const Matrix3d f = gradient_at(d, t);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(f.transpose() * f, Eigen::EigenvaluesOnly);
    stretch.row(t) = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().transpose();
  });
  return stretch;
}

}  // namespace hyperex::fem
