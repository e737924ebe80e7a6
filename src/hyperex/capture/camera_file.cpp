// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/camera_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/nesting.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/toml.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

/// Reads the values of one camera file by their keys and checks each of them.
class Reader {
 public:
  Reader(const fs::path& file, const toml::table& table) : file_(file), table_(table) {}

  double number(const std::string& key, double low, double high, const std::string& expected) {
    known_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) throw problem(0, key, "missing", expected);
    const auto value = node->value<double>();
    if (!node->is_number() || !std::isfinite(*value) || *value < low || *value > high)
      throw problem(line(*node), key, text(*node), expected);
    return *value;
  }
  int whole_number(const std::string& key, const std::string& expected) {
    const double value = number(key, 1, 65535, expected);
    const toml::node& node = *table_.get(key);
    if (value != std::floor(value)) throw problem(line(node), key, text(node), expected);
    return static_cast<int>(value);
  }
  bool holds(const std::string& key) const { return table_.get(key) != nullptr; }

  void refuse_distortion() {
    for (const char* key : {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"}) {
      if (!holds(key)) continue;
      known_.insert(key);
      const toml::node& node = *table_.get(key);
      if (node.value<double>() != 0.0)
        throw problem(line(node), key, text(node),
                      "0, as lens distortion is not modelled (undistort the pictures first)");
    }
  }
  std::vector<std::string> unused() const {
    std::vector<std::string> notes;
    for (const auto& [key, node] : table_)
      if (!known_.contains(std::string(key.str())))
        notes.push_back(fmt::format("{}:{}: {} is not used", file_.string(), line(node),
                                    io::quotable(key.str())));
    return notes;
  }

 private:
  static int line(const toml::node& node) { return static_cast<int>(node.source().begin.line); }
  static std::string text(const toml::node& node) {
    std::ostringstream out;
    node.visit([&](const auto& value) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, toml::table> || std::is_same_v<Value, toml::array>)
        out << "a list or table";
      else
        out << value;
    });
    return io::quotable(out.str());
  }
  InputError problem(int line, const std::string& key, const std::string& value,
                     const std::string& expected) const {
    return InputError(InputProblem{
        .file = file_, .line = line, .key = key, .value = value, .expected = expected});
  }

  const fs::path& file_;
  const toml::table& table_;
  std::set<std::string> known_;
};

}  // namespace

Camera read_camera_file(const fs::path& file) {
  toml::table table;
  const std::string text = read_file(file);
  io::check_nesting_toml(file, text);
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(InputProblem{file, static_cast<int>(error.source().begin.line), "", "",
                                  "TOML: " + io::quotable(error.description())});
  }
  Reader reader(file, table);
  Camera camera;
  Intrinsics& k = camera.intrinsics;
  k.width_px = reader.whole_number("width", "the pictures' width (whole pixels, 1 to 65535)");
  k.height_px = reader.whole_number("height", "the pictures' height (whole pixels, 1 to 65535)");
  k.fx_px = reader.number("fx", 1e-3, 1e6, "the focal length across, above 0 (pixels)");
  k.fy_px = reader.number("fy", 1e-3, 1e6, "the focal length down, above 0 (pixels)");
  k.cx_px =
      reader.number("cx", -k.width_px, 2 * k.width_px, "the principal point's column (pixels)");
  k.cy_px =
      reader.number("cy", -k.height_px, 2 * k.height_px, "the principal point's row (pixels)");
  if (reader.holds("depth_scale"))
    camera.depth_per_metre =
        reader.number("depth_scale", 1e-3, 1e9, "the stored depth value of one metre, above 0");
  if (reader.holds("fps")) reader.number("fps", 1e-3, 1e6, "frames a second, above 0");
  reader.refuse_distortion();
  camera.notes = reader.unused();
  return camera;
}

Intrinsics guess_intrinsics(int width_px, int height_px, double field_of_view_deg) {
  if (!(field_of_view_deg >= 10 && field_of_view_deg <= 170))
    throw InputError(fmt::format(
        "field of view {:g}: expected 10 to 170 degrees across the picture's longer side",
        field_of_view_deg));
  const double half_rad = field_of_view_deg * std::numbers::pi / 360;
  const double f_px = std::max(width_px, height_px) / (2 * std::tan(half_rad));
  return {f_px, f_px, (width_px - 1) / 2.0, (height_px - 1) / 2.0, width_px, height_px};
}

Intrinsics intrinsics_of(const std::string& source, int width, int height,
                         const SourceOptions& options, std::vector<std::string>& notes) {
  if (options.camera_file.empty()) {
    notes.push_back(
        fmt::format("{}: the camera is not known; its field of view is taken to be {:g} degrees",
                    source, options.field_of_view_deg));
    return guess_intrinsics(width, height, options.field_of_view_deg);
  }
  const Camera camera = read_camera_file(options.camera_file);
  notes.insert(notes.end(), camera.notes.begin(), camera.notes.end());
  const Intrinsics& k = camera.intrinsics;
  if (k.width_px != width || k.height_px != height)
    throw InputError(
        options.camera_file,
        fmt::format("describes pictures of {}, but those of {} are {}",
                    size_text(k.width_px, k.height_px), source, size_text(width, height)));
  return k;
}

std::string size_text(int width_px, int height_px) {
  return fmt::format("{} x {}", width_px, height_px);
}

}  // namespace hyperex::capture
