// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/readers.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "fuzz/seeds.hpp"
#include "hyperex/capture/camera_file.hpp"
#include "hyperex/capture/decode.hpp"
#include "hyperex/capture/tum_lists.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/expression/candide.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::fuzz {
namespace fs = std::filesystem;

namespace {
const capture::Intrinsics kCamera{4, 4, 2, 2, 4, 4};

void read_scan(const fs::path& file) {
  io::read_scan(file, std::nullopt);
}
void read_landmarks(const fs::path& file) {
  io::read_landmarks(file, std::nullopt);
}
void read_motion(const fs::path& file) {
  motion::read_motion(file, std::nullopt);
}
void read_lists(const fs::path& file) {
  try {
    auto frames = capture::read_associations(file);
    capture::mark_times_going_back(frames);
  } catch (const InputError&) {
    const auto list = capture::read_picture_list(file);
    auto frames = capture::associate(list, list);
    capture::add_unpaired(list, frames);
  }
}
/// A fault of a picture is a value; here it becomes the error that a run makes of it.
void read_picture(const fs::path& file) {
  const auto colour = capture::decode_colour(file, kCamera);
  const auto depth = capture::decode_depth(file, kCamera, 5000);
  if (!colour.fault.empty()) throw InputError(colour.fault);
  if (!depth.fault.empty()) throw InputError(depth.fault);
}

void read_rig(const fs::path& file) {
  io::read_gltf_shapes(file);
}

std::vector<Reader> all() {
  return {{"ply", "in.ply", read_scan, ply_seeds()},
          {"obj", "in.obj", read_scan, obj_seeds()},
          {"stl", "in.stl", read_scan, stl_seeds()},
          {"gltf", "in.gltf", read_scan, gltf_seeds()},
          {"glb", "in.glb", read_scan, glb_seeds()},
          {"rig", "in.glb", read_rig, rig_seeds()},
          {"landmarks", "in.json", read_landmarks, landmark_seeds()},
          {"markups", "in.mrk.json", read_landmarks, markup_seeds()},
          {"csv", "in.csv", read_motion, csv_seeds()},
          {"trc", "in.trc", read_motion, trc_seeds()},
          {"scene", "in.toml", [](const fs::path& f) { scene::read_scene(f); }, scene_seeds()},
          {"camera", "camera.toml", [](const fs::path& f) { capture::read_camera_file(f); },
           camera_seeds()},
          {"lists", "rgb.txt", read_lists, list_seeds()},
          {"candide", "in.wfm", [](const fs::path& f) { expression::read_candide(f); },
           candide_seeds()},
          {"picture", "in.png", read_picture, picture_seeds()}};
}
}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> list = all();
  return list;
}

const Reader& reader(const std::string& name) {
  for (const Reader& one : readers())
    if (one.name == name) return one;
  throw std::out_of_range("there is no reader " + name);
}

std::string fault_of_message(const std::string& message) {
  constexpr std::size_t most_lines = 25, most_characters = 1000;
  if (message.empty()) return "is empty";
  std::istringstream lines(message);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    if (line.size() > most_characters) return "has a line of " + std::to_string(line.size());
    const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(line.begin(), line.end(), control)) return "has a control character";
  }
  return count > most_lines ? "has " + std::to_string(count) + " lines" : "";
}

bool try_input(const Reader& reader, const fs::path& folder, const std::string& bytes) {
  const fs::path file = folder / reader.file;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  try {
    reader.read(file);
    return true;
  } catch (const InputError& error) {
    const std::string fault = fault_of_message(error.what());
    if (!fault.empty())
      throw std::logic_error("the message " + fault + ": " +
                             std::string(error.what()).substr(0, 2000));
    return false;
  }
}

}  // namespace hyperex::fuzz
