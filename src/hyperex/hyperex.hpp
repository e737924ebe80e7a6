// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All that a program of your own needs (docs/library.md): from a scan and a recorded motion to the
// moving face and its measures. Needs Eigen; SI units throughout.

// The front door: a face from its inputs to its results.
#include "hyperex/session/face_session.hpp"

// In: scans, landmarks, motions.
#include "hyperex/core/error.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/exaggerate.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/motion/rest.hpp"
#include "hyperex/motion/stabilise.hpp"

// A face made ready: its own landmarks completed, its soft tissue meshed, its stiffness mapped.
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmark_doubts.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

// The simulation, and the solver below it.
#include "hyperex/fem.hpp"
#include "hyperex/simulate/drive/alignment.hpp"
#include "hyperex/simulate/run/simulator.hpp"

// Out: measures and files.
#include "hyperex/io/csv.hpp"
#include "hyperex/io/vtu.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/lag.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/metrics/variant_difference.hpp"
#include "hyperex/report/glb.hpp"
