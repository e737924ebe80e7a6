// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Notes on a finished run, made here for the program, the studio and Python alike.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/metrics/peak_tissue.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::report {
struct FaceBacking;
}

namespace hyperex::session {

/// Words for a frame in a sentence, such as "at 0.77 s".
using FrameWords = std::function<std::string(int frame)>;

/// Notes, no warnings: few inverted tetrahedra (`tissue.few_inverted`: at most 0.1 %), contact that
/// never acts (`contact.none`). `contact`: what the user asks for. `words`: empty: the frame's
/// time.
std::vector<Note> notes_on_contact_and_elements(const simulate::SimulationReport& report,
                                                const simulate::Performance& performance,
                                                const simulate::ContactOptions& contact,
                                                const FrameWords& words = {});

/// `eyes.closed` (a note): the recording has a gaze, and the scan has no opening at an eye, so that
/// the eyeball there is hidden. `backing`: report::face_backing() of `performance`; null: the
/// recording has no gaze.
std::vector<Note> gaze_notes(const simulate::Performance& performance,
                             const report::FaceBacking* backing);

/// Warnings: the report's own notes (SimulationReport::notes), `lips.pass_through` (by more than
/// 0.5 mm), `tissue.inverted` (more than 0.1 % of the tetrahedra). `words`: empty: the frame's
/// time.
std::vector<Note> run_warnings(const simulate::SimulationReport& report,
                               const simulate::Performance& performance,
                               const simulate::ContactOptions& contact,
                               const FrameWords& words = {});

/// `symmetry.plane_of_landmarks` (a warning: the plane between left and right),
/// `symmetry.no_mesh_floor` (a note: `why_no_twin`, a sentence, where it is not empty).
std::vector<Note> symmetry_notes(const metrics::SymmetryMeasures& symmetry,
                                 const std::string& why_no_twin);

/// `tissue.volume_changed` (a warning): at finite strain, single elements whose volume changes by
/// more than 3 times. Patches of elements keep their volume, so that the skin's motion is hardly
/// affected.
std::vector<Note> volume_warnings(const metrics::PeakTissue& tissue);

/// `tissue.large_strain` (a note): at small strain, a principal strain above 0.5 at the peak.
std::vector<Note> strain_notes(const metrics::PeakTissue& tissue);

/// `variant.no_effect`: a variant that moves as base does, to 0.001 mm. It is probably a mistake.
std::vector<Note> idle_variants(const simulate::Performance& base,
                                const std::vector<VariantRun>& runs);

/// `variant.lips_pass_through`: lips that pass through each other by more than 0.5 mm, and farther
/// than base's, which run_warnings() reports.
std::vector<Note> lips_that_pass(const std::vector<VariantRun>& runs, double base_mm);

/// `variant.muscle_hardly_used`: a variant's `muscles.gain_hardly_used`, unless base has it too.
std::vector<Note> gains_hardly_known(const std::vector<Note>& base,
                                     const std::vector<VariantRun>& runs);

/// The last three together.
std::vector<Note> variant_warnings(const simulate::SimulationResult& base,
                                   const std::vector<VariantRun>& runs);

}  // namespace hyperex::session
