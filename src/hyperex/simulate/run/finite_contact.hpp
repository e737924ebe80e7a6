// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "hyperex/simulate/contact/finite_correction.hpp"
#include "hyperex/simulate/run/contact_frames.hpp"

namespace hyperex::simulate {

/// Corrects frames at finite strain, one after the other. Contact forces are computed with the
/// compliance at rest; then the response of the displaced tissue to them is computed. These two
/// steps are repeated for each frame until nothing penetrates any more or the improvement is small.
class FiniteContact {
 public:
  /// Returns the skin's displacement in frame `i`, given the displacement of all nodes.
  using SkinOf = std::function<PointsF(std::size_t i, const Points& nodes)>;
  /// The objects passed by reference must outlive this one.
  FiniteContact(const MouthContact& contact, FiniteCorrection& tissue, const ContactFrames& frames,
                SkinOf skin_of);

  /// Corrects a frame: `displacement` of all nodes (3 |nodes|, m). It is left unchanged where the
  /// first round finds no equilibrium; later frames that penetrate as deep are then left unchanged
  /// too. Frames are given in the order of their times.
  void correct(std::size_t frame, Eigen::Ref<Eigen::VectorXd> displacement);

  double residual_m() const { return residual_m_; }  ///< greatest of the complementarity problems
  int given_up() const { return given_up_; }         ///< frames without equilibrium
  double hopeless_m() const { return hopeless_m_; }  ///< least depth of these

 private:
  /// The effect of contact in a frame: the total displacement, and that to first order at rest.
  struct Push {
    std::size_t frame = 0;
    Eigen::VectorXd in_all, first_order;
  };
  /// A frame that is being corrected.
  struct Work {
    std::size_t frame;
    const Eigen::VectorXd without;  // displacement without contact
    PointsF skin;
    std::vector<Points> at_sides;
    Eigen::VectorXd first_order;  // of the last round's forces
    double least_m;               // depth of the best round
    double residual_m = 0;        // of that round
  };
  enum class Round { deeper, little, better, failed };
  Round round(Work& work, bool take_off, const Eigen::VectorXd* guess,
              Eigen::Ref<Eigen::VectorXd> best);
  void move(Work& work, const Eigen::VectorXd& displacement) const;
  double depth_m(const Work& work) const;

  const MouthContact& contact_;
  FiniteCorrection& tissue_;
  const ContactFrames& frames_;
  SkinOf skin_of_;
  Push last_;
  Eigen::VectorXd force_;
  double residual_m_ = 0, hopeless_m_ = std::numeric_limits<double>::infinity();
  int given_up_ = 0;
};

}  // namespace hyperex::simulate
