// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/muscle_load.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/least_risk_filter.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/simulate/drive/input_shapes.hpp"
#include "hyperex/simulate/drive/skin_places.hpp"
#include "hyperex/simulate/load/face_parts.hpp"
#include "hyperex/simulate/load/fitted_course.hpp"
#include "hyperex/simulate/load/holding_forces.hpp"
#include "hyperex/simulate/load/left_over.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"
#include "hyperex/simulate/load/muscle_model.hpp"
#include "hyperex/simulate/load/muscle_prior.hpp"
#include "hyperex/simulate/load/shape_correction.hpp"

namespace hyperex::simulate {
namespace {

/// Clear of the nostrils.
constexpr double kBelowNose_m = 3e-3;

/// The points that drive.
struct Driven {
  std::vector<int> rows;
  std::vector<DrivenPoint> points;
  CarrierMatrix carrier;

  Driven(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
         const AlignedMotion& motion, const DriveOptions& drive) {
    std::vector<std::string> names;
    for (const std::string& name : drive.names_in(motion.motion))
      if (const int row = motion.motion.index_of(name);
          row >= 0 && !std::count(rows.begin(), rows.end(), row)) {
        rows.push_back(row);
        names.push_back(name);
      }
    Points rest(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rest.row(static_cast<Eigen::Index>(i)) = motion.rest.row(rows[i]);
      points.push_back({names[i], motion.rest.row(rows[i]).transpose()});
    }
    carrier = carriers(mesh, skin_places(mesh, names, rest));
    few_ = few_points(rest, landmarks);
  }
  bool few() const { return few_; }
  Eigen::VectorXd of(const Points& all) const {
    Eigen::VectorXd out(3 * static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      out.segment<3>(3 * static_cast<Eigen::Index>(i)) = all.row(rows[i]).transpose();
    return out;
  }

 private:
  bool few_ = true;
};

/// Displacements of the driven points at the first samples: 3 P x `samples`, m.
Eigen::MatrixXd displacements_of(const Driven& driven, const motion::Motion& motion, double gain,
                                 Eigen::Index samples) {
  Eigen::MatrixXd out(3 * Eigen::Index(driven.rows.size()), samples);
  for (Eigen::Index k = 0; k < out.cols(); ++k)
    out.col(k) = driven.of(gain * (motion.positions[std::size_t(k)] - motion.positions.front()));
  return out;
}

/// Displacements of the driven points: 3 P x samples, m.
struct PointCourses {
  Eigen::MatrixXd recorded;
  Eigen::MatrixXd steady;  ///< without the white noise of the recording; muscles follow these
};

PointCourses courses_of(const Driven& driven, const motion::Motion& motion, double gain,
                        Eigen::Index samples) {
  constexpr Eigen::Index beyond = 200;  // so that the filter does not end with the samples
  const auto count = std::min(samples + beyond, Eigen::Index(motion.positions.size()));
  const Eigen::MatrixXd all = displacements_of(driven, motion, gain, count);
  const Eigen::MatrixXd smooth =
      motion::least_risk_filtered({motion.time_s.begin(), motion.time_s.begin() + count}, all,
                                  gain * motion::jitter_of_motion(motion, driven.rows));
  PointCourses out{all.leftCols(samples), smooth.leftCols(samples)};
  out.steady.col(0).setZero();  // the face at rest; the filter knows one side of it alone
  return out;
}

MuscleFit fit_of(const MuscleModel& model, const JawKinematics& jaw, const Driven& driven,
                 const MuscleOptions& options) {
  const double sigma = driven.few() ? options.few_sigma_m : options.many_sigma_m;
  std::vector<char> tone, ring;
  for (const muscles::MuscleLine& line : model.lines()) {
    const muscles::TemplateMuscle& muscle = options.table()[std::size_t(line.row)];
    tone.push_back(muscle.tone);
    ring.push_back(muscle.kind == muscles::MuscleKind::ring);
  }
  return MuscleFit(
      {at_places(driven.carrier, model.response()), at_places(driven.carrier, model.jaw_response()),
       at_places(driven.carrier, model.wide_response()), options.half},
      jaw, muscle_prior(model.lines(), options), sigma, std::move(tone), std::move(ring));
}

/// What the activations make the narrow and, where there are any, the wide bands pull.
Eigen::VectorXd in_bands(const Eigen::VectorXd& activation, const MuscleFit& fit, bool wide_bands) {
  if (!wide_bands) return activation;
  const Eigen::VectorXd wide =
      activation.unaryExpr([&](double a) { return fit.wide_share(a) * a; });
  Eigen::VectorXd out(2 * activation.size());
  out << activation - wide, wide;
  return out;
}

/// Displacements of the patches' nodes (3 |patch nodes| x n) as the field between the driven points
/// has them where these are displaced by the columns of `of_points` (3 P).
Eigen::MatrixXd field_in_patches(const DrivenSkin& patches, const Driven& driven,
                                 const Eigen::MatrixXd& of_points, Eigen::Index points) {
  Eigen::MatrixXd out(3 * Eigen::Index(patches.nodes.size()), of_points.cols());
  for (Eigen::Index c = 0; c < of_points.cols(); ++c) {
    Points all = Points::Zero(points, 3);
    for (std::size_t i = 0; i < driven.rows.size(); ++i)
      all.row(driven.rows[i]) = of_points.col(c).segment<3>(3 * Eigen::Index(i)).transpose();
    const Points patch = patches.weights * all;
    out.col(c) = Eigen::Map<const Eigen::VectorXd>(patch.data(), patch.size());
  }
  return out;
}

/// The displacement of the patches by the field between the driven points, minus that by the nodal
/// displacements `nodal` (3 |nodes| x n). The driven points are displaced according to `nodal`.
Eigen::MatrixXd field_less_tissue(const DrivenSkin& patches, const Driven& driven,
                                  const Eigen::MatrixXd& nodal, Eigen::Index points) {
  Eigen::MatrixXd out = field_in_patches(patches, driven, at_places(driven.carrier, nodal), points);
  for (std::size_t j = 0; j < patches.nodes.size(); ++j)
    out.middleRows<3>(3 * Eigen::Index(j)) -= nodal.middleRows<3>(3 * patches.nodes[j]);
  return out;
}

/// The forces of muscles and jaw, then of the left-over's directions: columns of a HeldLoad. In the
/// patches a column's displacement is `tissue_share` of that under its own forces, plus the rest of
/// the field interpolated between the points. For the left-over it is that field alone. Where
/// patches fade, the nodes are held to it less and less firmly.
HeldShape forces_of(const MuscleModel& model, const DrivenSkin& patches, const Driven& driven,
                    const Eigen::MatrixXd& left_over, const Eigen::VectorXd& tissue_share,
                    Eigen::Index points, const std::function<void()>& between) {
  const Eigen::Index rows = model.force().rows();
  const Eigen::Index columns =
      model.force().cols() + model.wide_force().cols() + model.jaw_force().cols();
  Eigen::MatrixXd own(rows, columns), moved(rows, columns);
  own << model.force(), model.wide_force(), model.jaw_force();
  moved << model.response(), model.wide_response(), model.jaw_response();
  Eigen::MatrixXd displaced(3 * Eigen::Index(patches.nodes.size()), own.cols() + left_over.cols());
  displaced << field_less_tissue(patches, driven, moved, points) *
                   (1 - tissue_share.array()).matrix().asDiagonal(),
      field_in_patches(patches, driven, left_over, points);
  HeldShape out = holding_forces(model, patches.nodes, patches.hold, displaced, between);
  out.force.leftCols(own.cols()) += own;
  out.moved.leftCols(own.cols()) += moved.topRows(out.moved.rows());
  return out;
}

/// The tissue's share for each column of forces_of() except those of the residual: narrow bands,
/// wide bands, jaw.
Eigen::VectorXd tissue_shares(const MuscleModel& model, bool few, const MuscleOptions& options) {
  const auto count = static_cast<Eigen::Index>(model.lines().size());
  Eigen::VectorXd of_muscle(count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const muscles::TemplateMuscle& muscle =
        options.table()[std::size_t(model.lines()[std::size_t(m)].row)];
    const double own = few ? muscle.few_share : muscle.many_share;
    of_muscle[m] = own >= 0       ? own
                   : !few         ? options.many_muscle_share
                   : muscle.cheek ? options.few_cheek_share
                                  : options.few_lip_share;
  }
  Eigen::VectorXd out(count + model.wide_force().cols() + model.jaw_force().cols());
  out << of_muscle, of_muscle.head(model.wide_force().cols()),
      Eigen::VectorXd::Constant(model.jaw_force().cols(), options.jaw_share);
  return out;
}

/// Both lists (rising) as one.
std::vector<int> united(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> out;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

/// The rows of `nodal` (3 |all nodes| x n) at these nodes.
Eigen::MatrixXd at_nodes(const std::vector<int>& nodes, const Eigen::MatrixXd& nodal) {
  Eigen::MatrixXd out(3 * Eigen::Index(nodes.size()), nodal.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    out.middleRows<3>(3 * Eigen::Index(i)) = nodal.middleRows<3>(3 * nodes[i]);
  return out;
}

/// Places that the residual displacement does not move: beside the ears, the root of the nose and
/// the middles of the brows, without those near a driven point.
std::vector<Vec3> unmoved_places(const std::vector<DrivenPoint>& points,
                                 const io::Landmarks& landmarks) {
  constexpr double near_m = 0.015;
  std::vector<Vec3> places;
  for (const int k : {0, 16, 27, 19, 24}) {
    const auto it = landmarks.find(face::ibug(k));
    if (it == landmarks.end()) continue;
    if (std::none_of(points.begin(), points.end(), [&](const DrivenPoint& point) {
          return (point.rest - it->second).norm() < near_m;
        }))
      places.push_back(it->second);
  }
  return places;
}

/// Outer nodes that carry the driven points, rising: there the skin ends where the points are
/// driven.
std::vector<int> carrying(const CarrierMatrix& carrier) {
  std::set<int> nodes;
  for (Eigen::Index i = 0; i < carrier.rows(); ++i)
    for (CarrierMatrix::InnerIterator it(carrier, i); it; ++it) nodes.insert(int(it.col()));
  return {nodes.begin(), nodes.end()};
}

DrivenSkin patches_of(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                      const AlignedMotion& motion, const MeasuredRegion& region,
                      const SimulationOptions& options, bool few) {
  DriveOptions drive = options.drive;
  if (!few) drive.patch_radius_m = options.muscles.many_patch_m;
  return driven_skin(mesh, landmarks, motion, region, drive, ChinPatches::fading);
}

/// The nodes that are held exactly.
std::vector<int> wholly_held(const DrivenSkin& patches) {
  std::vector<int> nodes;
  for (std::size_t j = 0; j < patches.nodes.size(); ++j)
    if (patches.hold[Eigen::Index(j)] == 1) nodes.push_back(patches.nodes[j]);
  return nodes;
}

/// Adds forces that correct the displacement of the skin between the points, `skin`, towards that
/// of shapes of real faces, divided among the `parts` of the face.
void add_shapes(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                const AlignedMotion& motion, const SimulationOptions& options,
                const MuscleModel& model, const Driven& driven, const LoadedSkin& skin,
                const FaceParts& parts, const std::function<void()>& between, HeldLoad& load) {
  const Vec3 up = face::face_frame(landmarks).y;
  const DriveField field(driven.points, unmoved_places(driven.points, landmarks), mesh, up,
                         lip_parting(motion, driven.rows, up));
  const CarriedShapes shapes(mesh.volume.outer.points, mesh.upper_margin, landmarks, driven.points,
                             options.muscles.shape_sigma_m);
  if (between) between();
  const SkinCorrection correction = shape_correction(
      mesh, shapes, field, skin,
      with_nodes(model.boundary().prescribed(), carrying(driven.carrier)), options.muscles);
  if (between) between();
  if (correction.course.rows() == 0) return;
  const std::vector<int> nodes = united(correction.nodes, load.patch_nodes);
  const Eigen::MatrixXd shares = parts.shares(at_nodes(correction.nodes, model.response()));
  const Eigen::Index directions = correction.displaced.cols();
  Eigen::MatrixXd displaced =
      Eigen::MatrixXd::Zero(3 * Eigen::Index(nodes.size()), directions * shares.cols());
  for (std::size_t i = 0, from = 0; i < nodes.size() && from < correction.nodes.size(); ++i) {
    if (nodes[i] != correction.nodes[from]) continue;
    for (Eigen::Index part = 0; part < shares.cols(); ++part)
      displaced.block(3 * Eigen::Index(i), part * directions, 3, directions) =
          shares(Eigen::Index(from), part) *
          correction.displaced.middleRows<3>(3 * Eigen::Index(from));
    ++from;
  }
  const HeldShape held = holding_forces(model, nodes, exactly(nodes), displaced, between);
  const Eigen::Index own = load.force.cols();
  load.force.conservativeResize(Eigen::NoChange, own + held.force.cols());
  load.force.rightCols(held.force.cols()) = held.force;
  load.course.conservativeResize(own + held.force.cols(), Eigen::NoChange);
  load.course.bottomRows(held.force.cols()) = correction.course.replicate(shares.cols(), 1);
  for (Eigen::Index part = 0; part < shares.cols(); ++part)
    load.parts.insert(load.parts.end(), std::size_t(directions), part);
}

}  // namespace

bool few_points(const Points& rest, const io::Landmarks& landmarks) {
  const Vec3 nose = landmarks.at(face::ibug(33)), up = face::face_frame(landmarks).y;
  return (((rest.rowwise() - nose.transpose()) * up).array() < -kBelowNose_m).count() <= kFewPoints;
}

Eigen::Index samples_of_run(const std::vector<double>& time_s, const TimeOptions& time) {
  // The influence of a sample on a spline's slope falls by a factor of 0.27 per sample of distance.
  constexpr Eigen::Index of_the_curve = 16;
  const auto all = Eigen::Index(time_s.size());
  if (time.end_s <= 0) return all;
  // The last step may end after end_s; drive_of() reads kBeyond more.
  const double end_s = time_s.front() + time.end_s + (kBeyond + 1) * time.step_s;
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), end_s);
  return std::min(all, Eigen::Index(after - time_s.begin()) + of_the_curve);
}

HeldLoad muscle_load(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                     const AlignedMotion& motion, const MeasuredRegion& region,
                     const SimulationOptions& options, const MuscleModel& model,
                     const std::function<void()>& between) {
  // First, since its errors name faults of the points.
  const Driven driven(mesh, landmarks, motion, options.drive);
  const DrivenSkin patches = patches_of(mesh, landmarks, motion, region, options, driven.few());
  const JawKinematics jaw(landmarks, mesh.bones.get());
  MuscleFit fit = fit_of(model, jaw, driven, options.muscles);

  HeldLoad load;
  load.smooth_up_to_s = motion.motion.smooth_up_to_s;
  const auto count = static_cast<Eigen::Index>(model.lines().size());
  const Eigen::Index samples = samples_of_run(motion.motion.time_s, options.time);
  if (samples < Eigen::Index(motion.motion.time_s.size())) load.until_s = options.time.end_s;
  load.wide_bands = model.wide_force().cols() > 0;
  MuscleCourse& muscle = load.muscles;
  muscle.few_points = driven.few();
  for (const muscles::MuscleLine& line : model.lines()) muscle.names.push_back(line.name);
  const Eigen::Index of_jaw = jaw_row(load);
  const Eigen::MatrixXd members =
      name_groups(model.lines(), options.muscles.table(), muscle.groups);
  resize(muscle, count, members.rows(), samples);
  Eigen::MatrixXd course = Eigen::MatrixXd::Zero(of_jaw + 12, samples);
  Eigen::MatrixXd left_over(3 * Eigen::Index(driven.rows.size()), samples);
  const auto [seen, steady] = courses_of(driven, motion.motion, options.drive.gain, samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    if (between) between();
    load.time_s.push_back(motion.motion.time_s[std::size_t(k)] - motion.motion.time_s.front());
    const FitResult fitted = fit.fit(steady.col(k));
    store_sample(fitted, members, k, muscle);
    muscle.jaw_opening_deg[k] = fitted.jaw[0] * 180 / std::numbers::pi;
    course.col(k) << in_bands(fitted.activation, fit, load.wide_bands), jaw.motion(fitted.jaw);
    left_over.col(k) = fitted.left_over + seen.col(k) - steady.col(k);
  }
  muscle.time_s = load.time_s;
  const FaceParts parts(model.lines(), options.muscles.table(), muscle.prior_sigma.col(0));
  const Eigen::MatrixXd of_points = at_places(driven.carrier, model.response());
  load.part_makers = parts.makers(of_points);
  const LeftOver rest = divided(left_over, parts.shares(of_points));
  load.parts = rest.parts;
  load.course.resize(course.rows() + rest.course.rows(), samples);
  load.course << course, rest.course;
  HeldShape held =
      forces_of(model, patches, driven, rest.directions,
                tissue_shares(model, driven.few(), options.muscles), motion.rest.rows(), between);
  load.force = std::move(held.force);
  load.patch_nodes = wholly_held(patches);
  load.patch_shares = parts.shares(at_nodes(load.patch_nodes, model.response()));
  if (options.muscles.shape_prior)
    add_shapes(mesh, landmarks, motion, options, model, driven,
               {std::move(held.moved), load.course, seen}, parts, between, load);
  return load;
}

}  // namespace hyperex::simulate
