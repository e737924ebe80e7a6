// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/good_inputs.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"

namespace hyperex {
namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void write_mm(const fs::path& file, const TriMesh& mesh) {
  io::write_ply(file, mesh, io::LengthUnit::millimetre);
}

void write_ascii_ply_mm(const fs::path& file, const TriMesh& mesh) {
  std::ofstream out(file);
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.rows()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << mesh.triangles.rows() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) out << 1e3 * mesh.points.row(v) << '\n';
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    out << "3 " << mesh.triangles.row(f) << '\n';
}

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_file(file);
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error(file.string() + " has no " + from);
  put(file, text.replace(at, from.size(), to));
}

void tear(const fs::path& file, double share) {
  fs::resize_file(file, static_cast<std::uintmax_t>(share * double(fs::file_size(file))));
}

TriMesh good_face() {
  return anatomy::embedded_face().mesh;
}
io::Landmarks good_landmarks() {
  return anatomy::embedded_face().landmarks;
}

void write_opening(const fs::path& folder, std::size_t first, std::size_t count,
                   const std::function<void(motion::Motion&)>& change) {
  motion::Motion m = motion::embedded_mouth_opening(good_landmarks());
  const auto cut = [&](auto& samples) {
    samples.erase(samples.begin(), samples.begin() + long(first));
    samples.resize(std::min(count, samples.size()));
  };
  cut(m.time_s);
  cut(m.positions);
  change(m);
  motion::write_motion_csv(folder / "motion.csv", m);
}

void keep_mouth_and_headband(motion::Motion& m) {
  const std::vector<std::pair<std::string, std::string>> kept = {
      {"ibug68_48", "ibug68_48"}, {"ibug68_54", "ibug68_54"}, {"ibug68_51", "ibug68_51"},
      {"ibug68_57", "ibug68_57"}, {"ibug68_8", "ibug68_8"},   {"ibug68_58", "ibug68_58"},
      {"ibug68_56", "ibug68_56"}, {"ibug68_17", "head_1"},    {"ibug68_21", "head_2"},
      {"ibug68_26", "head_3"},    {"ibug68_27", "head_4"},    {"ibug68_36", "head_5"},
      {"ibug68_45", "head_6"}};
  const motion::Motion whole = m;
  m.names.clear();
  for (Points& sample : m.positions) sample.resize(Eigen::Index(kept.size()), 3);
  for (const auto& [from, to] : kept) {
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      m.positions[k].row(Eigen::Index(m.names.size())) =
          whole.positions[k].row(whole.index_of(from));
    m.names.push_back(to);
  }
}

void leave_out(motion::Motion& m, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const int row = m.index_of(name);
    if (row < 0) throw std::logic_error("the motion has no " + name);
    const auto below = Eigen::Index(m.names.size()) - row - 1;
    m.names.erase(m.names.begin() + row);
    for (Points& sample : m.positions) {
      Points left(sample.rows() - 1, 3);
      left << sample.topRows(row), sample.bottomRows(below);
      sample = left;
    }
  }
}

void add_headband(motion::Motion& m) {
  // The opening moves nothing of the upper face but the head.
  const std::vector<std::string> still = {"ibug68_17", "ibug68_19", "ibug68_21", "ibug68_22",
                                          "ibug68_24", "ibug68_26", "ibug68_27"};
  const auto rows_of_still = [&](const Points& sample) {
    Points some(Eigen::Index(still.size()), 3);
    for (std::size_t i = 0; i < still.size(); ++i)
      some.row(Eigen::Index(i)) = sample.row(m.index_of(still[i]));
    return some;
  };
  const Points rest = rows_of_still(m.positions.front());
  Points band = rest.topRows(6);
  for (Eigen::Index i = 0; i < 6; ++i)
    band.row(i) += Eigen::RowVector3d(0, 0.03 + 0.005 * double(i % 3), -0.01);
  for (Points& sample : m.positions) {
    const Eigen::Isometry3d head = fit_rigid(rest, rows_of_still(sample));
    sample.conservativeResize(sample.rows() + 6, Eigen::NoChange);
    for (Eigen::Index i = 0; i < 6; ++i)
      sample.row(sample.rows() - 6 + i) = (head * Vec3(band.row(i).transpose())).transpose();
  }
  for (int i = 1; i <= 6; ++i) m.names.push_back("head_" + std::to_string(i));
}

void write_good_inputs(const fs::path& folder) {
  const auto face = anatomy::embedded_face();
  write_mm(folder / "face.ply", face.mesh);
  io::write_landmarks(folder / "face_landmarks.json", face.landmarks, io::LengthUnit::millimetre);
  write_opening(folder, 0, 16);
  put(folder / "scene.toml",
      "[scan]\n"
      "file = \"face.ply\"\n"
      "unit = \"mm\"\n"
      "landmarks = \"face_landmarks.json\"\n"
      "[motion]\n"
      "file = \"motion.csv\"\n"
      "[mesh]\n"
      "element_size_mm = 8\n"
      "layers = 1\n"
      "[time]\n"
      "step_s = 0.01\n"
      "end_s = 0.2\n"
      "frame_rate_hz = 10\n"
      "[output]\n"
      "picture_times_s = [0.1]\n");
}

}  // namespace hyperex
