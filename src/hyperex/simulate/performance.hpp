// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hyperex/expression/gaze.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/geometry/insert_line.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// Activations of muscles over a motion.
struct MuscleCourse {
  std::vector<std::string> names;  ///< "zyg_major_L", ...
  std::vector<double> time_s;      ///< samples
  Eigen::MatrixXd activation;      ///< |names| x samples; 1 moves some skin by 10 mm
  Eigen::MatrixXd sigma;           ///< 1 sigma of it, from the points' errors and the prior
  /// The same before a point is seen, in the sample's opening of the jaw; no rows: not known.
  Eigen::MatrixXd prior_sigma;
  Eigen::VectorXd jaw_opening_deg;  ///< per sample
  /// Sums over the muscles of one side that points on the skin can hardly distinguish, "lip corner
  /// elevators_L". None where gains or mirroring change the activations.
  std::vector<std::string> groups;
  Eigen::MatrixXd group_activation, group_sigma, group_prior_sigma;  ///< |groups| x samples
  /// Whether the fit took its points for few (few_points()), so that the prior decides most.
  bool few_points = true;
};

/// A face in motion: what a simulation gives to every output. Scan frame, metres.
struct Performance {
  /// The scan at rest. Its own vertices come first, in their order, then those of a cut along the
  /// lips. Its own triangles come first, in their order; where the cut crosses one, one piece
  /// stands in its place and the others follow at the end.
  TriMesh skin_rest;
  Eigen::Index scan_vertices = 0;    ///< number of the scan's own vertices in skin_rest
  std::vector<EdgePoint> appended;   ///< places of the other vertices on the scan
  std::vector<int> source_triangle;  ///< per skin triangle: the scan's triangle that it is part of
  std::vector<double> frame_time_s;
  std::vector<PointsF> skin_displacement_m;  ///< per frame, |skin_rest| x 3
  /// Where surgery moved bones or added volume: displacement of the skin at rest afterwards
  /// (|skin_rest| x 3); all displacements contain it. Otherwise no rows.
  PointsF neutral_displacement_m;
  /// Where surgery put the upper teeth; jaw_now_from_rest has the lower ones.
  Eigen::Isometry3d upper_teeth_now_from_rest = Eigen::Isometry3d::Identity();
  int peak_frame = 0;  ///< frame with the greatest mean displacement of the driven points
  /// The jaw's pose in each frame: its point x at rest is at jaw_now_from_rest[f] * x.
  std::vector<Eigen::Isometry3d> jaw_now_from_rest;
  /// How the eyes turn in each frame; empty where the recording has no gaze. The session adds it,
  /// as a simulator does not know it. No figure depends on it.
  std::vector<expression::EyesGaze> gaze;

  /// The simulated tissue; empty where everything was measured.
  Points nodes;
  Tetrahedra tets;
  std::vector<PointsF> node_displacement_m;  ///< per frame, |nodes| x 3
  fem::Material material;                    ///< one value per tetrahedron
  ModelOptions model;                        ///< gives strain and stress from the displacement
  /// Growth tensor of each tetrahedron (fem::Assembler::grown), where volume was added; else empty.
  std::vector<Eigen::Matrix3d> growth;

  /// Landmarks of the scan, which move with the skin, at the frame times.
  motion::Motion landmarks;
  /// Positions at rest of the driven points and of some held nodes, and the line of the lip cut
  /// (polyline; empty where none was made): for pictures.
  Points driven_points_rest, held_points_rest, lip_cut_rest;
  std::vector<std::string> driven_names;
  MuscleCourse muscles;  ///< no names where no muscles drive
};

}  // namespace hyperex::simulate
