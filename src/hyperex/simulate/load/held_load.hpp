// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/fem/time/drive.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/load/nodal_course.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::simulate {

/// Forces that move a face as it was recorded. They are found once, in the face's own tissue, and
/// can then be held to see how other tissue or weaker muscles respond to them.
struct HeldLoad {
  std::vector<double> time_s;  ///< of the samples, from the start of the motion, rising
  /// As Motion::smooth_up_to_s, for the rows of `course`.
  double smooth_up_to_s = motion::Motion::kSmoothUpTo_s;
  Eigen::MatrixXd force;   ///< 3 |nodes| x k, N
  Eigen::MatrixXd course;  ///< k x samples: the force at sample i is force * course.col(i)
  /// The first columns of `force` hold one narrow band per muscle, then (if `wide_bands`) one wide
  /// band per muscle.
  bool wide_bands = false;
  MuscleCourse muscles;  ///< no names where there are none
  /// Each column after those of muscles and jaw holds unexplained motion of a part of the face
  /// (FaceParts). It fades, or grows, as far as all muscles do that may make that part's motion
  /// (common_change()). Parts without such muscles, and all where these are empty, stay as they
  /// are.
  std::vector<Eigen::Index> parts;            ///< of these columns
  std::vector<std::vector<int>> part_makers;  ///< of each part, such muscles
  /// Where muscles drive and the motion goes on after the run: the end of the run, s.
  double until_s = std::numeric_limits<double>::infinity();
  double greatest_opening_deg = 0;  ///< of the jaw, by the points; muscles have their own course
  /// The nodes of the patches around driven points. At finite strain, additional forces hold them
  /// where the load puts them at small strain. The run that first needs these forces finds them.
  std::vector<int> patch_nodes;
  std::shared_ptr<const NodalCourse> patch_forces;
  /// Of each of these nodes the share that each part of the face has in it: the additional forces
  /// follow the gains as columns do.
  Eigen::MatrixXd patch_shares;
};

/// One factor per muscle: the product of the gains that name it, its branch on its side, or its
/// side. Throws InputError for any other name, with a list of the names.
Eigen::VectorXd muscle_gains(const std::vector<std::string>& muscles,
                             const std::vector<MuscleGain>& gains,
                             const muscles::MuscleTable& table = muscles::muscle_template());

/// What the changes (one per muscle) of these muscles have in common: that of the smallest size
/// where all have the same sign, else 0. 0 for no muscle.
double common_change(const Eigen::VectorXd& change, const std::vector<int>& muscles);

/// The samples up to `end_s` (> 0, from the start of the motion). Where none is at `end_s` and the
/// course goes on, a last one is interpolated there, linearly.
MuscleCourse muscles_until(MuscleCourse muscles, double end_s);

/// The jaw's greatest opening in a run up to `end_s`, deg.
double greatest_opening_deg(const HeldLoad& load, double end_s);

/// The activations after mirroring and gains.
MuscleCourse changed_muscles(const MuscleCourse& muscles, const MuscleOptions& options);

/// The text of a note on gains that change only muscles which the recording uses by less than their
/// uncertainty (1 sigma): which of these muscles acts most, and how much. It speaks of a gain on
/// that muscle's whole branch where some muscle of the branch keeps its strength. Empty where a
/// gain changes another muscle, or none changes anything.
std::string hardly_used_text(const MuscleCourse& recorded, const MuscleOptions& options);

/// Sums of activations over the groups that are named as in MuscleCourse::groups: |groups| x
/// samples.
Eigen::MatrixXd group_sums(const MuscleCourse& muscles, const std::vector<std::string>& groups,
                           const muscles::MuscleTable& table);

/// Rows of the course at any times, by cubics through the samples (motion::bounded_slopes). Before
/// the first and after the last sample they are constant.
Eigen::MatrixXd course_at(const HeldLoad& load, Eigen::Index first_row, Eigen::Index rows,
                          const std::vector<double>& times_s);

/// For a load by muscles: index of the first of twelve rows of HeldLoad::course that contain the
/// jaw's motion, namely the turn of Boundary::JawMotion (column by column) and then its slide.
Eigen::Index jaw_row(const HeldLoad& load);

/// The forces of the load at one instant (3 |nodes|, N), with mirroring and gains, in time as
/// course_at().
Eigen::VectorXd force_at(const HeldLoad& load, const MuscleOptions& options, double time_s);

/// The additional forces of finite strain, with gains; null where there are none.
std::shared_ptr<const NodalCourse> patch_forces_with(const HeldLoad& load,
                                                     const MuscleOptions& options);

/// The load over a run as few shapes (compressed_drive), in time as course_at(). Nothing that is
/// prescribed moves.
fem::Drive drive_of(const HeldLoad& load, const MuscleOptions& options, double dt_s, int steps,
                    double tolerance, Eigen::Index prescribed);

/// The load that gains of 1 + `change` (one number per muscle) add to the load as recorded: the
/// columns of the muscles whose gain changes, with their course times the change, and those that
/// follow them. Without names.
HeldLoad added_by_gains(const HeldLoad& load, const Eigen::VectorXd& change);

/// One flag per column: whether its force turns with the tissue at finite strain. Forces of muscles
/// of the cheek (TemplateMuscle::cheek) turn, since their lines lie in the skin that they carry.
/// All others keep their direction: those of lips and chin, of the jaw's springs, and the residual
/// forces (docs/mechanics.md).
std::vector<char> turning_columns(const HeldLoad& load, const muscles::MuscleTable& table);

/// The load with the course of all columns but the wanted ones set to zero.
HeldLoad with_columns(const HeldLoad& load, const std::vector<char>& wanted);

/// The forces that make the same motion as the prescribed displacements of `drive`, in static
/// equilibrium at each instant: K u for the static solution u of each shape. `stiffness`: K with
/// springs; `prescribed`: the unknowns that the drive prescribes.
HeldLoad reactions_of(const fem::Drive& drive, const fem::SparseMatrix& stiffness,
                      const std::vector<int>& prescribed, double dt_s);

}  // namespace hyperex::simulate
