// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/anatomy/teeth/teeth.hpp"
#include "hyperex/face/complexion.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

struct FaceBacking;

struct GlbOptions {
  double tolerance_m = 1e-4;                         ///< of any vertex in any frame
  double max_bytes = 20e6;                           ///< of the file
  const anatomy::Teeth* teeth = nullptr;             ///< at rest, scan frame; null: none
  face::SkinTone skin_tone = face::SkinTone::light;  ///< where the scan has no colours
  /// face_backing() of performance and teeth where the caller has it; null: it is made.
  const FaceBacking* backing = nullptr;
};

/// Report on the written file.
struct GlbReport {
  std::size_t keys = 0;
  double max_error_m = 0;  ///< largest distance of any vertex in any frame from its true place
  double bytes = 0;
};

/// Writes the moving skin as binary glTF 2.0, metres: one mesh, whose morph targets are poses of
/// the performance (pose_keys.hpp), named by their times ("pose_0.933s"), with weights from 0 to 1,
/// animated linearly at the frame times counted from the first frame. The number of poses is the
/// least that options.tolerance_m allows. If these would take more than options.max_bytes, fewer
/// poses are written (at least one), and the report states the remaining error. Normals move too.
/// The skin has the scan's texture or its vertex colours, otherwise those of complexion(). Vertices
/// are split at seams of the texture; extras.skin_vertices then gives the skin's order. A
/// performance without motion is written as a still mesh. Teeth are nodes of their own, upper_teeth
/// and lower_teeth; the lower ones move by rotation and translation, as
/// performance.jaw_now_from_rest has them, and the upper ones lie where surgery put them
/// (upper_teeth_now_from_rest). If the landmarks include the corners of the eyes, the report's
/// eyeballs are nodes eye_R and eye_L, which turn with performance.gaze. The pockets behind mouth,
/// eyes and nostrils are a second primitive of the skin's mesh, "cavity", with the same
/// morph targets. Throws InputError where the file's name does not end in .glb or it cannot be
/// written, std::invalid_argument where the performance and the scan do not belong together.
GlbReport write_glb(const std::filesystem::path& file, const simulate::Performance& performance,
                    const io::Scan& scan, const GlbOptions& options = {});

}  // namespace hyperex::report
