// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::estimate {

/// A load of known size on a relaxed face. It determines how stiff the tissue is, which motion by
/// muscles does not.
struct KnownLoad {
  enum class Kind {
    gravity,  ///< on all tissue: a change of its direction
    weight    ///< on a place of the skin
  };
  Kind kind = Kind::gravity;
  /// While it acts and before, m/s^2 or N, in the scan's frame. The load is the difference.
  Vec3 after = Vec3::Zero(), before = Vec3::Zero();
  Vec3 place = Vec3::Zero();  ///< of a weight, m
  Vec3 amount() const { return after - before; }
};

/// The change from a head held upright, as at rest, to one that lies face up. `landmarks`:
/// complete; they define up and forward (face_frame).
KnownLoad lying_down(const io::Landmarks& landmarks);

/// A weight of `mass_kg` that hangs from the skin of an upright head at `place` (m).
KnownLoad hung_weight(const io::Landmarks& landmarks, const Vec3& place, double mass_kg);

/// Nodal forces of one m/s^2 or one N along each axis, N: 3 |nodes| x 3. A weight is spread over
/// the skin about its place as a Gaussian of kWeightSpread_m. `mass`: consistent. Throws InputError
/// for a weight farther than 10 mm from the skin.
Eigen::MatrixXd unit_forces_of(const KnownLoad& load, const tissue::TissueMesh& mesh,
                               const fem::SparseMatrix& mass);

/// Spread (1 sigma) over the skin of the tape that holds a weight.
inline constexpr double kWeightSpread_m = 0.005;

}  // namespace hyperex::estimate
