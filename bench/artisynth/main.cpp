// SPDX-License-Identifier: GPL-3.0-or-later
// artisynth_study FOLDER LANDMARKS.json: how far the template's muscles lie from those of an open
// model of the lower face (ArtiSynth: Nazari et al. 2010; Flynn et al. 2015), as the table of
// docs/muscles.md. FOLDER has face_surfaceMesh.obj and muscle_fibres.csv; their mesh has neither
// eyes nor nose, so that the canonical face is laid over it by landmarks placed by hand on lips,
// chin and the base of the nose, and our lines are carried along with their depth. Both are
// compared from in front, too: their tissue is thicker than ours, and their muscles lie deeper.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex {
namespace {

struct Segment {
  Vec3 from, to;
};
using Fibres = std::map<std::string, std::vector<Segment>>;  // by their name: "left risorius"

Fibres read_fibres(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  Fibres fibres;
  std::string line;
  std::getline(in, line);  // muscle,x1_m,...
  while (std::getline(in, line)) {
    const std::size_t comma = line.find(',');
    std::string numbers = line.substr(comma + 1);
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream row(numbers);
    Segment s;
    if (!(row >> s.from[0] >> s.from[1] >> s.from[2] >> s.to[0] >> s.to[1] >> s.to[2]))
      throw std::runtime_error(file.string() + ": not six numbers: " + line);
    fibres[line.substr(0, comma)].push_back(s);
  }
  return fibres;
}

/// Their muscle, and ours that stand for it.
const std::vector<std::pair<std::string, std::vector<std::string>>> counterparts = {
    {"zygomatic", {"zyg_major"}},
    {"levator anguli oris", {"lev_anguli"}},
    {"levator labii superioris alaeque nasi", {"lev_alaeque"}},
    {"risorius", {"risorius"}},
    {"buccinator", {"buccinator"}},
    {"depressor anguli oris", {"dep_anguli"}},
    {"depressor labii inferioris", {"dep_lab_inf"}},
    {"mentalis", {"mentalis"}},
    {"obicularis oris marginal", {"oo_up_marg", "oo_lo_marg"}},  // spelt so in the file
    {"obicularis oris peripheral", {"oo_up_per", "oo_lo_per"}},
};

/// Our face and lines in their frame.
struct Laid {
  TriMesh skin;  ///< the canonical face
  std::vector<muscles::MuscleLine> lines;
  double similarity_m = 0, off_m = 0;  ///< of the landmarks: rms after a similarity, mean as laid
};

Laid laid_over(const io::Landmarks& landmarks, const TriMesh& skin) {
  const anatomy::RegisteredFace laid = anatomy::register_canonical_face(landmarks, skin);
  const TriMesh& canonical = anatomy::canonical_face().mesh;
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  const tissue::TissueMesh mesh =
      tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded");
  std::vector<muscles::MuscleLine> lines =
      muscles::muscle_lines(muscles::muscle_template(), mesh, face.landmarks);
  Laid out{{laid.points, canonical.triangles}, lines, laid.rms_landmarks_m, 0};
  const SurfaceTree tree(canonical);
  const Points from = vertex_normals(canonical), to = vertex_normals(out.skin);
  for (muscles::MuscleLine& line : out.lines)
    for (Eigen::Index i = 0; i < line.line.rows(); ++i) {
      const Vec3 at = line.line.row(i);
      const ClosestPoint c = tree.query(at);
      Vec3 on = Vec3::Zero(), outwards = Vec3::Zero(), outwards_there = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const int v = canonical.triangles(c.triangle, k);
        on += c.weights[k] * laid.points.row(v).transpose();
        outwards += c.weights[k] * from.row(v).transpose();
        outwards_there += c.weights[k] * to.row(v).transpose();
      }
      const double height = (at - c.point).dot(outwards.normalized());
      line.line.row(i) =
          (on + laid.scan_from_canonical.scale * height * outwards_there.normalized()).transpose();
    }
  for (const auto& [name, at] : landmarks)
    out.off_m += (anatomy::canonical_face().landmark(name, laid.points) - at).norm() /
                 double(landmarks.size());
  return out;
}

/// Seen from in front: their z runs backwards.
muscles::MuscleLine from_in_front(muscles::MuscleLine line) {
  line.line.col(2).setZero();
  return line;
}

double mean_depth_mm(const Points& line, const SurfaceTree& skin) {
  double sum = 0;
  for (Eigen::Index i = 0; i < line.rows(); ++i) {
    const Vec3 at = line.row(i);
    sum += 1e3 * (at - skin.query(at).point).norm();
  }
  return sum / double(line.rows());
}

Points sampled(const Segment& s) {
  constexpr double step_m = 0.0005;
  const int pieces = std::max(1, int((s.to - s.from).norm() / step_m));
  Points out(pieces + 1, 3);
  for (int k = 0; k <= pieces; ++k)
    out.row(k) = (s.from + double(k) / pieces * (s.to - s.from)).transpose();
  return out;
}

/// Means over the length of their fibres; the nearest of our lines counts.
struct Apart {
  double in_space_mm = 0, in_front_mm = 0, most_in_front_mm = 0, angle_deg = 0;
  double theirs_deep_mm = 0, ours_deep_mm = 0;
};

muscles::OnLine nearest_of(const std::vector<muscles::MuscleLine>& lines, const Vec3& at) {
  muscles::OnLine nearest{INFINITY};
  for (const muscles::MuscleLine& line : lines)
    if (const auto on = muscles::nearest_on_line(line, at); on.distance_m < nearest.distance_m)
      nearest = on;
  return nearest;
}

Apart apart(const std::vector<Segment>& fibres, const std::vector<muscles::MuscleLine>& ours,
            const SurfaceTree& skin) {
  std::vector<muscles::MuscleLine> flat;
  for (const muscles::MuscleLine& line : ours) flat.push_back(from_in_front(line));
  Apart out;
  double weight = 0;
  for (const Segment& s : fibres) {
    const Points line = sampled(s);
    const double length = (s.to - s.from).norm(), step = length / double(line.rows() - 1);
    Vec3 way = s.to - s.from;
    way.z() = 0;
    for (Eigen::Index i = 0; i + 1 < line.rows(); ++i) {
      Vec3 at = 0.5 * (line.row(i) + line.row(i + 1)).transpose();
      out.in_space_mm += step * 1e3 * nearest_of(ours, at).distance_m;
      at.z() = 0;
      const muscles::OnLine on = nearest_of(flat, at);
      out.in_front_mm += step * 1e3 * on.distance_m;
      out.most_in_front_mm = std::max(out.most_in_front_mm, 1e3 * on.distance_m);
      const double cosine = std::min(1.0, std::abs(on.tangent.dot(way.normalized())));
      out.angle_deg += step * std::acos(cosine) * 180 / std::numbers::pi;
    }
    out.theirs_deep_mm += length * mean_depth_mm(line, skin);
    weight += length;
  }
  for (double* mean : {&out.in_space_mm, &out.in_front_mm, &out.angle_deg, &out.theirs_deep_mm})
    *mean /= weight;
  for (const muscles::MuscleLine& line : ours)
    out.ours_deep_mm += mean_depth_mm(line.line, skin) / double(ours.size());
  return out;
}

std::string table(const Fibres& fibres, const Laid& laid) {
  const SurfaceTree skin(laid.skin);
  std::string out =
      "| theirs | ours | from in front: mean distance, left / right | greatest | angle | in space: "
      "mean distance | mean depth, theirs / ours |\n|---|---|---|---|---|---|---|\n";
  for (const auto& [theirs, ours] : counterparts) {
    Apart of[2];
    for (const bool left : {true, false}) {
      std::vector<muscles::MuscleLine> same;
      for (const muscles::MuscleLine& line : laid.lines)
        for (const std::string& name : ours)
          if (line.name == name + (left ? "_L" : "_R")) same.push_back(line);
      const auto found = fibres.find((left ? "left " : "right ") + theirs);
      if (found == fibres.end()) throw std::runtime_error("no fibres of " + theirs);
      if (same.size() != ours.size()) throw std::runtime_error("no line for " + theirs);
      of[left ? 0 : 1] = apart(found->second, same, skin);
    }
    std::string names;
    for (const std::string& name : ours) names += (names.empty() ? "`" : ", `") + name + "`";
    const auto both = [&](double Apart::*value) { return (of[0].*value + of[1].*value) / 2; };
    out += fmt::format(
        "| {} | {} | {:.1f} / {:.1f} mm | {:.1f} mm | {:.0f}° | {:.1f} mm | {:.0f} / {:.0f} mm |\n",
        theirs, names, of[0].in_front_mm, of[1].in_front_mm,
        std::max(of[0].most_in_front_mm, of[1].most_in_front_mm), both(&Apart::angle_deg),
        both(&Apart::in_space_mm), both(&Apart::theirs_deep_mm), both(&Apart::ours_deep_mm));
  }
  return out;
}

}  // namespace
}  // namespace hyperex

int main(int argc, char** argv) {
  using namespace hyperex;
  if (argc != 3) {
    std::cerr << "usage: artisynth_study FOLDER LANDMARKS.json\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  if (!std::filesystem::exists(folder / "muscle_fibres.csv")) {
    std::cout << "SKIPPED: there is no " << (folder / "muscle_fibres.csv").string() << '\n';
    return 0;
  }
  try {
    const TriMesh skin = io::read_scan(folder / "face_surfaceMesh.obj", io::LengthUnit::metre).mesh;
    const io::Landmarks landmarks = io::read_landmarks(argv[2]);
    const Laid laid = laid_over(landmarks, skin);
    fmt::print(
        "{} landmarks: {:.1f} mm (rms) apart after a similarity, {:.1f} mm (mean) as laid\n\n{}",
        landmarks.size(), 1e3 * laid.similarity_m, 1e3 * laid.off_m,
        table(read_fibres(folder / "muscle_fibres.csv"), laid));
  } catch (const std::exception& error) {
    std::cerr << "artisynth_study: " << error.what() << '\n';
    return 1;
  }
}
