// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Twin experiments. Muscles with known activations move a face, and its landmarks are recorded with
// noise. From the recording the program estimates the forces and predicts their effect in other
// tissue and with weaker muscles. The truth is the static response to the known forces in the
// changed tissue.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::test {

/// By muscle ("zyg_major_L"); muscles that are not named have activation 0.
using Activations = std::map<std::string, double>;

/// A change that is applied both to the truth and in the program.
struct TwinChange {
  std::string name;
  std::vector<double> young_factor = {};  ///< one per tetrahedron; empty: 1 everywhere
  std::vector<simulate::MuscleGain> gains = {};
};

struct TwinFace {
  std::shared_ptr<const tissue::TissueMesh> mesh;
  io::Landmarks landmarks;  ///< includes the 68 iBUG points
  simulate::SimulationOptions options;
};

/// Distances of the corners of the mouth from rest.
struct Corners {
  double left_mm = 0, right_mm = 0;
};

/// The results of the truth and of the program for one expression: in base, then after each change.
struct TwinAnswer {
  std::vector<Corners> truth, found;
  Eigen::VectorXd true_groups, found_groups;  ///< activations summed over the groups of each side
};

/// A face with known muscles in known tissue.
class TwinTruth {
 public:
  /// `muscles` may differ in place from the program's, and `young_factor` may make the tissue
  /// differ from what the program assumes. `changes` must outlive this object. `points`:
  /// landmarks that are recorded; the corners of the mouth among them.
  TwinTruth(const TwinFace& face, const muscles::MuscleTable& muscles, double young_factor,
            const std::vector<TwinChange>& changes,
            std::vector<std::string> points = face::all_ibug());

  /// The points while the expression builds up in a third of a second and stays, with noise
  /// of standard deviation `noise_m` per coordinate. `change`: 0 for base, else 1 + an index of the
  /// changes. `jaw`: its pose at the peak.
  simulate::AlignedMotion recorded(const Activations& activations, double noise_m, unsigned seed,
                                   std::size_t change = 0,
                                   const simulate::JawPose& jaw = simulate::JawPose::Zero()) const;
  /// In base and after each change.
  std::vector<Corners> corners(const Activations& activations) const;
  const std::vector<muscles::MuscleLine>& lines() const { return muscles_->lines(); }

 private:
  struct Tissue {
    std::unique_ptr<fem::PartitionedFactor> factor;
    Eigen::Index unknowns = 0;
  };
  Tissue tissue(const TwinFace& face, const std::vector<double>& young_factor) const;
  Eigen::VectorXd force(const Activations& activations,
                        const std::vector<simulate::MuscleGain>& gains) const;
  Points moved(const Tissue& tissue, const Eigen::VectorXd& force) const;

  const std::vector<TwinChange>& changes_;
  double half_, young_factor_;
  simulate::JawKinematics jaw_;
  std::vector<std::string> points_;
  Points rest_;
  simulate::CarrierMatrix carrier_;
  std::unique_ptr<simulate::MuscleModel> muscles_;
  std::vector<Tissue> tissues_;  ///< base, then changed
};

/// The tracks of the landmarks after each of the changes, under the forces of the simulator's last
/// run. Leaves the simulator with the last change.
std::vector<motion::Motion> tracks_after(simulate::Simulator& simulator, const TwinFace& face,
                                         const std::vector<TwinChange>& changes);

/// The mean over the last frames, so that the noise of a single sample does not decide.
Corners held_corners(const motion::Motion& tracks);

/// The program's results for a recording: forces estimated in `face`, as the program assumes it,
/// from `points`, and the predictions for each of `changes`.
TwinAnswer twin_answer(const TwinFace& face, const TwinTruth& truth, const Activations& activations,
                       const std::vector<TwinChange>& changes,
                       const std::vector<std::string>& points, double noise_m, unsigned seed);

/// Each muscle's whole line moved by `off_mm` along the skin, each in its own direction.
muscles::MuscleTable displaced_lines(muscles::MuscleTable table, double off_mm, unsigned seed);

/// left_smile(): an anatomically typical smile of the left side, mainly by zygomaticus major, which
/// the program's prior expects too. other_smile(): one in which neighbouring muscles do more.
const Activations& left_smile();
const Activations& other_smile();
/// A random third of the muscles is active, by up to 0.7; zyg_major_L always is.
Activations drawn_expression(const std::vector<muscles::MuscleLine>& lines, unsigned seed);

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace hyperex::test
