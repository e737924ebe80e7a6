// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/io/vtu.hpp"
#include "hyperex/metrics/finite_tissue.hpp"
#include "hyperex/run/outputs.hpp"

namespace hyperex::run {

/// What ParaView shows of each tetrahedron of a performance. Of small strain:
///   "strain (1)"              xx, yy, zz, xy, yz, xz of the tensor; only `with_strain`
///   "von Mises stress (kPa)"
/// Of finite strain, all of the elastic part (metrics::FiniteTissue):
///   "Green-Lagrange strain (1)", "Cauchy stress (kPa)"  the tensors; only `with_strain`
///   "principal stretches (1)" rising; only `with_strain`
///   "volume ratio J (1)"
///   "von Mises stress (kPa)"  of Cauchy's
/// Of both:
///   "inverted"                1 where the element is turned inside out, else 0: strain and stress
///                             mean nothing there
class FrameCells {
 public:
  /// Refers to `performance`.
  FrameCells(const simulate::Performance& performance, bool with_strain);
  /// At the displacement `d` (|nodes| x 3, metres).
  std::vector<io::VtuArray> at(const Points& d) const;

 private:
  const simulate::Performance& performance_;
  bool with_strain_;
  fem::ElementStrain strain_;
  fem::Material material_;
  std::unique_ptr<const metrics::FiniteTissue> finite_;  // null: small strain
};

/// Writes frames.pvd and frames/frame_NNNN.vtu: the tissue in every `every`-th frame (> 0), at
/// rest, its displacement an array ("Warp By Vector" moves it), with `more` arrays of its
/// tetrahedra in each. Nothing where no tissue was simulated.
void write_frames(const simulate::Performance& performance, const std::filesystem::path& directory,
                  int every, bool with_strain, const std::vector<io::VtuArray>& more = {});
/// As the scene's output.vtu_every and vtu_strain ask for, with the parameters of its tissue that
/// differ from place to place.
void write_frames(const Results& results, const std::filesystem::path& directory);

}  // namespace hyperex::run
