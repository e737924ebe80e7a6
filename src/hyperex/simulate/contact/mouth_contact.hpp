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

/// Places that may touch one obstacle, with what carries each.
struct ObstacleSide {
  std::shared_ptr<const ObstaclePlaces> places;
  std::vector<SkinCarrier> carriers;  ///< one a place; empty: of those that never come near
};

/// A face in one moment, as it is without contact.
struct FreeFrame {
  const PointsF& skin;                  ///< displacement of the whole skin, m
  const std::vector<Points>& at_sides;  ///< of the places of each ObstacleSide
  Eigen::Isometry3d jaw_now_from_rest;
};

/// Keeps the lips of a face that moves without contact from passing through each other, and its
/// tissue out of rigid bodies: a correction of each frame by itself, in static equilibrium, so that
/// nothing sticks, nothing is remembered and no energy comes in. Without friction.
///
/// The forces are those that Signorini's conditions ask for: a pair of a vertex of the lower lip
/// and a place on the upper one, or of a place and an obstacle, presses (lambda >= 0), does not
/// pass through (gap >= 0), and presses only where it touches (lambda gap = 0). With the stiffness
/// K condensed to the nodes that carry what may touch, C = (K^-1)_nn, and G the derivative of the
/// gaps, that is the linear complementarity problem
///   gap + G C G' lambda >= 0, lambda >= 0 (Wriggers, Computational Contact Mechanics, 2006).
/// Pairs are looked for anew where the skin has been moved to, some rounds, since gaps bend.
class MouthContact {
 public:
  static constexpr double kFelt_m = 5e-6;  ///< less depth is not worth a correction
  /// Displacements of nodes under unit forces on them (condensed_inverse), of K with all that holds
  /// the tissue.
  using Compliance = std::function<Eigen::MatrixXd(const std::vector<int>& nodes)>;

  /// The carriers are those of surfaces->lower() and upper(), none where lips do not touch. `held`:
  /// of recorded places, which stay where the motion without contact has them, nearly: what touches
  /// in a recording touched already when it was recorded. They give way by `give` times the
  /// tissue's own mean compliance there, since recorded lips may overlap too. `compliance` is
  /// called once, for nodes().
  MouthContact(std::shared_ptr<const LipSurfaces> surfaces, std::vector<SkinCarrier> lower,
               std::vector<SkinCarrier> upper, std::vector<ObstacleSide> sides,
               std::vector<SkinCarrier> held, double give, const Compliance& compliance);

  struct Correction {
    Eigen::VectorXd
        force;  ///< N, three a node of nodes(): contact's and what holds recorded places
    Eigen::VectorXd moved;      ///< of nodes() by these forces, to first order, m
    double before_m = 0;        ///< greatest depth of anything as it was given
    double after_m = 0;         ///< and as corrected
    double residual_m = 0;      ///< of the last complementarity problem
    int rounds = 0, pairs = 0;  ///< pairs that press, of the last round
  };
  /// May be called from several threads.
  Correction correct(const FreeFrame& frame) const;

  /// Takes displacements of nodes() off a frame: of the skin's vertices that may touch and of the
  /// places of each side.
  void take_off(const Eigen::VectorXd& moved, PointsF& skin, std::vector<Points>& at_sides) const;

  /// Nodes of the volume on which forces act.
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  struct Pair;
  std::vector<Pair> pairs_at(const FreeFrame& frame, const Points& lower, const Points& upper,
                             const Eigen::VectorXd& moved) const;

  std::shared_ptr<const LipSurfaces> surfaces_;
  std::vector<int> nodes_;
  std::vector<SkinCarrier> lower_, upper_;  // by places in nodes_
  std::vector<ObstacleSide> sides_;         // likewise
  Eigen::MatrixXd compliance_;              // 3 |nodes_| squared, m/N, recorded places being held
  Eigen::MatrixXd holding_;  // forces that hold them, of forces on the nodes; or no rows
};

}  // namespace hyperex::simulate
