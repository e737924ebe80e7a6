// SPDX-License-Identifier: GPL-3.0-or-later
#include "open_ct.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::studio {
namespace fs = std::filesystem;

OpenCt::Slice OpenCt::slice(const fs::path& folder, int axis, double share) {
  if (!slices_ || folder != folder_) {
    const auto surface = [&](const char* name) {
      const fs::path file = folder / name;
      return fs::is_regular_file(file) ? io::read_mesh(file, io::LengthUnit::millimetre)
                                       : TriMesh{};
    };
    slices_.reset();
    skin_ = io::read_mesh(folder / "skin.ply", io::LengthUnit::millimetre);
    bones_ = {surface("skull.ply"), surface("mandible.ply")};
    slices_.emplace(series_.volume, skin_, bones_);
    folder_ = folder;
  }
  const double place_m = std::lerp(slices_->low_m(axis), slices_->high_m(axis), share);
  return {ct::HeadSlices::caption(axis, place_m), slices_->picture(axis, place_m)};
}

std::optional<double> bone_hu_of(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  if (folder.empty() || !fs::is_regular_file(file)) return {};
  const auto summary = nlohmann::json::parse(read_file(file), nullptr, false);
  const nlohmann::json::json_pointer at("/thresholds/bone_hu");
  if (summary.is_discarded() || !summary.contains(at) || !summary.at(at).is_number()) return {};
  return summary.at(at).get<double>();
}

}  // namespace hyperex::studio
