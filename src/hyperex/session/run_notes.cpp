// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/run_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/report/face_backing.hpp"

namespace hyperex::session {
namespace {

/// A share of the tetrahedra below which inverted ones are no warning.
constexpr double kFewInverted = 1e-3;
/// Lips that pass through each other by less are no warning.
constexpr double kLipsPass_mm = 0.5;

void warn(const char* id, std::string text, std::vector<Note>& notes,
          const std::string& variant = "") {
  notes.push_back(make_warning(id, std::move(text)));
  notes.back().variant = variant;
}

bool few_are_inverted(int inverted, Eigen::Index tets) {
  return inverted <= kFewInverted * double(tets);
}

std::string words_for(int frame, const simulate::Performance& p, const FrameWords& words) {
  if (frame < 0 || std::size_t(frame) >= p.frame_time_s.size()) return "in some frame";
  return words ? words(frame) : fmt::format("at {:.2f} s", p.frame_time_s[std::size_t(frame)]);
}

/// The greatest distance of any vertex in any frame, m; infinite where the frames differ in number.
double greatest_distance_m(const simulate::Performance& a, const simulate::Performance& b) {
  const auto &of_a = a.skin_displacement_m, &of_b = b.skin_displacement_m;
  if (of_a.size() != of_b.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t f = 0; f < of_a.size(); ++f) {
    if (of_a[f].rows() != of_b[f].rows()) return std::numeric_limits<double>::infinity();
    if (of_a[f].rows() > 0)
      most = std::max(most, double((of_a[f] - of_b[f]).rowwise().norm().maxCoeff()));
  }
  return most;
}

}  // namespace

std::vector<Note> notes_on_contact_and_elements(const simulate::SimulationReport& report,
                                                const simulate::Performance& p,
                                                const simulate::ContactOptions& contact,
                                                const FrameWords& words) {
  std::vector<Note> notes;
  const Eigen::Index tets = p.tets.rows();
  if (report.inverted_tets > 0 && few_are_inverted(report.inverted_tets, tets))
    notes.push_back(make_note(
        "tissue.few_inverted",
        fmt::format("{} of {} tetrahedra turned inside out {}, too few to matter",
                    report.inverted_tets, tets, words_for(report.inverted_frame, p, words))));
  if (contact.any() && report.contact.frames == 0)
    notes.push_back(make_note("contact.none", "contact: nothing touches in any frame"));
  return notes;
}

std::vector<Note> gaze_notes(const simulate::Performance& p, const report::FaceBacking* backing) {
  if (!backing) return {};
  const auto [right, left] =
      report::open_eyes(*backing, p.skin_rest.points, report::landmarks_at_rest(p));
  if (right && left) return {};
  const bool one = right || left;
  return {make_note(
      "eyes.closed",
      fmt::format("the recording has a gaze, but the scan has no opening at {}, or no landmarks "
                  "there: {} seen to turn; gaze.csv has the angles",
                  !one    ? "either eye"
                  : right ? "the left eye"
                          : "the right eye",
                  one ? "this eye is not" : "neither is"))};
}

std::vector<Note> run_warnings(const simulate::SimulationReport& report,
                               const simulate::Performance& p,
                               const simulate::ContactOptions& contact, const FrameWords& words) {
  std::vector<Note> notes = report.notes;
  if (report.lip_overlap_mm > kLipsPass_mm)
    warn("lips.pass_through",
         fmt::format("the lips pass through each other by up to {:.1f} mm, {}. Figures of the lips "
                     "between driven points, and the opening of the mouth, are off by at most that "
                     "much; those of driven points are not. {}",
                     report.lip_overlap_mm, words_for(report.lip_overlap_frame, p, words),
                     contact.lips ? "Contact of the lips is on and does not keep them apart there"
                                  : "contact.lips = true keeps the lips apart"),
         notes);
  if (report.inverted_tets > 0 && !few_are_inverted(report.inverted_tets, p.tets.rows()))
    warn("tissue.inverted",
         fmt::format(
             "{} of {} tetrahedra are turned inside out {}: the motion is too large for {} there",
             report.inverted_tets, p.tets.rows(), words_for(report.inverted_frame, p, words),
             p.model.strain == simulate::Strain::finite ? "these elements" : "linear strain"),
         notes);
  return notes;
}

std::vector<Note> symmetry_notes(const metrics::SymmetryMeasures& symmetry,
                                 const std::string& why_no_twin) {
  std::vector<Note> notes;
  if (symmetry.map && !symmetry.map->plane.note.empty())
    notes.push_back(make_warning("symmetry.plane_of_landmarks", symmetry.map->plane.note));
  if (!why_no_twin.empty())
    notes.push_back(
        make_note("symmetry.no_mesh_floor", "the floor of the mesh is not known: " + why_no_twin));
  return notes;
}

std::vector<Note> volume_warnings(const metrics::PeakTissue& tissue) {
  constexpr double kMuch = 3;
  if (!tissue.volume_ratio) return {};
  const metrics::TetSpread& volume = *tissue.volume_ratio;
  if (volume.min * kMuch >= 1 && volume.max <= kMuch) return {};
  return {make_warning(
      "tissue.volume_changed",
      fmt::format("at the peak the volume of single elements is {:.2f} to {:.2f} times that at "
                  "rest (99 % below {:.2f}): their stress is unreliable; use percentiles, or a "
                  "finer mesh there",
                  volume.min, volume.max, volume.p99),
      "mesh.element_size_mm")};
}

std::vector<Note> strain_notes(const metrics::PeakTissue& tissue) {
  constexpr double kLarge = 0.5;
  if (tissue.finite || !tissue.principal_strain) return {};
  const metrics::TetSpread& strain = *tissue.principal_strain;
  if (strain.max_not_inverted <= kLarge) return {};
  return {make_note(
      "tissue.large_strain",
      fmt::format("at the peak the greatest principal strain is {:.2f} (99 % below {:.2f}): small "
                  "strain is not accurate there; tissue.strain = \"finite\" is for such strains",
                  strain.max_not_inverted, strain.p99))};
}

std::vector<Note> idle_variants(const simulate::Performance& base,
                                const std::vector<VariantRun>& runs) {
  constexpr double kSame_m = 1e-6;
  std::vector<Note> notes;
  for (const VariantRun& run : runs)
    if (greatest_distance_m(base, run.simulation.performance) < kSame_m)
      warn("variant.no_effect",
           fmt::format("variant {} moves as base does: what it changes has no effect",
                       run.scene.title),
           notes, run.scene.title);
  return notes;
}

std::vector<Note> lips_that_pass(const std::vector<VariantRun>& runs, double base_mm) {
  constexpr double kAsBase_mm = 0.1;
  std::vector<Note> notes;
  for (const VariantRun& run : runs)
    if (const double mm = run.simulation.report.lip_overlap_mm;
        mm > kLipsPass_mm && (base_mm <= kLipsPass_mm || mm > base_mm + kAsBase_mm))
      warn("variant.lips_pass_through",
           fmt::format(
               "variant {}: the lips pass through each other by up to {:.1f} mm ({:.1f} mm in "
               "base): its figures of the lips are off by as much at most{}",
               run.scene.title, mm, base_mm,
               run.scene.contact.lips ? "" : "; contact.lips = true keeps the lips apart"),
           notes, run.scene.title);
  return notes;
}

std::vector<Note> gains_hardly_known(const std::vector<Note>& base,
                                     const std::vector<VariantRun>& runs) {
  const auto of_gain = [](const Note& note) { return note.id == "muscles.gain_hardly_used"; };
  std::vector<Note> notes;
  if (std::ranges::any_of(base, of_gain)) return notes;
  for (const VariantRun& run : runs)
    for (const Note& note : run.simulation.report.notes)
      if (of_gain(note))
        warn("variant.muscle_hardly_used",
             fmt::format("variant {}: {}", run.scene.title, note.text), notes, run.scene.title);
  return notes;
}

std::vector<Note> variant_warnings(const simulate::SimulationResult& base,
                                   const std::vector<VariantRun>& runs) {
  std::vector<Note> all = idle_variants(base.performance, runs);
  append(all, lips_that_pass(runs, base.report.lip_overlap_mm));
  append(all, gains_hardly_known(base.report.notes, runs));
  return all;
}

}  // namespace hyperex::session
