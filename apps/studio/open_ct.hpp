// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "hyperex/ct/head_slices.hpp"
#include "hyperex/ct/read_series.hpp"

namespace hyperex::studio {

/// The CT of the open face: its values as measured, and the surfaces that were found in them last.
class OpenCt {
 public:
  explicit OpenCt(ct::SeriesVolume series) : series_(std::move(series)) {}
  const ct::SeriesVolume& series() const { return series_; }

  struct Slice {
    std::string caption;
    render::Image picture;
  };
  /// A slice with the surfaces of a folder that ct::write_ct() wrote. `axis`: as in HeadSlices;
  /// `share`: of the way along it, 0 to 1.
  Slice slice(const std::filesystem::path& folder, int axis, double share);

 private:
  ct::SeriesVolume series_;
  std::filesystem::path folder_;  ///< of the surfaces
  TriMesh skin_;
  ct::BoneSurfaces bones_;
  std::optional<ct::HeadSlices> slices_;
};

/// The value of bone by which the bones in such a folder were found; empty where it is unknown.
std::optional<double> bone_hu_of(const std::filesystem::path& folder);

}  // namespace hyperex::studio
