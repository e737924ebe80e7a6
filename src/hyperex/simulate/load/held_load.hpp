// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/time/drive.hpp"
#include "hyperex/simulate/load/nodal_course.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// Forces that move a face as it was recorded, found once in its own tissue and then held: other
/// tissue or weaker muscles answer the same forces otherwise.
struct HeldLoad {
  std::vector<double> time_s;  ///< of the samples, from the start of the motion, rising
  Eigen::MatrixXd force;       ///< 3 |nodes| x k, N
  Eigen::MatrixXd course;      ///< k x samples: the force at sample i is force * course.col(i)
  /// Of the first columns: of each muscle its narrow band, then, where there are `wide_bands`, of
  /// each its wide one.
  bool wide_bands = false;
  MuscleCourse muscles;  ///< no names where there are none
  double greatest_opening_deg = 0;
  /// The nodes of the patches around driven points. Where strain is finite, what holds them where
  /// these forces put them at small strain is found by the run that first needs it, and is a part
  /// of the load from then on.
  std::vector<int> patch_nodes;
  std::shared_ptr<const NodalCourse> patch_forces;
};

/// Per muscle: the product of the gains that name it, its branch on its side, or its side. Throws
/// InputError for a name that is none of these, listing those that are.
Eigen::VectorXd muscle_gains(const std::vector<std::string>& muscles,
                             const std::vector<MuscleGain>& gains,
                             const muscles::MuscleTable& table = muscles::muscle_template());

/// The activations after mirroring and gains.
MuscleCourse changed_muscles(const MuscleCourse& muscles, const MuscleOptions& options);

/// Sums of activations over groups as MuscleCourse::groups names them: |groups| x samples.
Eigen::MatrixXd group_sums(const MuscleCourse& muscles, const std::vector<std::string>& groups,
                           const muscles::MuscleTable& table);

/// Rows of the course at any times: between samples by the C2 cubic spline, before the first and
/// after the last as there.
Eigen::MatrixXd course_at(const HeldLoad& load, Eigen::Index first_row, Eigen::Index rows,
                          const std::vector<double>& times_s);

/// Where in HeldLoad::course the jaw's motion stands: twelve rows, a Boundary::JawMotion's turn
/// column by column, then its slide. Of a load of muscles.
Eigen::Index jaw_row(const HeldLoad& load);

/// Of the load at an instant, with mirroring and gains: 3 |nodes|, N. Between samples by the C2
/// cubic spline, before the first and after the last as there.
Eigen::VectorXd force_at(const HeldLoad& load, const MuscleOptions& options, double time_s);

/// The load over a run as few shapes, in the form of compressed_drive(); between samples by the C2
/// cubic spline, after the last it is held. Nothing prescribed moves.
fem::Drive drive_of(const HeldLoad& load, const MuscleOptions& options, double dt_s, int steps,
                    double tolerance, Eigen::Index prescribed);

/// What gains of 1 + `change` (one a muscle) add to the load as it was recorded: no names, and the
/// columns of the muscles whose gain changes, their course times the change.
HeldLoad added_by_gains(const HeldLoad& load, const Eigen::VectorXd& change);

/// Of each column: whether its force turns with the tissue where strain is finite. Those of muscles
/// of the cheek (TemplateMuscle::cheek) do, whose lines lie in the skin that they carry; those of
/// the jaw's springs, of what is left over and of muscles of lips and chin keep their direction
/// (docs/mechanics.md).
std::vector<char> turning_columns(const HeldLoad& load, const muscles::MuscleTable& table);

/// The load with nothing but some of its columns.
HeldLoad with_columns(const HeldLoad& load, const std::vector<char>& wanted);

/// Moving what is prescribed by `drive` makes the same motion, at rest in each instant, as these
/// forces on the same stiffness with nothing of it prescribed that moves: K u for the static answer
/// u to each shape. `stiffness`: with springs; `prescribed`: what the drive prescribes.
HeldLoad reactions_of(const fem::Drive& drive, const fem::SparseMatrix& stiffness,
                      const std::vector<int>& prescribed, double dt_s);

}  // namespace hyperex::simulate
