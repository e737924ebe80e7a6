// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Twin experiments: muscles whose activations are known move a face, its landmarks are recorded
// with noise, and the program finds forces from the recording and says what other tissue and weaker
// muscles make of them. The truth is the static answer of the known forces in the changed tissue.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::test {

/// By muscle ("zyg_major_L"); those not named rest.
using Activations = std::map<std::string, double>;

/// Asked of the truth and of the program alike.
struct TwinChange {
  std::string name;
  std::vector<double> young_factor = {};  ///< a tetrahedron; empty: 1 everywhere
  std::vector<simulate::MuscleGain> gains = {};
};

struct TwinFace {
  std::shared_ptr<const tissue::TissueMesh> mesh;
  io::Landmarks landmarks;  ///< the 68 iBUG points among them
  simulate::SimulationOptions options;
};

/// How far the corners of the mouth are from rest.
struct Corners {
  double left_mm = 0, right_mm = 0;
};

/// What the truth and the program say of one expression: in base, then after each change.
struct TwinAnswer {
  std::vector<Corners> truth, found;
  Eigen::VectorXd true_groups, found_groups;  ///< activations summed over groups of a side
};

/// A face with known muscles in known tissue.
class TwinTruth {
 public:
  /// `muscles` may lie elsewhere than the program's, `young_factor` make the tissue another than
  /// the program knows of. `changes` must outlive this.
  TwinTruth(const TwinFace& face, const muscles::MuscleTable& muscles, double young_factor,
            const std::vector<TwinChange>& changes);

  /// The landmarks (68) as the expression comes in a third of a second and stays, with `noise_m` a
  /// coordinate.
  simulate::AlignedMotion recorded(const Activations& activations, double noise_m,
                                   unsigned seed) const;
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
  Points rest_;
  simulate::CarrierMatrix carrier_;
  std::unique_ptr<simulate::MuscleModel> muscles_;
  std::vector<Tissue> tissues_;  ///< base, then changed
};

/// What the program makes of a recording: forces found in `face` as the program knows it, driven by
/// `points`, held, and answered after each of `changes`.
TwinAnswer twin_answer(const TwinFace& face, const TwinTruth& truth, const Activations& activations,
                       const std::vector<TwinChange>& changes,
                       const std::vector<std::string>& points, double noise_m, unsigned seed);

/// Each muscle's whole line moved by `off_mm` along the skin, in a direction of its own.
muscles::MuscleTable displaced_lines(muscles::MuscleTable table, double off_mm, unsigned seed);

/// A smile of the left side as anatomy has it: mostly by zygomaticus major, which the program's
/// prior expects too; and one in which muscles beside it do more.
const Activations& left_smile();
const Activations& other_smile();
/// One muscle in three acts, by up to 0.7; zyg_major_L always.
Activations drawn_expression(const std::vector<muscles::MuscleLine>& lines, unsigned seed);

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace hyperex::test
