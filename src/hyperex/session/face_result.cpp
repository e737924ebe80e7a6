// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/face_result.hpp"

#include "hyperex/io/scan.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/report/glb.hpp"

namespace hyperex::session {

void write_glb(const std::filesystem::path& file, const FaceResult& result, double tolerance_m) {
  report::GlbOptions options;
  options.tolerance_m = tolerance_m;
  options.teeth = result.teeth.get();
  report::write_glb(file, result.performance(), *result.scan, options);
}

void write_skin_ply(const std::filesystem::path& file, const FaceResult& result) {
  const simulate::Performance& p = result.performance();
  const PointsF& d = p.skin_displacement_m[std::size_t(p.peak_frame)];
  io::write_ply(file, {p.skin_rest.points + d.cast<double>(), p.skin_rest.triangles},
                result.scan->unit,
                {{"displacement_mm",
                  Eigen::VectorXf((1e3 * d.cast<double>().rowwise().norm()).cast<float>())}});
}

void write_motion_csv(const std::filesystem::path& file, const FaceResult& result) {
  motion::write_motion_csv(file, result.performance().landmarks);
}

}  // namespace hyperex::session
