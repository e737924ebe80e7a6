// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/thickness.hpp"

#include <cmath>
#include <stdexcept>

#include "hyperex/face/ibug.hpp"

namespace hyperex::tissue {

const std::vector<DepthAt>& published_depths() {
  static const std::vector<DepthAt> table = [] {
    const std::pair<int, double> at_ibug[] = {
        {0, 6},   {16, 6},                                       // zygion
        {2, 10},  {14, 10},                                      // mid ramus, masseter aside
        {4, 10},  {12, 10},                                      // gonion
        {6, 10},  {10, 10},                                      // mid mandibular border
        {8, 9},                                                  // gnathion
        {17, 6},  {19, 6},  {21, 6}, {22, 6}, {24, 6}, {26, 6},  // supraorbital
        {27, 6},                                                 // nasion
        {28, 4},  {29, 3},  {30, 4},  // nasal bones, tip (skin over cartilage)
        {31, 8},  {35, 8},            // alar curvature
        {33, 12},                     // subnasale
        {36, 6},  {45, 6},            // lateral orbit
        {37, 4},  {41, 4},  {38, 4}, {40, 4}, {43, 4}, {44, 4}, {46, 4}, {47, 4},  // lids
        {48, 10}, {54, 10},  // supra- and infracanine
        {51, 11}, {57, 12},  // labrale superius and inferius
    };
    std::vector<DepthAt> list;
    for (const auto& [k, mm] : at_ibug) list.push_back({face::ibug(k), mm * 1e-3});
    list.push_back({"cheek_L", 12e-3});
    list.push_back({"cheek_R", 12e-3});
    list.push_back({"glabella", 6e-3});
    return list;
  }();
  return table;
}

Eigen::VectorXd depth_field(const Points& points, const std::vector<DepthAt>& depths,
                            const io::Landmarks& landmarks) {
  Points at(depths.size(), 3);
  Eigen::VectorXd depth(depths.size());
  Eigen::Index known = 0;
  for (const DepthAt& d : depths)
    if (const auto it = landmarks.find(d.landmark); it != landmarks.end()) {
      at.row(known) = it->second.transpose();
      depth[known++] = d.depth_m;
    }
  if (known == 0) throw std::invalid_argument("no depth is given at a known landmark");
  Eigen::VectorXd field(points.rows());
  constexpr double soft2 = 4e-6;  // (2 mm)^2: flat around a landmark, no pole
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Eigen::VectorXd w =
        ((at.topRows(known).rowwise() - points.row(v)).rowwise().squaredNorm().array() + soft2)
            .inverse();
    field[v] = w.dot(depth.head(known)) / w.sum();
  }
  return field;
}

}  // namespace hyperex::tissue
