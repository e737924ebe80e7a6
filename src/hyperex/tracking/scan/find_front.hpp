// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to this library: finds the orientation of the face in a scan.
#include <optional>

#include "hyperex/tracking/scan/scan_viewer.hpp"

namespace hyperex::tracking {

/// Finds the face in a scan of arbitrary orientation. The scan is rendered from 42 directions, and
/// the detector searches each picture in eight rotations. The landmark network evaluates the best
/// candidates. The canonical face is fitted to its points, and the scan is rendered again from the
/// front of that face until this direction no longer changes. The pose with the best fit is
/// returned.
std::optional<FacePose> find_front(const ScanViewer& viewer, LandmarkTracker& tracker);

/// The same if the pose of the face is known approximately, to within about 20 degrees.
std::optional<FacePose> find_front_near(const ScanViewer& viewer, LandmarkTracker& tracker,
                                        const Similarity& scan_from_canonical);

}  // namespace hyperex::tracking
