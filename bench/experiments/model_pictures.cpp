// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/model_pictures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiments/models.hpp"
#include "experiments/pictures.hpp"
#include "hyperex/metrics/curve_spread.hpp"
#include "hyperex/metrics/variant_difference.hpp"

namespace hyperex::bench {

void draw_model_maps(const Study& study,
                     const std::array<const simulate::SimulationResult*, 3>& models,
                     const std::filesystem::path& file) {
  const simulate::Performance& base = models[0]->performance;
  const FacePictures pictures(study);
  std::array<Eigen::VectorXf, 3> apart_mm;
  double top = 0;
  for (std::size_t m = 1; m < 3; ++m) {
    const auto d = metrics::variant_difference(
        base.skin_displacement_m, models[m]->performance.skin_displacement_m, base.peak_frame);
    apart_mm[m] = (1e3 * d.greatest_m).cast<float>();
    top = std::max(top, double(apart_mm[m].maxCoeff()));
  }
  render::ContactSheet sheet;
  sheet.title = fmt::format("Three tissues, {}", study.name());
  sheet.note = fmt::format(
      "shapes at {:.1f} s, and the greatest distance over time between the skin of two models; "
      "red: "
      "the right crista philtri superior",
      study.scene().time.still_times_s.back());
  sheet.columns = 5;
  sheet.bar = render::ColourBar{{0, top}, "distance (mm)"};
  const auto marker = pictures.marker(study.inputs().landmarks.at("crista_philtri_superior_R"),
                                      render::palette::driven);
  const auto shape = [&](std::size_t m) {
    return moved_skin(base, models[m]->still_displacement_m.back());
  };
  const TriMesh rest = base.skin_rest;
  constexpr int width = 250, height = 317;
  for (std::size_t m = 0; m < 3; ++m)
    sheet.pictures.push_back(
        {pictures.draw({{.mesh = shape(m)}}, render::front_view(), width, height),
         fmt::format("model {}", m + 1)});
  for (std::size_t m = 1; m < 3; ++m)
    sheet.pictures.push_back(
        {pictures.draw_mouth({{.mesh = rest, .scalar = apart_mm[m], .range = {0, top}}}, width,
                             height, {marker}),
         fmt::format("models 1 and {}, on the face at rest", m + 1)});
  write_jpeg(file, render::contact_sheet(sheet));
}

void add_model_panels(const std::string& face, const std::array<metrics::SymmetryCurve, 3>& curves,
                      std::vector<CurvePanel>& panels) {
  const char* names[] = {"model 1", "model 2, right stiffer", "model 3, right softer"};
  const render::Range window{kSourceWindow_s[0], kSourceWindow_s[1]};
  CurvePanel s{.title = fmt::format("S(t), {}", face),
               .unit = "ln |xi_L - xi_R|; the thesis' axis is -10 to -4, its window shaded",
               .marked = window};
  CurvePanel tissue{.title = fmt::format("What the tissue does, {}", face),
                    .unit = "change of xi_L - xi_R against model 1, times 1000",
                    .legend_on_top = true,
                    .marked = window};
  CurvePanel parted{.title = fmt::format("How far they part, {}", face),
                    .unit = "S less that of model 1",
                    .marked = window};
  const auto own = metrics::signed_difference(curves[0]);
  for (std::size_t m = 0; m < 3; ++m) {
    s.curves.push_back({names[m], curves[m].time_s, curves[m].s, render::category_colour(m)});
    std::vector<double> change = metrics::signed_difference(curves[m]), apart(own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {  // near zero S is dominated by rounding
      const bool clear = std::min(std::abs(own[k]), std::abs(change[k])) > 10 * curves[m].floor;
      apart[k] = clear ? std::log(std::abs(change[k] / own[k])) : std::nan("");
    }
    parted.curves.push_back({"", curves[m].time_s, apart, render::category_colour(m)});
    for (std::size_t k = 0; k < change.size(); ++k) change[k] = 1e3 * (change[k] - own[k]);
    tissue.curves.push_back({names[m], curves[m].time_s, change, render::category_colour(m)});
  }
  // A range other than that of the thesis where these curves lie outside it.
  s.range = {-10, std::max(-4.0, std::ceil(range_of(s.curves).high))};
  if (!curves[0].noise.empty()) {
    Curve floor{"noise floor", curves[0].time_s, {}, render::palette::faint_ink};
    for (const double noise : curves[0].noise) floor.value.push_back(std::log(noise));
    s.curves.push_back(std::move(floor));
  }
  tissue.range = range_of(tissue.curves);
  parted.range = range_of(parted.curves);
  panels.push_back(std::move(s));
  panels.push_back(std::move(parted));
  panels.push_back(std::move(tissue));
}

}  // namespace hyperex::bench
