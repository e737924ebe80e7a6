// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/standard_expressions.hpp"

namespace hyperex::estimate {

const std::vector<StandardExpression>& standard_expressions() {
  static const std::vector<StandardExpression> all = {
      {"smile",
       {{"zyg_major", 0.6},
        {"zyg_minor", 0.2},
        {"lev_anguli", 0.2},
        {"risorius", 0.1},
        {"malaris", 0.2}}},
      {"show upper teeth", {{"lev_lab_sup", 0.5}, {"lev_alaeque", 0.3}, {"zyg_minor", 0.3}}},
      {"show lower teeth", {{"dep_lab_inf", 0.5}, {"dep_anguli", 0.2}, {"platysma", 0.2}}},
      {"pucker", {{"incis_sup", 0.4}, {"incis_inf", 0.4}, {"oo_up_per", 0.3}, {"oo_lo_per", 0.3}}},
      {"brow raise", {{"frontal_med", 0.5}, {"frontal_lat", 0.5}}},
      {"frown", {{"corrugator", 0.5}, {"procerus", 0.3}}},
      {"eye closure", {{"orb_palpebral", 0.5}, {"orb_oculi_lo", 0.3}, {"orb_oculi_up", 0.3}}},
      {"mouth open", {}, 0.25},
  };
  return all;
}

Eigen::VectorXd activations_of(const StandardExpression& expression,
                               const std::vector<muscles::MuscleLine>& lines) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(Eigen::Index(lines.size()));
  for (std::size_t m = 0; m < lines.size(); ++m)
    for (const auto& [muscle, activation] : expression.activations)
      if (lines[m].name.substr(0, lines[m].name.size() - 2) == muscle)
        out[Eigen::Index(m)] = activation;
  return out;
}

}  // namespace hyperex::estimate
