// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/muscle_shapes.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/fold_pull.hpp"

namespace hyperex::muscles {
namespace {

/// Ends of a ring's halves are joined if they lie nearer to each other, and farther from the
/// midline, where the half of the other side goes on. On the template's face.
constexpr double kWidestGap_mm = 15, kMidline_mm = 5;
constexpr double kMeet_m = 1e-6;

/// The Latin name of a ring without that of its half: "orbicularis oculi, orbital part".
std::string without_half(std::string latin) {
  for (const std::string_view half : {"upper ", "lower "})
    if (const auto at = latin.find(half); at != std::string::npos) latin.erase(at, half.size());
  return latin;
}

bool are_halves(const TemplateMuscle& a, const TemplateMuscle& b) {
  return a.kind == MuscleKind::ring && b.kind == MuscleKind::ring && a.latin != b.latin &&
         without_half(a.latin) == without_half(b.latin);
}

/// The middle between an end of a line and the nearer end of another; nothing where they meet, or
/// are not to be joined.
std::optional<Vec3> middle_to(const Vec3& end, const MuscleLine& other,
                              const face::FaceFrame& frame) {
  const double mm = 1e-3 * other.scale;
  if (std::abs(frame.local(end).x()) < kMidline_mm * mm) return {};
  const Vec3 first = other.line.row(0), last = other.line.row(other.line.rows() - 1);
  const Vec3 near = (first - end).norm() < (last - end).norm() ? first : last;
  const double gap = (near - end).norm();
  if (gap < kMeet_m || gap > kWidestGap_mm * mm) return {};
  return Vec3(0.5 * (end + near));
}

/// The line with what leads from its ends to those of the other half.
Points led_on(const MuscleLine& half, const MuscleLine& other, const face::FaceFrame& frame) {
  const Eigen::Index rows = half.line.rows();
  const auto before = middle_to(half.line.row(0), other, frame);
  const auto after = middle_to(half.line.row(rows - 1), other, frame);
  Points line(rows + (before ? 1 : 0) + (after ? 1 : 0), 3);
  line.middleRows(before ? 1 : 0, rows) = half.line;
  if (before) line.row(0) = before->transpose();
  if (after) line.bottomRows<1>() = after->transpose();
  return line;
}

}  // namespace

std::vector<MuscleShape> muscle_shapes(const std::vector<MuscleLine>& lines,
                                       const MuscleTable& table, const tissue::TissueMesh& mesh,
                                       const io::Landmarks& landmarks) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  std::optional<Points> fold[2];  // of the right and of the left side
  std::vector<MuscleShape> shapes;
  for (const MuscleLine& line : lines) {
    const TemplateMuscle& muscle = table[std::size_t(line.row)];
    MuscleShape shape{line.line, {}};
    for (const MuscleLine& other : lines)
      if (other.left == line.left && are_halves(muscle, table[std::size_t(other.row)])) {
        shape.line = led_on(line, other, frame);
        break;
      }
    if (muscle.ends_in_fold()) {
      std::optional<Points>& whole = fold[line.left ? 1 : 0];
      if (!whole) whole = nasolabial_fold(mesh, landmarks, line.left);
      const Points part = part_of_fold(*whole, muscle);
      shape.sheet.resize(1 + part.rows(), 3);
      shape.sheet << line.line.topRows<1>(), part;
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace hyperex::muscles
