// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/check_options.hpp"

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

std::vector<std::string> DriveOptions::names_in(const motion::Motion& motion) const {
  if (!all_points) return points;
  std::vector<std::string> names = motion.names;
  std::erase_if(names, [&](const std::string& name) {
    return name == "stomion" || std::ranges::count(motion.skull_points, name) > 0;
  });
  return names;
}

MuscleOptions as_recorded(MuscleOptions options) {
  options.gains.clear();
  options.mirrored = false;
  return options;
}

namespace {

InputProblem wrong(const char* name, const std::string& value, const std::string& expected) {
  return {{}, 0, name, value, expected};
}

/// Options that cannot be combined with finite strain.
void check_finite(const SimulationOptions& o, std::vector<InputProblem>& problems) {
  if (o.model.law.c20 < fem::least_c20(o.model.law))
    problems.push_back(wrong("model.law.c20", fmt::format("{:g}", o.model.law.c20),
                             fmt::format("at least {:g}, -sqrt(3 c30), so that stress rises with "
                                         "stretch",
                                         fem::least_c20(o.model.law))));
  if (o.model.viscous_form != fem::ViscousForm::isotropic)
    problems.push_back(wrong("model.viscous_form", std::string(word_of(o.model.viscous_form)),
                             "isotropic where strain is finite"));
  if (o.drive.by == DriveBy::reactions)
    problems.push_back(
        wrong("drive.by", "reactions", "displacement or muscles where strain is finite"));
}

void check_tissue(const tissue::TissueParameters& uniform, std::vector<InputProblem>& problems) {
  for (int p = 0; p < tissue::parameter_count; ++p) {
    const tissue::ParameterInfo& info = tissue::parameter_info(p);
    if (!tissue::is_allowed(p, uniform[std::size_t(p)]))
      problems.push_back(wrong(("tissue." + info.name).c_str(),
                               fmt::format("{:g}", uniform[std::size_t(p)]),
                               "a number " + info.allowed_si));
  }
}

constexpr const char* kForcesMustDrive =
    "drive.by = muscles or reactions, as driven points stay where they were recorded";

/// What changes the face at rest, and which cut goes with which part.
void check_surgery(const SimulationOptions& o, std::vector<InputProblem>& problems) {
  if (!o.surgery.bones.empty() && o.drive.by == DriveBy::displacement)
    problems.push_back(wrong("surgery.bone", "bones that move", kForcesMustDrive));
  if (!o.tissue.volume_ratio.empty() && o.drive.by == DriveBy::displacement)
    problems.push_back(wrong("tissue.region", "volume that is added", kForcesMustDrive));
  for (std::size_t i = 0; i < o.surgery.bones.size(); ++i) {
    const BoneMove& move = o.surgery.bones[i];
    if (const std::string expected = expected_cut(move); !expected.empty())
      problems.push_back(wrong(fmt::format("surgery.bone[{}].cut", i).c_str(),
                               std::string(word_of(move.cut)), expected));
  }
}

}  // namespace

BoneCut usual_cut(BonePart part) {
  switch (part) {
    case BonePart::maxilla:
      return BoneCut::le_fort_1;
    case BonePart::mandible:
      return BoneCut::bsso;
    case BonePart::chin:
      return BoneCut::genioplasty;
    case BonePart::skull:
      break;
  }
  return BoneCut::whole;
}

std::string expected_cut(const BoneMove& move) {
  const BoneCut usual = usual_cut(move.part);
  const bool a_part_of_a_bone = move.part == BonePart::chin || move.part == BonePart::maxilla;
  if (move.cut == BoneCut::standard || move.cut == usual ||
      (move.cut == BoneCut::whole && !a_part_of_a_bone))
    return "";
  return fmt::format("standard or {}{} for the {}", word_of(usual),
                     a_part_of_a_bone || usual == BoneCut::whole ? "" : ", or whole,",
                     word_of(move.part));
}

void check(const SimulationOptions& o) {
  std::vector<InputProblem> problems = out_of_bounds(o);
  check_tissue(o.tissue.uniform, problems);
  check_surgery(o, problems);
  if (o.drive.by != DriveBy::muscles && (o.muscles.mirrored || !o.muscles.gains.empty()))
    problems.push_back(wrong("muscles", "gains or mirrored", "drive.by = muscles"));
  if (o.solver.newmark_gamma > 2 * o.solver.newmark_beta)
    problems.push_back(wrong("solver.newmark_gamma", fmt::format("{:g}", o.solver.newmark_gamma),
                             "at most twice newmark_beta"));
  if (o.model.strain == Strain::finite) check_finite(o, problems);
  if (!problems.empty()) throw InputError(problems);
}

int frame_count(const TimeOptions& time, double end_s) {
  constexpr double rounding = 1e-6;  // of a frame: 0.1 s at 30 Hz ends with its fourth frame
  return 1 + static_cast<int>(std::floor(std::max(0.0, end_s) * time.frame_rate_hz + rounding));
}

}  // namespace hyperex::simulate
