// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hyperex/geometry/insert_line.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// What muscles did over a motion.
struct MuscleCourse {
  std::vector<std::string> names;   ///< "zyg_major_L", ...
  std::vector<double> time_s;       ///< samples
  Eigen::MatrixXd activation;       ///< |names| x samples; 1 moves the skin by 10 mm where most
  Eigen::MatrixXd sigma;            ///< of it, 1 sigma, from the points' errors and the prior
  Eigen::VectorXd jaw_opening_deg;  ///< a sample each
  /// Sums over muscles that points on the skin can hardly tell apart, a side each: "lip corner
  /// elevators_L". Of what was found: none where gains or mirroring change it.
  std::vector<std::string> groups;
  Eigen::MatrixXd group_activation, group_sigma;  ///< |groups| x samples
};

/// A face in motion: the contract between the simulation and every output. Scan frame, metres.
struct Performance {
  /// The scan at rest: its own vertices in their order, then those of a cut along the lips; its own
  /// triangles in their order, of those that the cut crosses one piece, then the other pieces.
  TriMesh skin_rest;
  Eigen::Index scan_vertices = 0;    ///< the first so many of skin_rest.points are the scan's own
  std::vector<EdgePoint> appended;   ///< where on the scan each further vertex lies
  std::vector<int> source_triangle;  ///< of each skin triangle, the scan's that it is (a piece of)
  std::vector<double> frame_time_s;
  std::vector<PointsF> skin_displacement_m;  ///< per frame, |skin_rest| x 3
  int peak_frame = 0;                        ///< where the driven points moved most in the mean
  /// The jaw's place in each frame: a point of it that is at x at rest is at
  /// jaw_now_from_rest[f] * x.
  std::vector<Eigen::Isometry3d> jaw_now_from_rest;

  /// The simulated tissue; empty where everything was measured.
  Points nodes;
  Tetrahedra tets;
  std::vector<PointsF> node_displacement_m;                          ///< per frame
  std::vector<float> tet_young_pa, tet_poisson, tet_viscosity_pa_s;  ///< per tetrahedron
  ModelOptions model;  ///< by which strain and stress follow from the displacement

  /// Landmarks of the scan as the moved skin carries them, at the frame times.
  motion::Motion landmarks;
  /// Positions at rest of the driven points and of some held nodes, and the line of the lip cut
  /// (polyline; empty where none was made): for pictures.
  Points driven_points_rest, held_points_rest, lip_cut_rest;
  std::vector<std::string> driven_names;
  MuscleCourse muscles;  ///< no names where no muscles drive
};

}  // namespace hyperex::simulate
