// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/outputs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/ct/pictures.hpp"
#include "hyperex/ct/summary.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::ct {
namespace {
namespace fs = std::filesystem;

constexpr auto kUnit = io::LengthUnit::millimetre;

void write_thickness(const fs::path& file, const CtFace& face) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "vertex,x_mm,y_mm,z_mm,shortest_mm,along_normal_mm,region\n";
    for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v) {
      const Vec3 p = 1e3 * face.skin.points.row(v).transpose();
      out << fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{}\n", v, p.x(), p.y(), p.z(),
                         1e3 * face.thickness.shortest_m[v], 1e3 * face.thickness.along_normal_m[v],
                         name_of(face.thickness.region[std::size_t(v)]));
    }
  });
}

}  // namespace

std::set<std::string> files_of_earlier_ct(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "summary.json";
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return {};
  const auto summary = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!summary.is_object() || summary.value("program", nlohmann::json()) != "hyperex" ||
      summary.value("command", nlohmann::json()) != "ct")
    return {};
  std::set<std::string> names;
  if (const auto listed = summary.find("files"); listed != summary.end())
    for (const auto& name : *listed)
      if (name.is_string()) names.insert(name.get<std::string>());
  return names;
}

void write_ct(const CtFace& face, const fs::path& folder) {
  Progress progress("writing surfaces and pictures", 0);
  std::vector<std::string> files;
  const auto named = [&](const char* name) {
    files.emplace_back(name);
    return folder / name;
  };
  io::write_ply(named("skin.ply"), face.skin, kUnit,
                {{"shortest_mm", (1e3 * face.thickness.shortest_m).cast<float>()},
                 {"along_normal_mm", (1e3 * face.thickness.along_normal_m).cast<float>()}});
  if (face.bones.skull.triangles.rows() > 0)
    io::write_ply(named("skull.ply"), face.bones.skull, kUnit);
  if (face.bones.mandible.triangles.rows() > 0)
    io::write_ply(named("mandible.ply"), face.bones.mandible, kUnit);
  if (!face.points.skin.empty())
    io::write_landmarks(named("landmarks.json"), face.points.skin, kUnit);
  write_thickness(named("thickness.csv"), face);
  render::write_png(named("slices.png"), draw_slices(face));
  render::write_png(named("bones_through_skin.png"), draw_bones_through_skin(face));
  render::write_png(named("thickness.png"), draw_thickness(face));
  const fs::path summary = named("summary.json");
  write_file_atomically(summary, [&](std::ostream& out) { out << summary_json(face, files); });
}

}  // namespace hyperex::ct
