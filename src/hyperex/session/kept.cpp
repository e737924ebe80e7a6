// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/kept.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "hyperex/core/packed.hpp"
#include "hyperex/core/sha256.hpp"
#include "hyperex/core/version.hpp"
#include "hyperex/tracking/scan/scan_landmarks.hpp"

namespace hyperex::session {
namespace {
using nlohmann::json;
namespace fs = std::filesystem;

template <class Matrix>
void add_matrix(Sha256& hash, const Matrix& matrix) {
  const std::int64_t size[2] = {matrix.rows(), matrix.cols()};
  hash.add(size, sizeof size);
  hash.add(matrix.data(), sizeof(typename Matrix::Scalar) * std::size_t(matrix.size()));
}

Sha256 hash_for(const char* what) {
  Sha256 hash;
  hash.add_text(what);
  hash.add_text(version());
  hash.add_text(program_identity());
  return hash;
}

std::string key_of_landmarks(const io::Scan& scan, const render::VertexColours& colours,
                             const std::optional<Similarity>& start) {
  Sha256 hash = hash_for("landmarks of a scan, 1");
  add_matrix(hash, scan.mesh.points);
  add_matrix(hash, scan.mesh.triangles);
  add_matrix(hash, colours);
  if (start) {
    add_matrix(hash, start->rotation);
    add_matrix(hash, start->translation);
    hash.add(&start->scale, sizeof start->scale);
  }
  return "landmarks-" + hash.hex();
}

/// Every file of a recording by name and bytes; false where that cannot be had, as of a camera.
bool add_recording(Sha256& hash, const fs::path& recording) {
  std::error_code error;
  if (fs::is_regular_file(recording, error)) return hash.add_file(recording);
  if (!fs::is_directory(recording, error)) return false;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(recording, error), end; !error && at != end;
       at.increment(error))
    if (at->is_regular_file()) files.push_back(at->path());
  if (error) return false;
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    hash.add_text(file.lexically_relative(recording).string());
    if (!hash.add_file(file)) return false;
  }
  return true;
}

/// Empty where the recording is none that could be kept.
std::string key_of_recording(const scene::Scene& scene) {
  const scene::MotionOptions& m = scene.motion;
  Sha256 hash = hash_for("a tracked recording, 2");
  hash.add_text(m.recording.string());  // which notes may name
  const bool flags[2] = {m.mirrored, scene.region.measured != simulate::Measured::none};
  hash.add(flags, sizeof flags);
  hash.add_text({reinterpret_cast<const char*>(m.rest_s.data()), 8 * m.rest_s.size()});
  if (!m.candide.empty() && !hash.add_file(m.candide)) return "";
  if (!add_recording(hash, m.recording)) return "";
  return "recording-" + hash.hex();
}

json binary(const void* bytes, std::size_t size) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  return json::binary({first, first + size});
}

template <class Matrix>
Matrix matrix_from(const json& bytes, Eigen::Index rows) {
  const auto& from = bytes.get_binary();
  Matrix matrix(rows, 3);
  const std::size_t size = sizeof(typename Matrix::Scalar) * std::size_t(matrix.size());
  if (from.size() != size) throw std::runtime_error("of another size");
  std::memcpy(matrix.data(), from.data(), size);
  return matrix;
}

json json_of(const io::Landmarks& landmarks) {
  json points = json::object();
  for (const auto& [name, at] : landmarks) points[name] = {at.x(), at.y(), at.z()};
  return points;
}

io::Landmarks landmarks_in(const json& points) {
  io::Landmarks landmarks;
  for (const auto& [name, at] : points.items())
    landmarks[name] = Vec3(at.at(0), at.at(1), at.at(2));
  return landmarks;
}

json json_of(const std::vector<Note>& notes) {
  json all = json::array();
  for (const Note& note : notes)
    all.push_back({note.id, note.severity == Severity::warning, note.text, note.key});
  return all;
}

std::vector<Note> notes_in(const json& all) {
  std::vector<Note> notes;
  for (const json& one : all)
    notes.push_back({one.at(0), one.at(1).get<bool>() ? Severity::warning : Severity::note,
                     one.at(2), one.at(3)});
  return notes;
}

std::string packed(const json& value) {
  const std::vector<std::uint8_t> bytes = json::to_cbor(value);
  return {bytes.begin(), bytes.end()};
}

/// The result of `read`, or nothing if the bytes do not have the expected form.
template <class Read>
auto unpacked(const std::string& bytes, Read read)
    -> std::optional<decltype(read(std::declval<const json&>()))> {
  try {
    return read(json::from_cbor(bytes));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string kept_key(const std::string& what, const std::string& bytes) {
  Sha256 hash = hash_for(what.c_str());
  hash.add_text(bytes);
  return what + "-" + hash.hex();
}

std::string bytes_of(const FoundLandmarks& found) {
  return packed({{"points", json_of(found.landmarks)},
                 {"views", found.views},
                 {"spread_m", found.spread_m},
                 {"without_colours", found.without_colours}});
}

std::optional<FoundLandmarks> landmarks_from(const std::string& bytes) {
  return unpacked(bytes, [](const json& from) {
    FoundLandmarks found;
    found.landmarks = landmarks_in(from.at("points"));
    found.views = from.at("views");
    found.spread_m = from.at("spread_m");
    found.without_colours = from.at("without_colours");
    return found;
  });
}

std::string bytes_of(const anatomy::CompletedLandmarks& completed) {
  return packed({{"points", json_of(completed.landmarks)}, {"placed", completed.placed}});
}

std::optional<anatomy::CompletedLandmarks> completed_from(const std::string& bytes) {
  return unpacked(bytes, [](const json& from) {
    anatomy::CompletedLandmarks completed;
    completed.landmarks = landmarks_in(from.at("points"));
    from.at("placed").get_to(completed.placed);
    return completed;
  });
}

std::string bytes_of(const RecordedFace& recorded) {
  const motion::Motion& m = recorded.motion;
  json positions = json::array(), poses = json::array();
  for (const Points& at : m.positions)
    positions.push_back(binary(at.data(), sizeof(double) * std::size_t(at.size())));
  for (const auto& pose : m.head_pose) {
    const Eigen::Matrix<double, 4, 4> matrix = pose.matrix();
    poses.push_back(binary(matrix.data(), sizeof(double) * 16));
  }
  return packed({{"names", m.names},
                 {"time_s", m.time_s},
                 {"positions", positions},
                 {"triangles", binary(m.triangles.data(), sizeof(int) * m.triangles.size())},
                 {"poses", poses},
                 {"notes", json_of(recorded.notes)}});
}

std::optional<RecordedFace> recorded_from(const std::string& bytes) {
  return unpacked(bytes, [](const json& from) {
    RecordedFace recorded;
    motion::Motion& m = recorded.motion;
    from.at("names").get_to(m.names);
    from.at("time_s").get_to(m.time_s);
    const auto points = Eigen::Index(m.names.size());
    for (const json& at : from.at("positions"))
      m.positions.push_back(matrix_from<Points>(at, points));
    const json& triangles = from.at("triangles");
    m.triangles = matrix_from<Triangles>(
        triangles, Eigen::Index(triangles.get_binary().size() / (3 * sizeof(int))));
    for (const json& pose : from.at("poses")) {
      Eigen::Isometry3d& of = m.head_pose.emplace_back();
      if (pose.get_binary().size() != sizeof(double) * 16)
        throw std::runtime_error("of another size");
      std::memcpy(of.matrix().data(), pose.get_binary().data(), sizeof(double) * 16);
    }
    recorded.notes = notes_in(from.at("notes"));
    const bool points_named =
        m.triangles.size() == 0 || (m.triangles.minCoeff() >= 0 && m.triangles.maxCoeff() < points);
    if (m.positions.size() != m.time_s.size() || !points_named ||
        (!m.head_pose.empty() && m.head_pose.size() != m.time_s.size()))
      throw std::runtime_error("of another size");
    return recorded;
  });
}

FoundLandmarks landmarks_on(const io::Scan& scan,
                            const std::optional<Similarity>& scan_from_canonical,
                            const KeptResults& kept) {
  const render::VertexColours colours = tracking::picture_colours(scan);
  const std::string key = kept.in_use() ? key_of_landmarks(scan, colours, scan_from_canonical) : "";
  if (const auto bytes = kept.find(key))
    if (auto found = landmarks_from(*bytes)) {
      spdlog::info(
          "using the landmarks that an earlier run found on this scan (--no-cache finds them "
          "anew)");
      return *std::move(found);
    }
  auto searched = tracking::find_scan_landmarks(scan.mesh, colours, scan.file.string(),
                                                {.scan_from_canonical = scan_from_canonical});
  FoundLandmarks found{std::move(searched.landmarks), searched.views, searched.spread_m,
                       searched.without_colours};
  kept.keep(key, bytes_of(found));
  return found;
}

anatomy::CompletedLandmarks completed_landmarks(const io::Landmarks& given, const io::Scan& scan,
                                                const std::string& source,
                                                const KeptResults& kept) {
  if (!kept.in_use()) return anatomy::complete_landmarks(given, scan.mesh, source);
  Packer of;
  of(scan.mesh.points, scan.mesh.triangles);
  for (const auto& [name, at] : given) of(name, at);
  const std::string key = kept_key("completed", of.bytes());
  if (const auto bytes = kept.find(key))
    if (auto completed = completed_from(*bytes)) return *std::move(completed);
  auto completed = anatomy::complete_landmarks(given, scan.mesh, source);
  kept.keep(key, bytes_of(completed));
  return completed;
}

RecordedFace recorded_face(const scene::Scene& scene, const std::function<RecordedFace()>& track) {
  const std::string key = scene.kept.in_use() ? key_of_recording(scene) : "";
  if (key.empty()) return track();
  if (const auto bytes = scene.kept.find(key))
    if (auto recorded = recorded_from(*bytes)) {
      spdlog::info("using the recording as an earlier run tracked it (--no-cache tracks it anew)");
      return *std::move(recorded);
    }
  RecordedFace recorded = track();
  scene.kept.keep(key, bytes_of(recorded));
  return recorded;
}

}  // namespace hyperex::session
