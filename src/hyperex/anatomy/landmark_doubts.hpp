// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::anatomy {

/// How far a landmark is from the place that the others predict.
struct LandmarkSurprise {
  std::string name;
  Vec3 expected = Vec3::Zero();  ///< scan frame, m
  double distance_m = 0;         ///< of the given position from the expected one
  /// The same in standard deviations of the prediction (Mahalanobis distance of three coordinates).
  double deviations = 0;
};

/// The place of each landmark as predicted from the others, without itself and its other names.
/// Faces differ from the canonical face by a similarity and a smooth field of displacements, mostly
/// the same on both sides: a Gaussian process over the canonical face whose covariance joins each
/// place with those near it and with their mirror images. All landmarks are left out in turn by one
/// inverse (C. E. Rasmussen, C. K. I. Williams, "Gaussian Processes for Machine Learning", 2006,
/// 5.4.2), the similarity's seven parameters being unknowns with a flat prior (there, 2.7). In the
/// order of the names; empty for fewer than five landmarks that the canonical face knows, or where
/// they lie nearly on a line. `given`: m.
std::vector<LandmarkSurprise> landmark_surprises(const io::Landmarks& given);

/// The same relative to landmarks that the program found on the same scan (tracking/scan). The
/// offsets between a person's and the program's landmarks vary smoothly over the face and are
/// similar on both sides, so a misplaced landmark is an outlier. This finds far more errors than
/// the comparison with the canonical face.
std::vector<LandmarkSurprise> landmark_surprises(const io::Landmarks& given,
                                                 const io::Landmarks& found);

/// Landmarks that are probably not where their names say: `landmarks.doubtful` for each, with the
/// distance in mm and what to do, the most doubtful first; where there are many, only
/// `landmarks.many_doubtful`. Three checks:
///  * two names of one place (face::same_place) are more than 5 mm apart; the one that is farther
///  from
///    its predicted place is named;
///  * a landmark is more than 7 mm and 3.5 standard deviations (2.75 of at most 20 landmarks) from
///    its predicted place (landmark_surprises); the worst one is left out before the next is
///    judged;
///  * a landmark is more than 5 mm off the scan's surface.
/// These landmarks are only reported. complete_landmarks refuses landmarks, by far wider bounds.
std::vector<Note> landmark_doubts(const io::Landmarks& given, const TriMesh& scan);
/// The names of these landmarks, also where there are many; rising.
std::vector<std::string> doubtful_landmarks(const io::Landmarks& given, const TriMesh& scan);

/// The same by landmarks that the program found on this scan: those more than 7 mm and 3.5 standard
/// deviations from the places that these predict (landmark_surprises). Single landmarks were moved
/// by 10 mm on three faces; over 99 % were found at eyes and lips, 98 % at brows and nose, and 12 %
/// at the outline of the jaw, along which landmarks are poorly defined.
std::vector<Note> landmark_doubts(const io::Landmarks& given, const io::Landmarks& found);

}  // namespace hyperex::anatomy
