// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/sample_data.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "hyperex/capture/tum_writer.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/sample/flawed_scan.hpp"
#include "hyperex/sample/second_face.hpp"

namespace hyperex::sample {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char *kList = "sample.json", *kProgram = "hyperex sample";
constexpr std::size_t kFrames = 60, kRestFrames = 8, kSmileFrames = 26;
constexpr double kFaceDistance_m = 0.6;
constexpr int kSize_px = 320;
constexpr ClipOptions kClip = {
    .camera = {640, 640, (kSize_px - 1) / 2.0, (kSize_px - 1) / 2.0, kSize_px, kSize_px}};

/// Rises from 0 at the start of a range of frames to 1 in its middle, and falls back to 0.
double there_and_back(std::size_t frame, std::size_t first, std::size_t count) {
  if (frame < first || frame >= first + count) return 0;
  const double phase = 2 * std::numbers::pi * double(frame - first + 1) / double(count);
  return (1 - std::cos(phase)) / 2;
}

io::VertexColours opaque(const render::VertexColours& colours) {
  io::VertexColours made(colours.rows(), 4);
  made.leftCols<3>() = colours;
  made.col(3).setConstant(255);
  return made;
}

std::set<std::string> files_of_earlier_call(const fs::path& folder) {
  std::error_code error;
  const fs::path list = folder / kList;
  if (!fs::is_regular_file(fs::symlink_status(list, error))) return {};
  const Json known = Json::parse(read_file(list), nullptr, false);
  if (!known.is_object() || known.value("program", Json()) != kProgram || !known.contains("files"))
    return {};
  std::set<std::string> names;
  for (const Json& name : known["files"])
    if (name.is_string()) names.insert(name.get<std::string>());
  return names;
}

void write_recording(const fs::path& folder) {
  RenderedFace clip = sample_clip();
  Progress progress("rendering the recording", long(kFrames));
  capture::TumWriter writer(folder, clip.intrinsics());
  while (const auto frame = clip.next()) {
    writer.add(*frame);
    progress.update(long(frame->index) + 1);
  }
  writer.finish();
  tracking::write_truth(folder, clip.truth());
}

void write_all(const fs::path& folder) {
  const anatomy::EmbeddedFace face = second_face();
  io::write_ply(folder / "second_face.ply", face.mesh, io::LengthUnit::millimetre, {},
                opaque(Person(face).colours()));
  io::write_landmarks(folder / "second_face_landmarks.json", face.landmarks,
                      io::LengthUnit::millimetre);
  const ScanFlaws flaws;
  {
    Progress progress("spoiling the scan", 0);
    const FlawedScan scan = flawed_scan(face, flaws);
    io::write_ply(folder / "flawed_scan.ply", scan.mesh, io::LengthUnit::millimetre, {},
                  opaque(scan.colours));
  }
  write_recording(folder / "recording");
  Json made;
  made["program"] = kProgram;
  made["flawed_scan"] = {{"unit", "mm"},
                         {"noise_mm", 1e3 * flaws.noise_m},
                         {"edge_mm", 1e3 * flaws.edge_m},
                         {"holes", flaws.holes},
                         {"hole_radius_mm", 1e3 * flaws.hole_radius_m},
                         {"lips", "joined"}};
  made["recording"] = {{"frames", kFrames},
                       {"rate_hz", kClip.rate_hz},
                       {"depth_noise_mm", 1e3 * kClip.depth_noise_m},
                       {"colour_noise_levels", kClip.colour_noise},
                       {"jaw_peak_deg", Person::kJawPeak_deg},
                       {"smile_right_corner_mm", Person::kSmile_mm.norm()}};
  std::vector<std::string> files = files_below(folder);
  files.push_back(kList);
  made["files"] = files;
  write_file_atomically(folder / kList, [&](std::ostream& out) { out << made.dump(2) << '\n'; });
}

}  // namespace

RenderedFace sample_clip() {
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const double phase = k < kRestFrames ? 0
                                         : 2 * std::numbers::pi * double(k + 1 - kRestFrames) /
                                               double(kFrames - kRestFrames);
    const double away = (1 - std::cos(phase)) / 2;
    moments.push_back({{.jaw_open = there_and_back(k, kRestFrames + kSmileFrames,
                                                   kFrames - kRestFrames - kSmileFrames),
                        .smile = there_and_back(k, kRestFrames, kSmileFrames)},
                       camera_from_head({.distance_m = kFaceDistance_m,
                                         .yaw_deg = 4 * std::sin(phase),
                                         .nod_deg = 2 * away,
                                         .right_m = 0.005 * std::sin(phase),
                                         .back_m = 0.005 * away})});
  }
  return {Person(second_face()), std::move(moments), kClip};
}

void write_sample_data(const fs::path& folder) {
  OutputDirectory out(folder, files_of_earlier_call);
  try {
    write_all(out.path());
    out.commit();
  } catch (const InputError& error) {
    throw InputError(out.with_own_name(error.what()));
  }
}

}  // namespace hyperex::sample
