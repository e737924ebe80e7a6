// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::bench {

/// Parameters of the tissue, one value per tetrahedron, SI (tissue::Parameter).
using Tissue = std::array<std::vector<double>, tissue::parameter_count>;

/// One simulation of a study's face.
struct Trial {
  Tissue tissue;
  fem::ElementKind element = fem::ElementKind::tet4_star;
  fem::ViscousForm form = fem::ViscousForm::isotropic;
  bool reduced = true;  ///< false: the full model at every step
};

/// A scene that is read and meshed once, and simulated any number of times with different tissue.
class Study {
 public:
  /// `overrides` as for hyperex run --set.
  explicit Study(const std::filesystem::path& scene,
                 const std::vector<std::string>& overrides = {});
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  const scene::Scene& scene() const { return scene_; }
  const session::Inputs& inputs() const { return session_.inputs(); }
  const tissue::TissueMesh& mesh() const { return session_.mesh(); }
  const face::FaceFrame& frame() const { return frame_; }
  bool embedded() const { return scene_.scan.source.embedded; }
  /// "embedded face", "subject A"
  std::string name() const;

  /// The tissue of the scene, or of one of its variants.
  Tissue tissue_of(const scene::Scene& scene);
  Trial own_trial() {
    return {tissue_of(scene_), scene_.model.element, scene_.model.viscous_form, true};
  }

  simulate::SimulationResult simulate(const Trial& trial) const;
  /// Simulates all trials at once, with progress on standard error. `take` gets each result and is
  /// called from several threads.
  void simulate_all(const std::vector<Trial>& trials,
                    const std::function<void(std::size_t, simulate::SimulationResult)>& take) const;
  simulate::SimulationResult simulate(const Trial& trial,
                                      const simulate::AlignedMotion& motion) const;
  /// Only for a scene driven by forces: the forces found in the first trial's tissue are applied to
  /// all.
  std::vector<simulate::SimulationResult> by_same_forces(const std::vector<Trial>& trials) const;
  metrics::SymmetryCurve symmetry_of(const motion::Motion& landmarks) const;

  /// The motion reflected in the face's midsagittal plane: each point gets the mirrored motion of
  /// its counterpart on the other side.
  simulate::AlignedMotion mirrored_motion() const;

 private:
  simulate::SimulationResult simulate(const Trial& trial,
                                      const simulate::AlignedMotion* motion) const;
  simulate::SimulationOptions options_of(const Trial& trial) const;

  scene::Scene scene_;
  session::FaceSession session_;
  face::FaceFrame frame_;
  simulate::Simulator base_;  // has run; every trial starts from a copy of it
};

/// Positions of a landmark over time, N x 3 (m); the landmark must exist.
Points track_of(const motion::Motion& landmarks, const std::string& name);

/// The tissue with one parameter multiplied.
Tissue times(Tissue tissue, tissue::Parameter parameter, double factor);

/// The tissue with a hundredth of the viscosity and of the density. It follows its input at once,
/// up to a hundredth of the lag. Without any viscosity, jitter of the recording would make it
/// oscillate.
Tissue at_once(Tissue tissue);

/// Landmarks that move by more than a millimetre and are farther than twice the radius of a driven
/// patch from all driven points. They are moved through the tissue alone.
std::vector<std::string> undriven_landmarks(const Study& study, const simulate::Performance& p);

}  // namespace hyperex::bench
