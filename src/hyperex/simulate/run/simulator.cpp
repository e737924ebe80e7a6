// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/simulator.hpp"

#include <utility>

#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

Simulator::Simulator(std::shared_ptr<const tissue::TissueMesh> mesh, io::Landmarks landmarks,
                     AlignedMotion motion, SimulationOptions options)
    : impl_(std::make_unique<Impl>()) {
  check(options);
  impl_->mesh = std::move(mesh);
  impl_->landmarks = std::make_shared<const io::Landmarks>(std::move(landmarks));
  impl_->motion = std::make_shared<const AlignedMotion>(std::move(motion));
  impl_->options = std::move(options);
}
Simulator::Simulator(const Simulator& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}
Simulator::~Simulator() = default;

const SimulationOptions& Simulator::options() const {
  return impl_->options;
}
const tissue::TissueMesh& Simulator::mesh() const {
  return *impl_->mesh;
}
const io::Landmarks& Simulator::landmarks() const {
  return *impl_->landmarks;
}
const AlignedMotion& Simulator::motion() const {
  return *impl_->motion;
}
const StageGraph& Simulator::stages() const {
  return impl_->stages;
}

void Simulator::set_options(SimulationOptions options) {
  impl_->set(std::move(options));
}
void Simulator::set_tissue(TissueValues tissue) {
  impl_->set_part(&SimulationOptions::tissue, std::move(tissue));
}
void Simulator::set_support(SupportOptions support) {
  impl_->set_part(&SimulationOptions::support, std::move(support));
}
void Simulator::set_drive(DriveOptions drive) {
  impl_->set_part(&SimulationOptions::drive, std::move(drive));
}
void Simulator::set_motion(AlignedMotion motion) {
  impl_->set(std::move(motion));
}
void Simulator::set_obstacles(std::shared_ptr<const std::vector<Obstacle>> obstacles) {
  impl_->set(std::move(obstacles));
}

void Simulator::hold_load() {
  impl_->stages.load.hold();
}
void Simulator::reuse_factor(Simulator&& spent) {
  impl_->take_factor(*spent.impl_);
}
std::shared_ptr<const EliminationOrder> Simulator::elimination_order() const {
  return impl_->stages.order.pointer();
}
void Simulator::use_order(std::shared_ptr<const EliminationOrder> order) {
  impl_->use_order(std::move(order));
}

void Simulator::check_before_run() {
  impl_->check_before_run();
}
void Simulator::prepare() {
  impl_->progress.begin({});
  impl_->prepare();
}
SimulationResult Simulator::run(const RunCallbacks& callbacks) {
  impl_->progress.begin(callbacks);
  return impl_->run();
}
PointsF Simulator::still(double time_s) {
  impl_->progress.begin({});
  return impl_->still(time_s);
}
void Simulator::start_stream(double interval_s) {
  impl_->progress.begin({});
  impl_->start_stream(interval_s);
}
PointsF Simulator::step(const Points& displacement_m) {
  return impl_->step(displacement_m);
}

SimulationResult simulate(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          const AlignedMotion& motion, const SimulationOptions& options,
                          const RunCallbacks& callbacks) {
  const std::shared_ptr<const tissue::TissueMesh> borrowed(std::shared_ptr<void>(), &mesh);
  return Simulator(borrowed, landmarks, motion, options).run(callbacks);
}

}  // namespace hyperex::simulate
