// SPDX-License-Identifier: GPL-3.0-or-later
// The Simulator: long runs without the lock of Python, ended by Ctrl-C or by a callback.
#include "hyperex/simulate/run/simulator.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>

#include "bind.hpp"
#include "callbacks.hpp"
#include "hyperex/core/error.hpp"
#include "meshes.hpp"
#include "obstacles.hpp"
#include "performance.hpp"
#include "refuse.hpp"
#include "warn_user.hpp"

namespace hyperex::python {
namespace {

using simulate::AlignedMotion;
using simulate::SimulationOptions;
using simulate::TissueValues;
using SampleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Values a tetrahedron of some parameters are completed by the uniform ones of the others.
TissueValues completed(TissueValues values, std::size_t tets) {
  if (!values.volume_ratio.empty()) {
    const auto refuse = [](const std::string& value, const std::string& expected) {
      throw InputError(InputProblem{{}, 0, "tissue.volume_ratio", value, expected});
    };
    if (values.volume_ratio.size() != tets)
      refuse(fmt::format("{} values", values.volume_ratio.size()),
             fmt::format("one for each of the {} tetrahedra", tets));
    for (const double ratio : values.volume_ratio)
      if (!(ratio > 0) || !std::isfinite(ratio))
        refuse(fmt::format("{:g}", ratio), "positive numbers");
  }
  bool any = false;
  for (const auto& of_one : values.element) any = any || !of_one.empty();
  if (!any) return values;
  for (int p = 0; p < tissue::parameter_count; ++p) {
    const tissue::ParameterInfo& info = tissue::parameter_info(p);
    auto& element = values.element[p];
    const auto refuse = [&](const std::string& value, const std::string& expected) {
      throw InputError(InputProblem{{}, 0, "tissue." + info.name, value, expected});
    };
    if (element.empty()) element.assign(tets, values.uniform[p]);
    if (element.size() != tets)
      refuse(fmt::format("{} values", element.size()),
             fmt::format("one for each of the {} tetrahedra", tets));
    for (const double value : element)
      if (!tissue::is_allowed(p, value))
        refuse(fmt::format("{:g}", value), "numbers " + info.allowed_si);
  }
  return values;
}

/// Issues a UserWarning, at the line that called run(), for what makes a result differ from what
/// the caller expects. Python's filters decide how often; by default once a line.
void warn_of_changes(const simulate::SimulationReport& report) {
  std::vector<Note> changes;
  for (const Note& note : report.notes)
    if (note.id == "forces.found_anew" || note.id == "muscles.gain_hardly_used")
      changes.push_back(note);
  warn_user(changes);
}

class PythonSimulator {
 public:
  PythonSimulator(SharedTissueMesh mesh, io::Landmarks landmarks, AlignedMotion motion,
                  SimulationOptions options)
      : mesh_(std::move(mesh)),
        simulator_(mesh_, std::move(landmarks), std::move(motion),
                   with_all_values(std::move(options))) {}
  PythonSimulator(const PythonSimulator& other)
      : mesh_(other.mesh_), simulator_((other.refuse_if_busy(), other.simulator_)) {}

  const SharedTissueMesh& mesh() const { return mesh_; }
  const simulate::Simulator& simulator() const { return simulator_; }

  template <class Change>
  void change(Change apply) {
    const auto held = hold();
    apply(simulator_);
  }
  void set_tissue(const TissueValues& tissue) {
    change([&](auto& s) { s.set_tissue(completed(tissue, tets())); });
  }
  void set_options(const SimulationOptions& options) {
    change([&](auto& s) { s.set_options(with_all_values(options)); });
  }

  /// Called without Python's lock.
  PointsF step(const SampleArray& displacement_m) {
    const auto held = hold();
    const Eigen::Index points = simulator_.motion().rest.rows();
    if (displacement_m.ndim() != 2 || displacement_m.shape(1) != 3) {
      const py::gil_scoped_acquire python;
      refuse("displacement_m",
             "an array of shape " + py::str(displacement_m.attr("shape")).cast<std::string>(),
             fmt::format("({}, 3): points of the motion, axes (metres)", points));
    }
    return simulator_.step(
        Eigen::Map<const Points>(displacement_m.data(), displacement_m.shape(0), 3));
  }

  std::unique_ptr<RunResult> run(py::object progress, py::object cancelled) {
    const auto held = hold();
    Callbacks callbacks(std::move(progress), std::move(cancelled));
    auto run = std::make_unique<RunResult>();
    run->mesh = mesh_;
    try {
      const py::gil_scoped_release unlocked;
      run->result = simulator_.run(callbacks.for_run());
    } catch (const simulate::Cancelled&) {
      callbacks.rethrow_if_any();
      throw;
    }
    callbacks.rethrow_if_any();
    warn_of_changes(run->result.report);
    return run;
  }

 private:
  std::size_t tets() const { return static_cast<std::size_t>(mesh_->volume.tets.rows()); }
  SimulationOptions with_all_values(SimulationOptions options) const {
    if (const auto& model = options.model;
        model.strain != simulate::Strain::finite && !(model.law == fem::Hyperelastic{}))
      spdlog::warn("model.law = {} has no effect: only finite strain has a law (strain=\"finite\")",
                   fem::to_string(model.law.law));
    options.tissue = completed(std::move(options.tissue), tets());
    return options;
  }
  /// Also a callback of the run itself, on the same thread, may not get at it.
  std::shared_ptr<std::atomic_flag> hold() const {
    if (busy_->test_and_set())
      throw std::runtime_error(
          "this simulator is running: copy it (copy.copy) before, one for each thread");
    return {busy_.get(), [](std::atomic_flag* busy) { busy->clear(); }};
  }
  void refuse_if_busy() const { hold(); }

  SharedTissueMesh mesh_;
  simulate::Simulator simulator_;
  std::unique_ptr<std::atomic_flag> busy_ = std::make_unique<std::atomic_flag>();
};

}  // namespace

void bind_simulator(py::module_& m) {
  using S = PythonSimulator;
  py::class_<S>(m, "Simulator",
                "A face that is simulated again and again: what does not depend on a change is "
                "kept. For one thread at a time; copies (copy.copy) are independent.")
      .def(py::init([](SharedTissueMesh mesh, io::Landmarks landmarks, const AlignedMotion& motion,
                       const SimulationOptions& options) {
             return std::make_unique<S>(std::move(mesh), std::move(landmarks), motion, options);
           }),
           "mesh"_a, "landmarks"_a, "motion"_a,
           py::arg_v("options", SimulationOptions{}, "SimulationOptions()"),
           "From a TissueMesh, completed landmarks (name -> metres) and an AlignedMotion.")
      .def("run", &S::run, "progress"_a = py::none(), "cancelled"_a = py::none(),
           "A Performance. `progress(share)` is called with shares that rise from 0 to 1; "
           "where `cancelled()` is true, Cancelled is raised. Ctrl-C raises KeyboardInterrupt. The "
           "simulator can be used again after each of them. Other threads of Python go on.")
      .def("set_tissue", &S::set_tissue, "tissue"_a,
           "Neither matches points nor orders the matrix again. Where forces drive (muscles or "
           "reactions), the next run finds others that meet the recording again, unless "
           "hold_load() was called before.")
      .def(
          "set_support",
          [](S& self, const simulate::SupportOptions& support) {
            self.change([&](auto& s) { s.set_support(support); });
          },
          "support"_a)
      .def(
          "set_drive",
          [](S& self, const simulate::DriveOptions& drive) {
            self.change([&](auto& s) { s.set_drive(drive); });
          },
          "drive"_a)
      .def(
          "hold_load", [](S& self) { self.change([](auto& s) { s.hold_load(); }); },
          "The forces found by the last run (else the next one), by muscles or reactions, are kept "
          "whatever tissue and support are set from now on. Later runs end no later than that one.")
      .def(
          "set_obstacles",
          [](S& self, const Obstacles& obstacles) {
            self.change([&](auto& s) { s.set_obstacles(obstacles.all); });
          },
          "obstacles"_a,
          "Teeth and eyeballs that the tissue does not enter, where ContactOptions.teeth or eyes "
          "is True.")
      .def(
          "set_motion",
          [](S& self, const AlignedMotion& motion) {
            self.change([&](auto& s) { s.set_motion(motion); });
          },
          "motion"_a)
      .def(
          "start_stream",
          [](S& self, double interval_s) {
            constexpr double slow_s = 1;
            if (interval_s > slow_s)
              warn_user({{"", Severity::warning,
                          fmt::format("interval_s = {0:g} s from sample to sample: expected "
                                      "seconds; {0:g} ms are {1:g} s",
                                      interval_s, 1e-3 * interval_s),
                          ""}});
            self.change([&](auto& s) { s.start_stream(interval_s); });
          },
          "interval_s"_a, Unlocked(),
          "For points that come in one sample after the other, interval_s apart; begins at rest. "
          "Needs options.drive.by = \"displacement\"; contact with teeth and eyes is refused.")
      .def("step", &S::step, "displacement_m"_a, Unlocked(),
           "One sample: the displacement of all points of the motion since rest (P x 3, metres, "
           "the scan's frame, in the order of motion.motion.names). Returns the skin's (vertices x "
           "3, float32).")
      .def("set_options", &S::set_options, "options"_a)
      .def_property_readonly(
          "options", [](const S& self) { return self.simulator().options(); },
          "A copy of the SimulationOptions: change it and hand it to set_options().")
      .def_property_readonly("mesh", &S::mesh)
      .def_property_readonly("landmarks",
                             [](const S& self) { return self.simulator().landmarks(); })
      .def_property_readonly("motion", [](const S& self) { return self.simulator().motion(); })
      .def("__copy__", [](const S& self) { return std::make_unique<S>(self); })
      .def("__repr__", [](const S& self) {
        return fmt::format("<hyperex.Simulator of {} nodes, driven by {}>",
                           self.mesh()->volume.nodes.rows(),
                           self.simulator().motion().motion.source.empty()
                               ? "a motion"
                               : self.simulator().motion().motion.source);
      });
}

}  // namespace hyperex::python
