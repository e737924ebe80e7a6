// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/uncertainty/face_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/metrics/excursion_budget.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/uncertainty/perturbed_face.hpp"

namespace hyperex::uncertainty {
namespace {

using metrics::ErrorPart;
using metrics::Excursions;
using metrics::PairExcursion;

/// The excursions of a face: base, then its variants.
using FaceExcursions = std::vector<Excursions>;

FaceExcursions excursions_of(const session::FaceSession& session) {
  FaceExcursions out{session.symmetry().excursions};
  for (const session::VariantRun& run : session.variants()) out.push_back(run.symmetry.excursions);
  return out;
}

/// Those that the mirrored twin gives each side.
FaceExcursions of_twins(FaceExcursions faces) {
  for (Excursions& face : faces)
    for (PairExcursion& pair : face.pairs) {
      pair.left_side.excursion_mm = pair.twin_left_mm;
      pair.right_side.excursion_mm = pair.twin_right_mm;
    }
  return faces;
}

double excursion(const PairExcursion& pair, char side) {
  return (side == 'L' ? pair.left_side : pair.right_side).excursion_mm;
}

/// The pair of that name; NaN excursions where a perturbed face has none.
PairExcursion pair_named(const Excursions& face, const std::string& name) {
  const auto found = std::ranges::find(face.pairs, name, &PairExcursion::name);
  if (found != face.pairs.end()) return *found;
  PairExcursion none;
  none.left_side.excursion_mm = none.right_side.excursion_mm = std::nan("");
  return none;
}

std::string corners_of(const Excursions& face) {
  for (const PairExcursion& pair : face.pairs)
    if (pair.left >= 0 && pair.left == face.commissure.left) return pair.name;
  return "";
}

/// A figure of a face: which one it is, and where to find it.
struct Place {
  FigureKind kind;
  std::size_t face;  // 0: base
  std::string point;
  char side;
};

double value_of(const Place& place, const FaceExcursions& faces) {
  const PairExcursion base = pair_named(faces.front(), place.point);
  if (place.kind == FigureKind::difference) return base.difference_mm();
  if (place.kind == FigureKind::excursion) return excursion(base, place.side);
  return excursion(pair_named(faces.at(place.face), place.point), place.side) -
         excursion(base, place.side);
}

/// The two excursions that a difference or a change is made of.
void add_ends(const Place& place, const FaceExcursions& faces, BudgetedFigure& figure) {
  const PairExcursion base = pair_named(faces.front(), place.point);
  if (place.kind == FigureKind::difference) {
    figure.from_mm = excursion(base, 'R');
    figure.to_mm = excursion(base, 'L');
  } else if (place.kind == FigureKind::change) {
    figure.from_mm = excursion(base, place.side);
    figure.to_mm = excursion(pair_named(faces.at(place.face), place.point), place.side);
  }
}

std::vector<Place> places_of(const FaceExcursions& faces) {
  std::vector<Place> out;
  for (std::size_t face = 0; face < faces.size(); ++face)
    for (const PairExcursion& pair : faces.front().pairs) {
      const FigureKind kind = face == 0 ? FigureKind::excursion : FigureKind::change;
      for (const char side : {'R', 'L'}) out.push_back({kind, face, pair.name, side});
      if (face == 0) out.push_back({FigureKind::difference, face, pair.name, 0});
    }
  return out;
}

/// Jitter, the head's pose and repetition. One side has half of the jitter and of the repetition of
/// a difference of two. Base and variant share the errors of the recording, which a changed face
/// scales.
void add_recording(const PairExcursion& base, const Place& place, double value_mm,
                   metrics::ErrorBudget& errors) {
  if (place.kind == FigureKind::difference) {
    errors += metrics::budget_of_difference(base).without(ErrorPart::mesh);
    return;
  }
  const metrics::SideExcursion& side = place.side == 'L' ? base.left_side : base.right_side;
  double share = 1;
  if (place.kind == FigureKind::change)
    share = side.excursion_mm > 0 ? std::pow(value_mm / side.excursion_mm, 2) : 0;
  errors.add(ErrorPart::jitter, share * std::pow(base.jitter_floor_mm / kWithin95, 2) / 2);
  errors.add(ErrorPart::head_pose, share * std::pow(side.pose_floor_mm / kWithin95, 2));
  errors.add(ErrorPart::repetition, share * std::pow(base.repetition_floor_mm / kWithin95, 2) / 2);
}

/// Forces that are found from points act elsewhere than the true ones; where displacements drive,
/// nothing is found.
void add_inversion(const scene::Scene& scene, const Place& place, double value_mm,
                   metrics::ErrorBudget& errors) {
  if (place.kind != FigureKind::change || scene.drive.by == simulate::DriveBy::displacement) return;
  const auto& changes = scene.variants.at(place.face - 1).changes.items();
  const bool of_muscles = std::ranges::all_of(
      changes, [](const auto& change) { return change.key().starts_with("muscle"); });
  const double share = of_muscles ? kInversion : kInversionOfTissue;
  errors.add(ErrorPart::inversion, std::pow(share * value_mm, 2));
}

/// Estimates the errors of a face's figures from those of perturbed faces.
class OtherFaces {
 public:
  OtherFaces(std::vector<Place> places, const FaceExcursions& own) : places_(std::move(places)) {
    own_ = values_of(own);
  }

  void add(ErrorPart part, const FaceExcursions& other) {
    others_[part].push_back(values_of(other));
  }

  metrics::ErrorBudget errors(std::size_t i) const {
    metrics::ErrorBudget out;
    for (const auto& [part, others] : others_) {
      std::vector<double> values;
      for (const std::vector<double>& other : others)
        if (!std::isnan(other[i])) values.push_back(other[i]);
      if (values.empty()) continue;
      // The face's own mesh is one of a sample. All else is drawn about the face as it is.
      if (part == ErrorPart::mesh)
        out.add(part, sample_variance(values, own_[i]), double(values.size()));
      else
        out.add(part, mean_square(values, own_[i]), freedom_of(part, values.size()));
    }
    return out;
  }
  const std::vector<Place>& places() const { return places_; }
  double own(std::size_t i) const { return own_[i]; }

 private:
  std::vector<double> values_of(const FaceExcursions& faces) const {
    std::vector<double> out;
    for (const Place& place : places_) out.push_back(value_of(place, faces));
    return out;
  }
  static double mean_square(const std::vector<double>& values, double about) {
    double sum = 0;
    for (const double value : values) sum += (value - about) * (value - about);
    return sum / double(values.size());
  }
  static double sample_variance(std::vector<double> values, double own) {
    values.push_back(own);
    double mean = 0;
    for (const double value : values) mean += value / double(values.size());
    return mean_square(values, mean) * double(values.size()) / double(values.size() - 1);
  }
  /// Stiffness and law are stated, each by one face. All else is drawn.
  static double freedom_of(ErrorPart part, std::size_t count) {
    const bool stated = part == ErrorPart::stiffness || part == ErrorPart::law;
    return stated ? std::numeric_limits<double>::infinity() : double(count);
  }

  std::vector<Place> places_;
  std::vector<double> own_;
  std::map<ErrorPart, std::vector<std::vector<double>>> others_;
};

FaceExcursions run(session::FaceSession& session, const std::function<bool()>& cancelled) {
  const simulate::RunCallbacks callbacks{.progress = {}, .cancelled = cancelled};
  session.run_base(callbacks);
  session.run_variants(callbacks);
  return excursions_of(session);
}

/// Runs the perturbed faces one after the other. Those that keep the mesh share a session.
class PerturbedRuns {
 public:
  FaceExcursions run(const PerturbedFace& face, const std::function<bool()>& cancelled) {
    const session::SessionOptions quietly{.certainty = session::Certainty::on_request};
    if (!face.same_mesh) {
      same_mesh_.reset();  // two faces at a time are enough
      session::FaceSession other(face.scene, quietly);
      return uncertainty::run(other, cancelled);
    }
    if (!same_mesh_) {
      same_mesh_.emplace(face.scene, quietly);
    } else {
      const bool taken = same_mesh_->set_scene(face.scene);
      HX_ASSERT(taken);
    }
    return uncertainty::run(*same_mesh_, cancelled);
  }

 private:
  std::optional<session::FaceSession> same_mesh_;
};

}  // namespace

FaceBudget face_budget(const session::FaceSession& session, const simulate::RunCallbacks& callbacks,
                       Laws laws) {
  const scene::Scene& scene = session.scene();
  const FaceExcursions own = excursions_of(session);
  auto faces = perturbed_faces(scene, session.inputs().landmarks);
  if (laws == Laws::own)
    std::erase_if(faces, [](const auto& face) { return face.part == ErrorPart::law; });
  OtherFaces others(places_of(own), own);
  const FaceExcursions twins = of_twins(own);
  others.add(ErrorPart::mesh, twins);
  FaceBudget out;
  if (std::isnan(value_of(others.places().front(), twins)))
    out.missing.push_back("the mirrored mesh: there is no mirrored twin");
  else
    out.assumed.push_back("the mirrored mesh");
  out.corners = corners_of(own.front());
  out.jitter_known = own.front().known.jitter;
  const auto miss = [&](const PerturbedFace& face, const std::exception& error) {
    out.missing.push_back(fmt::format("{}: {}", face.how, error.what()));
  };
  Progress progress("error budget", long(faces.size()));
  PerturbedRuns runs;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    progress.update(long(i));
    if (callbacks.progress) callbacks.progress(double(i) / double(faces.size()));
    try {
      others.add(faces[i].part, runs.run(faces[i], callbacks.cancelled));
      if (std::ranges::find(out.assumed, faces[i].how) == out.assumed.end())
        out.assumed.push_back(faces[i].how);
    } catch (const NumericalError& error) {
      miss(faces[i], error);
    } catch (const InputError& error) {  // finite strain does not know every option
      miss(faces[i], error);
    }
  }
  for (std::size_t i = 0; i < others.places().size(); ++i) {
    if (std::isnan(others.own(i))) continue;  // of a side that is not recorded
    const Place& place = others.places()[i];
    BudgetedFigure figure{
        place.kind,      place.face == 0 ? "" : scene.variants.at(place.face - 1).name,
        place.point,     place.side,
        others.own(i),   others.errors(i),
        out.jitter_known};
    add_recording(pair_named(own.front(), place.point), place, figure.value_mm, figure.errors);
    add_inversion(scene, place, figure.value_mm, figure.errors);
    add_ends(place, own, figure);
    out.figures.push_back(std::move(figure));
  }
  return out;
}

}  // namespace hyperex::uncertainty
