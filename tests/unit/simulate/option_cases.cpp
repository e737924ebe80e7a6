// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/option_cases.hpp"

#include <stdexcept>
#include <type_traits>

namespace hyperex::simulate::test {
namespace {

/// Another value within the bounds.
template <class Value>
Value another(Value value, const Bounds& bounds) {
  if constexpr (std::is_same_v<Value, bool>) return !value;
  for (const double other : {value + 1.0, value - 1.0, value * 1.25, value * 0.8, bounds.most / 2})
    if (bounds.holds(other) && Value(other) != value) return Value(other);
  throw std::logic_error("no other value is within the bounds");
}

/// Adds a case for each number and truth value of a section that no case names. So a new option is
/// tested without a line here: it is an input of the stages that its section is an input of. Other
/// types need a case, and so does an option that is a source of its own.
template <class Section>
struct AddDescribed {
  std::string section, source;
  Section Options::*member;
  std::vector<OptionCase> cases;

  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& details = {}) {
    using Value = std::remove_cvref_t<decltype(at(std::declval<Section&>()))>;
    if constexpr (std::is_arithmetic_v<Value>) {
      const std::string full = section + "." + name;
      if (std::ranges::count(cases, full, &OptionCase::name) > 0) return;
      const Section standard;
      const Value other = another<Value>(at(standard), details.bounds);
      cases.push_back({full,
                       {source},
                       [of = member, at, other](Options& o) { at(o.*of) = other; },
                       std::nullopt});
    }
  }
  template <class At, class AllAt>
  void one_or_all(const char*, At, const char*, AllAt, const char*) {}
  template <class At, class Words>
  void factors(const char*, At, const Words&, const char*, const OptionDetails&) {}
};
template <class Section>
std::vector<OptionCase> with_described(const std::string& section, const std::string& source,
                                       Section Options::*member, std::vector<OptionCase> cases) {
  AddDescribed<Section> add{section, source, member, std::move(cases)};
  Section::describe(add);
  return add.cases;
}

}  // namespace

const std::vector<OptionCase>& model_cases() {
  static const std::vector<OptionCase> named = {
      {"model.element",
       {"model", "model.element"},
       [](Options& o) { o.model.element = fem::ElementKind::tet4; }},
      {"model.viscous_form",
       {"model"},
       [](Options& o) { o.model.viscous_form = fem::ViscousForm::printed; }},
      {"model.strain", {"model"}, [](Options& o) { o.model.strain = Strain::finite; }},
      {"model.law", {"model"}, [](Options& o) { o.model.law.c20 = 0.1; }, false}};
  static const auto cases = with_described("model", "model", &Options::model, named);
  return cases;
}

const std::vector<OptionCase>& tissue_cases() {
  static const std::vector<OptionCase> cases = {
      {"tissue.uniform",
       {"tissue (not its volume)"},
       [](Options& o) { o.tissue.uniform[tissue::young] *= 3; }},
      {"tissue.uniform.density",
       {"tissue (not its volume)"},
       [](Options& o) { o.tissue.uniform[tissue::density] *= 3; }},
      {"tissue.uniform.viscosity",
       {"tissue (not its volume)"},
       [](Options& o) { o.tissue.uniform[tissue::viscosity] *= 30; }},
      {"tissue.uniform.poisson", {"tissue (not its volume)"}, [](Options& o) {
         o.tissue.uniform[tissue::poisson] = 0.3;
       }}};
  return cases;
}

const std::vector<OptionCase>& support_cases() {
  static const std::vector<OptionCase> named = {
      {"support.border_held", {"support"}, [](Options& o) { o.support.border_held = false; }},
      {"support.skull", {"support"}, [](Options& o) { o.support.skull = Hold::held; }},
      {"support.mandible", {"support"}, [](Options& o) { o.support.mandible = Mandible::free; }},
      {"support.skull_layer",
       {"support"},
       [](Options& o) { o.support.skull_layer.along_pa_per_m *= 3; }},
      {"support.mandible_layer",
       {"support"},
       [](Options& o) { o.support.mandible_layer.across_pa_per_m *= 3; }},
      {"support.field_pa_per_m", {"support"}, [](Options& o) { o.support.field_pa_per_m *= 2; }},
      {"support.teeth_layer",
       {"support"},
       [](Options& o) { o.support.teeth_layer.across_pa_per_m = 1e6; }},
      {"support.teeth_reach_m", {"support"}, [](Options& o) { o.support.teeth_reach_m = 0.02; }},
      {"support.throat_pa_per_m",
       {"support"},
       [](Options& o) { o.support.throat_pa_per_m = 2e6; },
       false},
      {"support.throat_reach_m",
       {"support"},
       [](Options& o) { o.support.throat_reach_m = 0.05; },
       false},
      {"support.jaw_points", {"support"}, [](Options& o) {
         o.support.jaw_points = {"ibug68_57"};
       }}};
  static const auto cases = with_described("support", "support", &Options::support, named);
  return cases;
}

const std::vector<OptionCase>& drive_cases() {
  static const std::vector<OptionCase> named = {
      {"drive.by",
       {"drive (not its gain)", "drive.by", "steps of reactions"},
       [](Options& o) { o.drive.by = DriveBy::reactions; }},
      {"drive.all_points", {"drive (not its gain)"}, [](Options& o) { o.drive.all_points = true; }},
      {"drive.points", {"drive (not its gain)"}, [](Options& o) { o.drive.points.pop_back(); }},
      {"drive.still_points",
       {"drive (not its gain)"},
       [](Options& o) { o.drive.still_points = {"ibug68_33"}; }},
      {"drive.patch_radius_m",
       {"drive (not its gain)"},
       [](Options& o) { o.drive.patch_radius_m = 0.02; }},
      {"drive.gain", {"drive.gain"}, [](Options& o) { o.drive.gain = 0.5; }}};
  static const auto cases = with_described("drive", "drive (not its gain)", &Options::drive, named);
  return cases;
}

const std::vector<OptionCase>& muscle_cases() {
  const std::string all = "muscles (not their gains)";
  using M = MuscleOptions;
  const auto scaled = [all](const char* name, double M::*member, bool has_effect = true) {
    return OptionCase{std::string("muscles.") + name,
                      {all},
                      [member](Options& o) { o.muscles.*member *= 0.8; },
                      has_effect};
  };
  static const std::vector<OptionCase> named = {
      {"muscles.own",
       {all},
       [](Options& o) {
         o.muscles.own = muscles::muscle_template();
         o.muscles.own.front().readiness *= 0.1;
         o.muscles.own.front().width_mm *= 2;
       }},
      {"muscles.gains",
       {"muscles.gain"},
       [](Options& o) {
         o.muscles.gains = {{"side_L", 0.5}};
       }},
      {"muscles.mirrored", {"muscles.gain"}, [](Options& o) { o.muscles.mirrored = true; }},
      {"muscles.skull_layer", {all}, [](Options& o) { o.muscles.skull_layer.along_pa_per_m *= 2; }},
      {"muscles.mandible_layer",
       {all},
       [](Options& o) { o.muscles.mandible_layer.across_pa_per_m *= 2; }},
      {"muscles.teeth_layer", {all}, [](Options& o) { o.muscles.teeth_layer.along_pa_per_m *= 2; }},
      scaled("lip_stiffening", &M::lip_stiffening),
      scaled("lip_reach_m", &M::lip_reach_m),
      scaled("foundation_pa_per_m", &M::foundation_pa_per_m),
      scaled("teeth_reach_m", &M::teeth_reach_m),
      scaled("throat_pa_per_m", &M::throat_pa_per_m, false),  // the face has no throat
      scaled("throat_reach_m", &M::throat_reach_m, false),
      {"muscles.shape", {all}, [](Options& o) { o.muscles.shape.band *= 0.8; }},
      {"muscles.fold", {all}, [](Options& o) { o.muscles.fold.width_mm *= 0.8; }},
      scaled("widening", &M::widening),
      scaled("half", &M::half),
      scaled("few_sigma_m", &M::few_sigma_m),
      scaled("many_sigma_m", &M::many_sigma_m, false),  // few points drive
      scaled("activation_sigma", &M::activation_sigma),
      scaled("ring_sigma", &M::ring_sigma),
      scaled("tone_sigma", &M::tone_sigma),
      {"muscles.slide_sigma_m", {all}, [](Options& o) { o.muscles.slide_sigma_m *= 2; }},
      scaled("side_correlation", &M::side_correlation),
      scaled("many_patch_m", &M::many_patch_m, false),
      {"muscles.shape_prior", {all}, [](Options& o) { o.muscles.shape_prior = false; }},
      scaled("shape_sigma_m", &M::shape_sigma_m),
      scaled("shape_share", &M::shape_share),
      scaled("shape_smoothing_m", &M::shape_smoothing_m),
      scaled("shape_clear_m", &M::shape_clear_m),
      scaled("shape_reach_m", &M::shape_reach_m),
      scaled("few_cheek_share", &M::few_cheek_share),
      scaled("few_lip_share", &M::few_lip_share),
      scaled("many_muscle_share", &M::many_muscle_share, false),
      scaled("jaw_share", &M::jaw_share)};
  static const auto cases = with_described("muscles", all, &Options::muscles, named);
  return cases;
}

const std::vector<OptionCase>& region_cases() {
  static const std::vector<OptionCase> named = {
      {"region.measured", {"region"}, [](Options& o) { o.region.measured = Measured::all; }},
      {"region.measured_points",
       {"region"},
       [](Options& o) {
         o.region.measured_points = {"ibug68_8", "ibug68_7"};
       }},
      {"region.measured_radius_m",
       {"region"},
       [](Options& o) { o.region.measured_radius_m = 0.03; }},
      {"region.blend_m", {"region"}, [](Options& o) { o.region.blend_m = 0.02; }}};
  static const auto cases = with_described("region", "region", &Options::region, named);
  return cases;
}

const std::vector<OptionCase>& finite_solver_cases() {
  static const std::vector<OptionCase> cases = {
      {"solver.finite_step_s", {"solver"}, [](Options& o) { o.solver.finite_step_s = 0.05; }},
      {"solver.finite_tolerance", {"solver"}, [](Options& o) { o.solver.finite_tolerance = 1e-7; }},
      {"solver.full_newton", {"solver"}, [](Options& o) { o.solver.full_newton = true; }},
      {"model.law.c20", {"model"}, [](Options& o) {
         o.model.law.law = fem::HyperelasticLaw::yeoh;
       }}};
  return cases;
}

const std::vector<OptionCase>& solver_cases() {
  static const std::vector<OptionCase> named = {
      {"solver.method", {"solver"}, [](Options& o) { o.solver.method = SolverMethod::direct; }},
      {"solver.tolerance",
       {"solver", "solver.tolerance"},
       [](Options& o) { o.solver.tolerance = 1e-7; }},
      {"solver.newmark_beta",
       {"solver", "solver.newmark"},
       [](Options& o) { o.solver.newmark_beta = 0.4; }},
      {"solver.newmark_gamma",
       {"solver", "solver.newmark"},
       [](Options& o) { o.solver.newmark_beta = 0.4, o.solver.newmark_gamma = 0.7; }},
      {"solver.verify", {"solver"}, [](Options& o) { o.solver.verify = true; }, false}};
  static const auto cases = [] {
    std::vector<OptionCase> all = named;
    for (const OptionCase& option : finite_solver_cases()) all.push_back(option);
    all = with_described("solver", "solver", &Options::solver, all);
    all.erase(all.begin() + std::ptrdiff_t(named.size()),
              all.begin() + std::ptrdiff_t(named.size() + finite_solver_cases().size()));
    return all;
  }();
  return cases;
}

const std::vector<OptionCase>& contact_cases() {
  static const std::vector<OptionCase> named = {
      {"contact.lips", {"contact"}, [](Options& o) { o.contact.lips = false; }, false},
      {"contact.teeth",
       {"contact", "contact.teeth or eyes"},
       [](Options& o) { o.contact.teeth = false; }},
      {"contact.eyes",
       {"contact", "contact.teeth or eyes"},
       [](Options& o) { o.contact.eyes = true; },
       false},
      {"contact.patch_pa_per_m", {"contact"}, [](Options& o) { o.contact.patch_pa_per_m = 1e6; }},
      {"contact.point_give",
       {"contact"},
       [](Options& o) { o.contact.point_give = 50; },
       false}};  // displacements drive
  static const auto cases = with_described("contact", "contact", &Options::contact, named);
  return cases;
}

const std::vector<OptionCase>& surgery_cases() {
  static const std::vector<OptionCase> cases = {
      {"surgery.bones", {"surgery"}, [](Options& o) {
         o.surgery.bones = {{.part = BonePart::chin, .move_m = {0, 0, 0.005}}};
       }}};
  return cases;
}

const std::vector<OptionCase>& time_cases() {
  static const std::vector<OptionCase> named = {
      {"time.step_s", {"time", "time.step_s"}, [](Options& o) { o.time.step_s = 0.005; }},
      {"time.end_s", {"time", "time.end_s"}, [](Options& o) { o.time.end_s = 0.1; }},
      {"time.frame_rate_hz", {"time"}, [](Options& o) { o.time.frame_rate_hz = 60; }},
      {"time.peak_time_s", {"time"}, [](Options& o) { o.time.peak_time_s = 0.05; }, false},
      {"time.still_times_s", {"time"}, [](Options& o) { o.time.still_times_s = {0.07}; }}};
  static const auto cases = with_described("time", "time", &Options::time, named);
  return cases;
}

}  // namespace hyperex::simulate::test
