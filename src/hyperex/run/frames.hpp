// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/io/vtu.hpp"
#include "hyperex/metrics/finite_tissue.hpp"
#include "hyperex/run/outputs.hpp"

namespace hyperex::run {

/// Values for each tetrahedron of a performance, for display in ParaView. At small strain:
///   "strain (1)"              xx, yy, zz, xy, yz, xz of the tensor; only `with_strain`
///   "von Mises stress (kPa)"
/// At finite strain, all for the elastic part (metrics::FiniteTissue):
///   "Green-Lagrange strain (1)", "Cauchy stress (kPa)"  the tensors; only `with_strain`
///   "principal stretches (1)" rising; only `with_strain`
///   "volume ratio J (1)"
///   "von Mises stress (kPa)"  of Cauchy's
/// In both cases:
///   "inverted"                1 if the element is inverted, else 0; strain and stress of an
///                             inverted element are meaningless
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

/// Writes frames.pvd and frames/frame_NNNN.vtu for every `every`-th frame (> 0). Each file contains
/// the tissue at rest and its displacement as an array, which "Warp By Vector" applies, and `more`
/// arrays of the tetrahedra. Writes nothing if no tissue was simulated.
void write_frames(const simulate::Performance& performance, const std::filesystem::path& directory,
                  int every, bool with_strain, const std::vector<io::VtuArray>& more = {});
/// The same with the scene's output.vtu_every and output.vtu_strain, and with the parameters of the
/// tissue that vary in space.
void write_frames(const Results& results, const std::filesystem::path& directory);

}  // namespace hyperex::run
