// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/ct/thresholds.hpp"
#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

/// The head alone: what lies beside it is air, and the air within it is tissue.
struct Body {
  /// Values as measured, but those of couch, head rest and other things are the commonest of air,
  /// and those of air inside (sinuses, airways) the commonest of soft tissue.
  Volume volume;
  Mask mask;                    ///< the head's values of at least the skin's, air inside left out
  bool couch = false;           ///< something was taken for a couch and removed
  bool doubtful_couch = false;  ///< what looks like one is more than half of all: it was kept
  bool too_low_for_couch = false;  ///< the stack is lower than 60 mm: none is looked for
  double couch_cm3 = 0;            ///< its volume
  double cavities_cm3 = 0;         ///< of the air inside
};

/// A couch runs through the whole scan: columns of values along the patient that are at least the
/// skin's in 95 % of the slices are couch where they lie together, are at most 30 mm thick and
/// reach more than 8 mm outside the outline of the rest. 2.5 mm around them are removed with them,
/// so that a head that rests on a couch has a flat place there. Stacks lower than 60 mm are not
/// searched for a couch. After the couch is removed, the head is the largest connected piece. Air
/// belongs to the head if a ball of 8 mm cannot reach it from outside and if it is either at least
/// 6 mm below the surface or completely enclosed. Throws InputError, naming `source`, if nothing is
/// left.
Body find_body(const Volume& volume, const Thresholds& thresholds, const std::string& source);

}  // namespace hyperex::ct
