// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/face_responses.hpp"

#include <cmath>

#include "hyperex/simulate/load/muscle_tissue.hpp"

namespace hyperex::estimate {
namespace {

/// By how much lines are moved to find the change of their forces, mm on the template's face.
constexpr double kLineStep_mm = 2;

muscles::MuscleTable moved(muscles::MuscleTable table, double out_mm, double up_mm) {
  for (muscles::TemplateMuscle& muscle : table)
    for (muscles::TemplatePlace& place : muscle.path) {
      place.out_mm += out_mm;
      place.up_mm += up_mm;
    }
  return table;
}

BandForces forces_of(const simulate::MuscleModel& model) {
  return {model.force().sparseView(), model.wide_force().sparseView()};
}

/// (b - a) / step
BandForces change(const BandForces& a, const BandForces& b, double step) {
  return {(b.narrow - a.narrow) / step, (b.wide - a.wide) / step};
}

/// The places' displacement as rows of the outer nodes' unknowns, transposed: 3 |nodes| x 3 P.
Eigen::MatrixXd unit_forces(const simulate::CarrierMatrix& carrier, Eigen::Index unknowns) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns, 3 * carrier.rows());
  for (Eigen::Index p = 0; p < carrier.rows(); ++p)
    for (simulate::CarrierMatrix::InnerIterator node(carrier, p); node; ++node)
      for (int axis = 0; axis < 3; ++axis) out(3 * node.col() + axis, 3 * p + axis) = node.value();
  return out;
}

}  // namespace

FaceResponses::FaceResponses(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                             const simulate::SimulationOptions& options,
                             const std::vector<std::string>& points, const Points& places,
                             std::vector<StiffnessRatio> ratios,
                             const std::vector<KnownLoad>& loads)
    : ratios_(std::move(ratios)),
      assembler_(mesh.volume.nodes, mesh.volume.tets, options.model.element),
      own_(options.tissue.material(std::size_t(mesh.volume.tets.rows()),
                                   options.model.viscous_form)),
      carrier_(simulate::carriers(mesh, simulate::skin_places(mesh, points, places))) {
  stiffen_lips(mesh, landmarks, options.muscles, own_);
  assembler_.assemble(own_, system_);
  const auto model = [&](const simulate::SimulationOptions& with,
                         std::shared_ptr<const fem::NodeOrder> order) {
    return muscle_model(mesh, landmarks, with, system_.stiffness, std::move(order));
  };
  const simulate::MuscleModel own = model(options, nullptr);
  lines_ = own.lines();
  boundary_.emplace(mesh, landmarks, simulate::muscle_support(options.support, options.muscles));
  muscles_ = forces_of(own);
  jaw_ = own.jaw_force();
  for (const KnownLoad& load : loads) loads_.push_back(unit_forces_of(load, mesh, system_.mass));
  for (int way = 0; way < 2; ++way) {
    simulate::SimulationOptions beside = options;
    beside.muscles.own =
        moved(options.muscles.table(), way == 0 ? kLineStep_mm : 0, way == 0 ? 0 : kLineStep_mm);
    const double step_m = 1e-3 * kLineStep_mm * lines_.front().scale;
    moved_lines_[std::size_t(way)] =
        change(muscles_, forces_of(model(beside, own.order())), step_m);
  }
  factor_.emplace(own.stiffness(), boundary_->prescribed(), "estimate", own.order());
  set_stiffness(Eigen::VectorXd::Zero(unknowns()));
}

fem::Material FaceResponses::material(const Eigen::VectorXd& logs) const {
  fem::Material out = own_;
  const double whole = std::exp(logs[logs.size() - 1]);
  for (double& young : out.young_pa) young *= whole;
  for (std::size_t r = 0; r < ratios_.size(); ++r) {
    const StiffnessRatio& ratio = ratios_[r];
    const double shared = ratio.under.empty() ? 1 : 0.5;
    const double over = std::exp(shared * logs[Eigen::Index(r)]) - 1;
    const double under = std::exp(-shared * logs[Eigen::Index(r)]) - 1;
    for (std::size_t t = 0; t < out.young_pa.size(); ++t) {
      out.young_pa[t] *= 1 + ratio.over[t] * over;
      if (!ratio.under.empty()) out.young_pa[t] *= 1 + ratio.under[t] * under;
    }
  }
  return out;
}

std::vector<double> FaceResponses::young_by(const Eigen::VectorXd& logs, Eigen::Index which) const {
  std::vector<double> out = material(logs).young_pa;
  if (which == logs.size() - 1) return out;
  const StiffnessRatio& ratio = ratios_[std::size_t(which)];
  const double shared = ratio.under.empty() ? 1 : 0.5;
  const double over = std::exp(shared * logs[which]), under = std::exp(-shared * logs[which]);
  for (std::size_t t = 0; t < out.size(); ++t) {
    double by = shared * ratio.over[t] * over / (1 + ratio.over[t] * (over - 1));
    if (!ratio.under.empty())
      by -= shared * ratio.under[t] * under / (1 + ratio.under[t] * (under - 1));
    out[t] *= by;
  }
  return out;
}

fem::SparseMatrix FaceResponses::stiffness(const fem::Material& material) {
  assembler_.assemble(material, system_);
  return system_.stiffness;
}

Bands FaceResponses::at_points(const BandForces& force) const {
  return {adjoint_.transpose() * force.narrow, adjoint_.transpose() * force.wide};
}

void FaceResponses::set_stiffness(const Eigen::VectorXd& logs) {
  if (logs_.size() > 0 && logs == logs_) return;
  fem::SparseMatrix k = stiffness(material(logs));
  boundary_->add_springs(k);
  factor_->refactor(k);
  adjoint_ = unit_forces(carrier_, k.rows());
  Eigen::MatrixXd free = adjoint_(factor_->free(), Eigen::all);
  factor_->solve(free, {});
  adjoint_.setZero();
  adjoint_(factor_->free(), Eigen::all) = free;
  columns_.muscles = at_points(muscles_);
  for (std::size_t way = 0; way < 2; ++way) columns_.lines[way] = at_points(moved_lines_[way]);
  columns_.jaw = adjoint_.transpose() * jaw_;
  columns_.loads.clear();
  for (const Eigen::MatrixXd& load : loads_) columns_.loads.push_back(adjoint_.transpose() * load);
  logs_ = logs;
}

Eigen::VectorXd FaceResponses::force(const Acting& acting) const {
  Eigen::VectorXd out =
      muscles_.narrow * acting.narrow + muscles_.wide * acting.wide + jaw_ * acting.jaw;
  for (std::size_t way = 0; way < 2; ++way)
    out += moved_lines_[way].narrow * acting.narrow.cwiseProduct(acting.line_m[way]) +
           moved_lines_[way].wide * acting.wide.cwiseProduct(acting.line_m[way]);
  return out;
}

Eigen::MatrixXd FaceResponses::by_stiffness(const Acting& acting) {
  return by_stiffness_under(force(acting));
}

Eigen::MatrixXd FaceResponses::by_stiffness(std::size_t load, const Vec3& amount) {
  return by_stiffness_under(loads_[load] * amount);
}

Eigen::MatrixXd FaceResponses::by_stiffness_under(const Eigen::VectorXd& force) {
  Eigen::VectorXd free = force(factor_->free());
  factor_->solve(free);
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(force.size());
  moved(factor_->free()) = free;
  // The matrix is linear in Young's moduli: its derivative is a difference.
  fem::Material now = material(logs_);
  const Eigen::VectorXd forces = stiffness(now) * moved;
  Eigen::MatrixXd out(adjoint_.cols(), unknowns());
  for (Eigen::Index i = 0; i < unknowns(); ++i) {
    fem::Material more = now;
    const std::vector<double> by = young_by(logs_, i);
    for (std::size_t t = 0; t < by.size(); ++t) more.young_pa[t] += by[t];
    out.col(i) = -adjoint_.transpose() * (stiffness(more) * moved - forces);
  }
  return out;
}

}  // namespace hyperex::estimate
