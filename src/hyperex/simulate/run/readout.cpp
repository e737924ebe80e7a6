// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/readout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/contact/rim_places.hpp"
#include "hyperex/simulate/drive/lid_skin.hpp"

namespace hyperex::simulate {
namespace {

std::vector<std::string> names_of(const io::Landmarks& landmarks) {
  std::vector<std::string> names;
  for (const auto& entry : landmarks) names.push_back(entry.first);
  return names;
}

Points places_of(const io::Landmarks& landmarks) {
  Points places(landmarks.size(), 3);
  Eigen::Index i = 0;
  for (const auto& entry : landmarks) places.row(i++) = entry.second.transpose();
  return places;
}

}  // namespace

Readout::Readout(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks)
    : mesh_(mesh),
      names_(names_of(landmarks)),
      rest_(places_of(landmarks)),
      places_(skin_places(mesh, names_, rest_)),
      surfaces_(std::make_shared<const LipSurfaces>(mesh, landmarks)) {}

PointsF in_single_precision(const Points& points) {
  return points.unaryExpr([](double x) {
    return std::abs(x) < std::numeric_limits<float>::min() ? 0.0F : static_cast<float>(x);
  });
}

PointsF Readout::skin(const MeasuredRegion& region, const std::vector<tissue::RimVertex>& rim,
                      const Points& nodes, const Points& points) const {
  Points out(mesh_.skin.points.rows(), 3);
  auto on_rim = rim.begin();
  for (Eigen::Index v = 0; v < out.rows(); ++v) {
    const double share = region.share[v];
    Vec3 d = Vec3::Zero();
    if (share < 1) {
      if (on_rim != rim.end() && on_rim->vertex == v) {
        for (std::size_t k = 0; k < on_rim->node.size(); ++k)
          d += on_rim->weight[k] * nodes.row(on_rim->node[k]).transpose();
      } else {
        const tissue::Anchor& anchor = mesh_.anchors[v];
        for (int k = 0; k < 3; ++k) d += anchor.weight[k] * nodes.row(anchor.node[k]).transpose();
      }
    }
    if (on_rim != rim.end() && on_rim->vertex == v) ++on_rim;
    if (share > 0) d = (1 - share) * d + share * region.skin[v].displacement(points);
    out.row(v) = d.transpose();
  }
  return in_single_precision(out);
}

motion::Motion Readout::landmark_tracks(const std::vector<double>& time_s,
                                        const std::vector<PointsF>& frames) const {
  motion::Motion tracks;
  tracks.time_s = time_s;
  tracks.names = names_;
  for (const PointsF& frame : frames) {
    Points at = rest_;
    for (std::size_t m = 0; m < places_.size(); ++m)
      for (int k = 0; k < 3; ++k)
        at.row(m) += places_[m].weight[k] * frame.row(places_[m].point[k]).cast<double>();
    tracks.positions.push_back(at);
  }
  return tracks;
}

Readout::Lips Readout::lips(const motion::Motion& tracks, const std::vector<PointsF>& frames,
                            const EachFrame& each) const {
  const int upper = tracks.index_of(face::ibug(62)), lower = tracks.index_of(face::ibug(66));
  const auto gap = [&](const Points& at) { return 1e3 * (at.row(upper) - at.row(lower)).norm(); };
  std::vector<double> depth_mm(frames.size());
  each(frames.size(), [&](std::size_t f) { depth_mm[f] = 1e3 * surfaces_->depth(frames[f]); });
  Lips most;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (depth_mm[f] > most.overlap_mm) {
      most.overlap_mm = depth_mm[f];
      most.overlap_frame = int(f);
    }
    most.gap_mm = std::max(most.gap_mm, gap(tracks.positions[f]) - gap(tracks.positions.front()));
  }
  return most;
}

DrivenPoints::DrivenPoints(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                           const AlignedMotion& motion, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted)
    if (const int row = motion.motion.index_of(name); row >= 0) {
      rows.push_back(row);
      names.push_back(name);
    }
  rest = motion.rest(rows, Eigen::all);
  places = skin_places(mesh, names, rest);
  rim = share_lid_apertures(mesh, landmarks, names, places, rim_through(mesh, places));
}

std::vector<double> DrivenPoints::off_m(const Performance& performance,
                                        const PointCurve& wanted) const {
  std::vector<double> off_m(rows.size(), 0);
  for (std::size_t f = 0; f < performance.frame_time_s.size(); ++f) {
    const Points there = wanted.at(performance.frame_time_s[f]);
    const PointsF& skin = performance.skin_displacement_m[f];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 moved = places[i].displacement(skin);
      off_m[i] = std::max(off_m[i], (moved - there.row(rows[i]).transpose()).norm());
    }
  }
  return off_m;
}

int peak_frame(const std::vector<double>& time_s, double peak_time_s, const std::vector<int>& rows,
               const PointCurve& points) {
  int best = 0;
  double most = -1;
  for (std::size_t f = 0; f < time_s.size(); ++f) {
    double score = 0;
    if (peak_time_s >= 0) {
      score = 1 / (1 + std::abs(time_s[f] - peak_time_s));
    } else {
      const Points d = points.at(time_s[f]);
      for (const int row : rows) score += d.row(row).norm();
    }
    if (score > most + 1e-12) {
      most = score;
      best = static_cast<int>(f);
    }
  }
  return best;
}

}  // namespace hyperex::simulate
