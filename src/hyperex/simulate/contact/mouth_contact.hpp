// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "hyperex/simulate/contact/lip_surfaces.hpp"
#include "hyperex/simulate/contact/obstacles.hpp"
#include "hyperex/simulate/drive/skin_carriers.hpp"

namespace hyperex::simulate {

/// The places that may come into contact with one obstacle, with the nodes that carry each.
struct ObstacleSide {
  std::shared_ptr<const ObstaclePlaces> places;
  std::vector<SkinCarrier> carriers;  ///< per place; empty: it is never in contact
};

/// A face at one moment, without contact.
struct FreeFrame {
  const PointsF& skin;                  ///< displacement of the whole skin, m
  const std::vector<Points>& at_sides;  ///< displacement of the places of each ObstacleSide, m
  Eigen::Isometry3d jaw_now_from_rest;
  /// Pose of the upper teeth after surgery.
  Eigen::Isometry3d upper_teeth_now_from_rest = Eigen::Isometry3d::Identity();
};

/// Keeps the lips of a moving face from passing through each other, and its tissue from entering
/// rigid bodies. It corrects each frame by itself, in static equilibrium and without friction. So
/// nothing sticks, no frame depends on another, and no energy is added.
///
/// The contact forces obey Signorini's conditions. A pair is a vertex of the lower lip and a place
/// on the upper one, or a place and an obstacle. It presses (lambda >= 0), does not pass through
/// (gap >= 0), and presses only where it touches (lambda gap = 0). With the compliance C =
/// (K^-1)_nn of the nodes that carry the pairs, and G the derivative of the gaps, that is the
/// linear complementarity problem
///   gap + G C G' lambda >= 0, lambda >= 0 (Wriggers, Computational Contact Mechanics, 2006).
/// Gaps are not linear, and so the pairs are found again at the corrected skin, for some rounds.
class MouthContact {
 public:
  static constexpr double kFelt_m = 5e-6;  ///< frames with less depth are not corrected
  /// Displacements of nodes under unit forces on them (condensed_inverse), m/N. K contains
  /// everything that holds the tissue.
  using Compliance = std::function<Eigen::MatrixXd(const std::vector<int>& nodes)>;

  /// `lower` and `upper`: carriers of surfaces->lower() and upper(); empty where the lips may pass
  /// through each other. `held`: carriers of recorded places. Springs hold these places where the
  /// motion without contact has them, since the recording already contains the effect of contact.
  /// The springs' compliance is `give` times the tissue's mean compliance there, since recorded
  /// lips may overlap too. `compliance` is called once, for nodes().
  MouthContact(std::shared_ptr<const LipSurfaces> surfaces, std::vector<SkinCarrier> lower,
               std::vector<SkinCarrier> upper, std::vector<ObstacleSide> sides,
               std::vector<SkinCarrier> held, double give, const Compliance& compliance);

  struct Correction {
    /// Nodal forces (N) of contact and of the springs that hold recorded places: three numbers per
    /// node of nodes().
    Eigen::VectorXd force;
    Eigen::VectorXd moved;      ///< displacement of nodes() by these forces, to first order, m
    double before_m = 0;        ///< greatest depth before the correction
    double after_m = 0;         ///< and after it
    double residual_m = 0;      ///< of the last complementarity problem
    int rounds = 0, pairs = 0;  ///< pairs that press in the last round
  };
  /// May be called from several threads.
  Correction correct(const FreeFrame& frame) const;

  /// Subtracts displacements of nodes() from a frame: from the skin's vertices that may come into
  /// contact and from the places of each side.
  void take_off(const Eigen::VectorXd& moved, PointsF& skin, std::vector<Points>& at_sides) const;

  /// Nodes of the volume on which forces act.
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  struct Pair;
  /// Forces on nodes() of pairs that press by lambda (N).
  Eigen::VectorXd force_of(const std::vector<Pair>& pairs, const Eigen::VectorXd& lambda) const;
  void compliance_between(const std::vector<Pair>& pairs, Eigen::MatrixXd& between) const;
  Eigen::VectorXd moved_by(const Eigen::VectorXd& force) const;
  std::vector<Pair> pairs_at(const FreeFrame& frame, const Points& lower, const Points& upper,
                             const Eigen::VectorXd& moved) const;

  std::shared_ptr<const LipSurfaces> surfaces_;
  std::vector<int> nodes_;
  std::vector<SkinCarrier> lower_, upper_;  // by places in nodes_
  std::vector<ObstacleSide> sides_;         // likewise
  Eigen::MatrixXd compliance_;              // 3 |nodes_| squared, m/N, with recorded places held
  Eigen::MatrixXd holding_;  // maps forces on the nodes to those that hold the places; or no rows
};

}  // namespace hyperex::simulate
