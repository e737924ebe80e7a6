// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::simulate {

fem::Material TissueValues::material(std::size_t tets, fem::ViscousForm viscous_form) const {
  fem::Material out;
  const auto fill = [&](std::vector<double>& values, tissue::Parameter parameter) {
    HX_ASSERT(element[parameter].empty() || element[parameter].size() == tets);
    if (element[parameter].empty())
      values.assign(tets, uniform[parameter]);
    else
      values = element[parameter];
    HX_ASSERT(std::all_of(values.begin(), values.end(),
                          [&](double value) { return tissue::is_allowed(parameter, value); }));
  };
  fill(out.young_pa, tissue::young);
  fill(out.poisson, tissue::poisson);
  fill(out.viscosity_pa_s, tissue::viscosity);
  fill(out.density_kg_m3, tissue::density);
  out.viscous_form = viscous_form;
  return out;
}

MuscleOptions as_recorded(MuscleOptions options) {
  options.gains.clear();
  options.mirrored = false;
  return options;
}

namespace {

/// Shorter steps would take longer than anyone waits.
constexpr double kLeastFiniteStep_s = 1e-4;

void check_finite(const SimulationOptions& o, std::vector<InputProblem>& problems) {
  const auto wrong = [&](const char* name, const std::string& value, const char* expected) {
    problems.push_back({{}, 0, name, value, expected});
  };
  if (!fem::is_admissible(o.model.law))
    wrong("model.law", std::string(fem::to_string(o.model.law.law)),
          "ratios that keep the stress rising: c01 >= 0, c30 >= 0, c20 >= -sqrt(3 c30)");
  for (const fem::MaxwellBranch& b : o.model.law.branches)
    if (!(b.ratio >= 0) || !(b.relaxation_s > 0))
      wrong("model.law.branches", fmt::format("ratio {:g}, {:g} s", b.ratio, b.relaxation_s),
            "a ratio of at least 0 and a time above 0 s");
  if (o.model.viscous_form != fem::ViscousForm::isotropic)
    wrong("model.viscous_form", "printed", "isotropic where strain is finite");
  if (o.drive.by == DriveBy::reactions)
    wrong("drive.by", "reactions", "displacement or muscles where strain is finite");
}

}  // namespace

void check(const SimulationOptions& o) {
  std::vector<InputProblem> problems;
  const auto in = [&](const char* name, double value, const Bounds& bounds) {
    if (!bounds.holds(value))
      problems.push_back({{},
                          0,
                          name,
                          fmt::format("{:g}", value),
                          fmt::format("a number from {:g} to {:g}", bounds.least, bounds.most)});
  };
  in("region.measured_radius_m", o.region.measured_radius_m, o.region.measured_radius_m_in);
  in("region.blend_m", o.region.blend_m, o.region.blend_m_in);
  const BoneLayer &skull = o.support.skull_layer, &mandible = o.support.mandible_layer;
  const Bounds& stiffness = o.support.stiffness_pa_per_m_in;
  in("support.skull_layer.across_pa_per_m", skull.across_pa_per_m, stiffness);
  in("support.skull_layer.along_pa_per_m", skull.along_pa_per_m, stiffness);
  in("support.mandible_layer.across_pa_per_m", mandible.across_pa_per_m, stiffness);
  in("support.mandible_layer.along_pa_per_m", mandible.along_pa_per_m, stiffness);
  in("support.field_pa_per_m", o.support.field_pa_per_m, stiffness);
  if (o.drive.by != DriveBy::muscles && (o.muscles.mirrored || !o.muscles.gains.empty()))
    problems.push_back({{}, 0, "muscles", "gains or mirrored", "drive.by = muscles"});
  for (const MuscleGain& g : o.muscles.gains) in("muscles.gain", g.gain, o.muscles.gain_in);
  in("drive.patch_radius_m", o.drive.patch_radius_m, o.drive.patch_radius_m_in);
  in("solver.tolerance", o.solver.tolerance, o.solver.tolerance_in);
  in("solver.newmark_beta", o.solver.newmark_beta, o.solver.newmark_beta_in);
  in("solver.newmark_gamma", o.solver.newmark_gamma,
     {o.solver.newmark_gamma_in.least,
      std::min(o.solver.newmark_gamma_in.most, 2 * o.solver.newmark_beta)});
  in("solver.finite_step_s", o.solver.finite_step_s, o.solver.finite_step_s_in);
  if (o.solver.finite_step_s > 0 && o.solver.finite_step_s < kLeastFiniteStep_s)
    problems.push_back({{},
                        0,
                        "solver.finite_step_s",
                        fmt::format("{:g}", o.solver.finite_step_s),
                        fmt::format("0 (a frame) or at least {:g} s", kLeastFiniteStep_s)});
  in("solver.finite_tolerance", o.solver.finite_tolerance, o.solver.finite_tolerance_in);
  if (o.model.strain == Strain::finite) check_finite(o, problems);
  in("contact.patch_pa_per_m", o.contact.patch_pa_per_m, o.contact.patch_pa_per_m_in);
  in("contact.point_give", o.contact.point_give, o.contact.point_give_in);
  in("time.step_s", o.time.step_s, o.time.step_s_in);
  in("time.end_s", o.time.end_s, o.time.end_s_in);
  in("time.frame_rate_hz", o.time.frame_rate_hz, o.time.frame_rate_hz_in);
  in("time.peak_time_s", o.time.peak_time_s, o.time.peak_time_s_in);
  for (const double time_s : o.time.still_times_s)
    in("time.still_times_s", time_s, o.time.still_times_s_in);
  for (int p = 0; p < tissue::parameter_count; ++p) {
    const tissue::ParameterInfo& info = tissue::parameter_info(p);
    if (!tissue::is_allowed(p, o.tissue.uniform[p]))
      problems.push_back({{},
                          0,
                          std::string("tissue.") + info.key,
                          fmt::format("{:g}", o.tissue.uniform[p] / info.si),
                          std::string("a number ") + info.allowed});
  }
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace hyperex::simulate
