// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/frames.hpp"

#include <fmt/format.h>

#include "hyperex/core/run_together.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::run {
namespace {
using simulate::Performance;

/// The shear of a tensor is half the engineering shear.
io::VtuArray strain_array(const char* name, const fem::VoigtRows& strain) {
  io::VtuArray array{name, strain.cast<float>()};
  array.values.rightCols<3>() /= 2;
  return array;
}

bool is_finite(const Performance& p) {
  return p.model.strain == simulate::Strain::finite;
}

/// Parameters of the tissue that differ from place to place, also from layer to layer.
std::vector<io::VtuArray> graded_arrays(const Results& r) {
  std::vector<io::VtuArray> graded;
  const Eigen::Index tets = r.simulation.performance.tets.rows();
  for (int q = 0; r.tissue && q < tissue::parameter_count; ++q)
    if (r.tissue->varies_within(q))
      graded.push_back({tissue::parameter_info(q).title,
                        (Eigen::Map<const Eigen::VectorXd>(r.tissue->element[q].data(), tets) /
                         tissue::parameter_info(q).si)
                            .cast<float>()});
  return graded;
}

}  // namespace

FrameCells::FrameCells(const Performance& performance, bool with_strain)
    : performance_(performance),
      with_strain_(with_strain),
      strain_(performance.nodes, performance.tets),
      material_(metrics::elastic_material(performance)),
      finite_(is_finite(performance) ? std::make_unique<metrics::FiniteTissue>(performance)
                                     : nullptr) {}

std::vector<io::VtuArray> FrameCells::at(const Points& d) const {
  std::vector<io::VtuArray> cells;
  const auto von_mises = [&](const Eigen::VectorXd& pa) {
    cells.push_back({"von Mises stress (kPa)", (1e-3 * pa).cast<float>()});
  };
  if (finite_) {
    const metrics::FiniteState state = finite_->at(d);
    if (with_strain_) {
      cells.push_back(strain_array("Green-Lagrange strain (1)", state.green_lagrange));
      cells.push_back({"Cauchy stress (kPa)", (1e-3 * state.cauchy_pa).cast<float>()});
      cells.push_back({"principal stretches (1)", state.stretch.cast<float>()});
    }
    cells.push_back({"volume ratio J (1)", state.volume_ratio.cast<float>()});
    von_mises(state.von_mises_pa);
  } else {
    fem::VoigtRows strain = strain_.at(d);
    metrics::take_growth_off(performance_, strain);
    if (with_strain_) cells.push_back(strain_array("strain (1)", strain));
    von_mises(fem::von_mises_pa(strain, material_));
  }
  const std::vector<std::uint8_t> inverted =
      fem::inverted_tets(performance_.nodes, performance_.tets, d);
  cells.push_back({"inverted",
                   Eigen::Map<const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>>(
                       inverted.data(), static_cast<Eigen::Index>(inverted.size()))
                       .cast<float>(),
                   true});
  return cells;
}

void write_frames(const Performance& p, const std::filesystem::path& directory, int every,
                  bool with_strain, const std::vector<io::VtuArray>& more) {
  if (p.nodes.rows() == 0) return;
  std::filesystem::create_directories(directory / "frames");
  std::vector<std::pair<double, std::filesystem::path>> frames;
  const auto step = static_cast<std::size_t>(every);
  for (std::size_t f = 0; f < p.frame_time_s.size(); f += step)
    frames.emplace_back(p.frame_time_s[f],
                        std::filesystem::path("frames") / fmt::format("frame_{:04}.vtu", f));
  const io::VtuMesh mesh(p.nodes, p.tets);
  const FrameCells tissue(p, with_strain);
  run_each(frames.size(), [&](std::size_t i) {
    const Points d = p.node_displacement_m[i * step].cast<double>();
    std::vector<io::VtuArray> cells = tissue.at(d);
    cells.insert(cells.end(), more.begin(), more.end());
    mesh.write(directory / frames[i].second, {{"displacement (m)", d.cast<float>()}}, cells);
  });
  io::write_pvd(directory / "frames.pvd", frames);
}

void write_frames(const Results& r, const std::filesystem::path& directory) {
  write_frames(r.simulation.performance, directory, r.scene.output.vtu_every,
               r.scene.output.vtu_strain, graded_arrays(r));
}

}  // namespace hyperex::run
