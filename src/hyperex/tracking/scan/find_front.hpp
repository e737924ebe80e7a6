// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: which way the face of a scan looks.
#include <optional>

#include "hyperex/tracking/scan/scan_viewer.hpp"

namespace hyperex::tracking {

/// The face in a scan that may be turned in any way: seen from 42 sides, each picture in eight
/// turns, the places where the detector sees a face are looked at by the landmark network; the
/// canonical face is laid on what it finds, the scan seen again from that face's front until the
/// front stays, and the place where the canonical face fits best is the answer.
std::optional<FacePose> find_front(const ScanViewer& viewer, LandmarkTracker& tracker);

/// The same where it is known roughly how the face lies: within some 20 degrees.
std::optional<FacePose> find_front_near(const ScanViewer& viewer, LandmarkTracker& tracker,
                                        const Similarity& scan_from_canonical);

}  // namespace hyperex::tracking
