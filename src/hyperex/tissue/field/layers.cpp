// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "hyperex/core/assert.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/tissue/field/presets.hpp"

namespace hyperex::tissue {
namespace {

/// How far under the skin each entry of layer_parameters() ends, m; the last one never does.
std::vector<double> layer_ends(const TissueFieldOptions& options) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> ends;
  double depth_m = 0;
  for (const TissueLayer& layer : layers_of(options))
    ends.push_back(depth_m = layer.thickness_m ? depth_m + *layer.thickness_m : never);
  if (depth_m < never) ends.push_back(never);
  return ends;
}

}  // namespace

const std::vector<TissueLayer>& layers_of(const TissueFieldOptions& options) {
  const TissuePreset* preset = find_preset(options.preset);
  return options.layers.empty() && preset ? preset->layers : options.layers;
}

std::vector<TissueParameters> layer_parameters(const TissueFieldOptions& options) {
  const TissueParameters uniform = uniform_parameters(options);
  const TissuePreset* preset = find_preset(options.preset);
  const std::vector<TissueLayer>& layers = layers_of(options);
  std::vector<TissueParameters> all;
  for (const TissueLayer& layer : layers) {
    TissueParameters& own = all.emplace_back(uniform);
    for (int p = 0; p < parameter_count; ++p) {
      if (layer.value[p]) own[p] = *layer.value[p];
      if (layer.value[p] && preset && preset->factor[p]) own[p] *= *preset->factor[p];
      if (layer.factor[p]) own[p] *= *layer.factor[p];
    }
  }
  if (layers.empty() || layers.back().thickness_m) all.push_back(uniform);
  return all;
}

void check_layers(const TissueFieldOptions& options, std::vector<FieldProblem>& problems) {
  const std::vector<TissueParameters> parameters = layer_parameters(options);
  for (std::size_t i = 0; i < options.layers.size(); ++i) {
    const TissueLayer& layer = options.layers[i];
    const std::string key = fmt::format("layer[{}]", i);
    if (!layer.thickness_m && i + 1 < options.layers.size())
      problems.push_back({key + ".thickness_mm",
                          "a thickness, as only the last and deepest layer takes the rest"});
    if (layer.thickness_m && !layer_thickness_m_in.holds(*layer.thickness_m))
      problems.push_back(
          {key + ".thickness_mm", kMillimetres.from_si(layer_thickness_m_in).expected()});
    for (int p = 0; p < parameter_count; ++p) {
      const ParameterInfo& info = parameter_info(p);
      if (layer.value[p] && layer.factor[p])
        problems.push_back({key, fmt::format("either {} or its factor", info.key)});
      else if ((layer.value[p] || layer.factor[p]) && !is_allowed(p, parameters[i][p]))
        problems.push_back({key + "." + (layer.factor[p] ? factor_key(p) : info.key),
                            fmt::format("{} to stay {}; it would be {:.4g}", info.title,
                                        info.allowed, parameters[i][p] / info.si)});
    }
  }
}

std::optional<FieldProblem> layer_beneath(const TissueFieldOptions& options,
                                          const VolumeMesh& volume) {
  constexpr double slack = 1e-6;
  const std::vector<TissueLayer>& layers = layers_of(options);
  if (layers.empty()) return std::nullopt;
  const double deepest_m = volume.thickness_m.maxCoeff();
  const std::vector<double> ends_m = layer_ends(options);
  double from_m = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const bool begins = from_m >= deepest_m * (1 - slack);
    if (begins || (layers[i].thickness_m && ends_m[i] > deepest_m * (1 + slack))) {
      const bool own = !options.layers.empty();
      return FieldProblem{
          own ? fmt::format("layer[{}]{}", i, begins ? "" : ".thickness_mm") : "preset",
          fmt::format("a layer within the tissue: {} {} {:.1f} mm under the skin, and the tissue "
                      "is at most {:.1f} mm thick",
                      own ? "it" : layers[i].name, begins ? "begins" : "ends",
                      1e3 * (begins ? from_m : ends_m[i]), 1e3 * deepest_m)};
    }
    from_m = ends_m[i];
  }
  return std::nullopt;
}

std::vector<Note> notes_on_layers(const TissueFieldOptions& options, const VolumeMesh& volume) {
  const std::vector<double> ends_m = layer_ends(options);
  if (ends_m.size() < 2) return {};
  constexpr double slack = 1e-6;                      // where the layers fill the tissue exactly
  const double begins_m = ends_m[ends_m.size() - 2];  // what lies under all the others
  const Eigen::VectorXd areas = node_areas(volume.outer);
  const Eigen::ArrayXd too_thin =
      (volume.thickness_m.array() < begins_m * (1 - slack)).cast<double>();
  const double share = areas.dot(too_thin.matrix()) / areas.sum();
  if (share < 0.01) return {};
  const bool all_have_ends = layers_of(options).back().thickness_m.has_value();
  return {make_note("tissue.layers_end",
                    all_have_ends
                        ? fmt::format("the layers end {:.1f} mm under the skin; under {:.0f} % of "
                                      "it the tissue is thinner",
                                      1e3 * begins_m, 100 * share)
                        : fmt::format("the deepest layer begins {:.1f} mm under the skin; under "
                                      "{:.0f} % of the skin the tissue is thinner and has nothing "
                                      "of it",
                                      1e3 * begins_m, 100 * share),
                    options.layers.empty() ? "tissue.preset" : "")};
}

Eigen::MatrixXd layer_shares(const TissueFieldOptions& options, const VolumeMesh& volume) {
  const std::vector<double> ends_m = layer_ends(options);
  const int levels = volume.layers;
  HX_ASSERT(volume.tets.rows() == 3 * levels * volume.outer.triangles.rows());
  Eigen::MatrixXd share(volume.tets.rows(), Eigen::Index(ends_m.size()));
  for (Eigen::Index t = 0; t < share.rows(); ++t) {
    const Eigen::Index triangle = t / (3 * levels), level = t / 3 % levels;
    double thickness_m = 0;
    for (int k = 0; k < 3; ++k)
      thickness_m += volume.thickness_m[volume.outer.triangles(triangle, k)] / 3;
    const double top = thickness_m * double(level) / levels,
                 bottom = thickness_m * double(level + 1) / levels;
    double from = 0;
    for (std::size_t l = 0; l < ends_m.size(); ++l) {
      const double within = std::min(bottom, ends_m[l]) - std::max(top, from);
      share(t, Eigen::Index(l)) = std::max(0.0, within) / (bottom - top);
      from = ends_m[l];
    }
  }
  return share;
}

std::vector<double> layer_means(const Eigen::MatrixXd& share,
                                const std::vector<std::vector<double>>& of_layers) {
  HX_ASSERT(std::size_t(share.cols()) == of_layers.size());
  std::vector<double> mean(of_layers.front().size());
  for (std::size_t t = 0; t < mean.size(); ++t) {
    const auto row = share.row(Eigen::Index(t));
    Eigen::Index most = 0;
    row.maxCoeff(&most);
    const double of_most = of_layers[std::size_t(most)][t];
    mean[t] = of_most;
    for (std::size_t l = 0; l < of_layers.size(); ++l)
      mean[t] += row[Eigen::Index(l)] * (of_layers[l][t] - of_most);
  }
  return mean;
}

}  // namespace hyperex::tissue
