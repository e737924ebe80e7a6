// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "hyperex/ct/ct_face.hpp"
#include "hyperex/ct/head_slices.hpp"

namespace hyperex::studio {

/// The CT of the open face: its values as measured, and the surfaces that were found in them.
class OpenCt {
 public:
  explicit OpenCt(ct::SeriesVolume series) : series_(std::move(series)) {}
  OpenCt(const OpenCt&) = delete;
  OpenCt& operator=(const OpenCt&) = delete;
  const ct::SeriesVolume& series() const { return series_; }
  /// The seeds and thresholds by which the surfaces in a folder were found.
  ct::CtOptions& options_of(const std::filesystem::path& folder) { return options_[folder]; }

  struct Slice {
    std::string caption;
    render::Image picture;
  };
  /// A slice with the surfaces of a folder that ct::write_ct() wrote. `axis`: as in HeadSlices;
  /// `share`: of the way along it, 0 to 1.
  Slice slice(const std::filesystem::path& folder, int axis, double share);

 private:
  ct::SeriesVolume series_;
  std::map<std::filesystem::path, ct::CtOptions> options_;
  std::filesystem::path folder_;  ///< of the surfaces
  TriMesh skin_;
  ct::BoneSurfaces bones_;
  std::optional<ct::HeadSlices> slices_;
};

/// The threshold of bone (HU) by which the bones in such a folder were found; empty where it is
/// unknown.
std::optional<double> bone_hu_of(const std::filesystem::path& folder);

}  // namespace hyperex::studio
