// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/note_kinds.hpp"

#include <algorithm>
#include <iterator>

namespace hyperex {
namespace {

constexpr NoteKind warning(const char* id, const char* key, const char* when) {
  return {id, Severity::warning, key, when};
}
constexpr NoteKind note(const char* id, const char* key, const char* when) {
  return {id, Severity::note, key, when};
}

// clang-format off
constexpr NoteKind kKinds[] = {
  warning("landmarks.doubtful", "scan.landmarks",
    "A landmark is probably not where its name says: more than 5 mm off the scan or from another "
    "name of the same place, or farther from where the others predict it than faces differ."),
  warning("landmarks.many_doubtful", "scan.landmarks",
    "More than a third of the landmarks are doubtful: they may belong to another scan."),
  warning("landmarks.misspelt", "scan.landmarks",
    "A landmark's name is not known and looks like one that is; at most five are named."),
  warning("scan.turned_triangles", "scan.file",
    "At more than 2 % of the edges between two of the scan's triangles both run the same way, so "
    "that one of them is turned inside out."),
  warning("scan.flat", "scan.file",
    "The tip of the nose stands before the plane of the corners of eyes and mouth by less than "
    "0.15 of the distance between the outer corners of the eyes. On the faces measured it is 0.31 "
    "to 0.52."),
  warning("recording.mirror_unknown", "motion.mirrored",
    "The recording is a video, which has no flag for mirroring, and motion.mirrored is not given."),
  warning("recording.time_unit_doubtful", "motion.file",
    "Samples are more than 0.5 s apart (median), or the recording lasts more than ten minutes: its "
    "times are probably in milliseconds."),
  warning("recording.wild_samples", "motion.file",
    "A point jumps away and comes back within one or two samples, by more than 20 mm and faster "
    "than 0.6 m/s. At 24 samples a second and more, 6 mm in one reading count while the points "
    "beside it stay. So do 5 mm for up to 0.2 s, two points that exchange their places, and up to "
    "0.1 s at an end above 6 mm and 0.3 m/s. The readings were left out and interpolated."),
  warning("recording.zeros", "motion.file",
    "Readings of (0, 0, 0) of a point that is never within 20 mm of there otherwise: some systems "
    "write this for a marker that they do not see. They were taken as missing."),
  warning("recording.lone_samples", "motion.file",
    "A point jumps away by more than 20 mm and comes back in one reading while the points beside it "
    "stay, in a recording of less than 24 samples a second. The readings were kept."),
  warning("recording.jumps", "motion.file",
    "A point moves by more than 20 mm and faster than 0.6 m/s from one reading to the next, and "
    "stays away too long to be mended. At 24 samples a second and more, 5 mm count if it jumps back "
    "within 0.3 s while the points beside it stay. The readings were kept."),
  warning("recording.held_points", "motion.file",
    "A point has equal readings for at least 0.2 s while three of the four points beside it move by "
    "1 mm or more, and moves at other times. The system lost this marker and held it; the readings "
    "were kept."),
  warning("recording.end_samples", "motion.file",
    "A point jumps at an end of the recording while the points beside it stay. At 24 samples a "
    "second and more 8 mm count, in slower recordings 20 mm. No way back is seen, so that it may be "
    "a movement: the readings were kept."),
  warning("recording.far_points", "motion.file",
    "A point goes farther from its first place than this part of a face can: corners of the mouth "
    "38 mm, upper lip 30, brows 25, nose and eyes 20, lower lip and chin 75."),
  warning("recording.wild_weights", "motion.arkit",
    "A weight, not of eyes or tongue, jumps by more than 0.3 and back within 0.2 s, at 24 Hz or "
    "more. The readings were left out and interpolated."),
  warning("recording.weight_jumps", "motion.arkit",
    "A weight jumps by more than 0.3 where this may be real: in one reading at an end of the "
    "recording, or for 0.2 to 0.3 s. Below 24 Hz one reading counts that jumps by more, in "
    "proportion. The readings were kept."),
  warning("recording.nothing_moves", "motion.unit",
    "No point moves 0.05 mm from its first place, head motion removed. In a recording with jitter: "
    "smoothed, no point moves farther than jitter alone makes the farthest of all go, and none 3 "
    "mm."),
  warning("recording.starts_in_expression", "motion.rest_s",
    "The face is nearer to rest later than at the start, and displacements count from the start."),
  warning("recording.ends_in_expression", "motion.file",
    "The farthest point is 2 mm or more from rest in the last 0.1 s, and went more than 0.3 of this "
    "in the last 0.2 s: the expression may not be complete. In recordings of 0.6 s or more with "
    "samples at most 0.1 s apart."),
  warning("recording.column_misspelt", "motion.arkit",
    "A column of a table of weights is no blend shape and is at most two letters from one; it is "
    "left out."),
  warning("recording.side_missing", "motion.arkit",
    "A table of weights has no column for a shape of one side whose counterpart exceeds 0.05; it "
    "counts as 0. This is a warning only where another shape has both sides."),
  warning("recording.one_sided", "motion.file",
    "One corner of the mouth is recorded, and the other is not. A run simulates that side from what "
    "is usual; it gives no figures of that corner, and none that compare the two."),
  warning("recording.coarse", "motion.file",
    "The samples are more than 0.1 s apart: quicker motions between two samples are lost. Not said "
    "of keyframes (recording.keyframes)."),
  warning("recording.short", "motion.file",
    "The recording has fewer than five samples: what the face does between them is interpolated."),
  warning("recording.shapes_lost", "motion.arkit",
    "A blend shape that the face model does not have reaches a weight above 0.3."),
  warning("recording.size_implausible", "motion.unit",
    "Without a scan's landmarks: the points lie less than 0.5 or more than 1.8 times as far apart "
    "as on an average face. The unit is probably another."),
  warning("recording.fits_badly", "motion.unit",
    "After alignment the common points are more than 10 mm rms apart, 5 mm where there are at least "
    "20, or the scale is outside 0.95 to 1.05. For points from a camera or a model of a face 0.8 to "
    "1.25 hold. Points of recording.point_off do not count."),
  warning("recording.point_off", "motion.file",
    "After a fit that wrong points do not pull, a point is more than 8 mm and four times the median "
    "from the scan's landmark of its name, and its neighbours are not. 30 mm hold for points that "
    "people place differently, and where fewer than 20 points are common. By the recording alone "
    "(`new`, `symmetry`, `visits`): 15 mm or more from the average face's place."),
  warning("time.beyond_recording", "time.end_s",
    "The run ends more than 1 s after the recording: the face is held as its last sample shows it."),
  warning("sides.doubtful", "motion.file",
    "The points fit the face better with left and right exchanged, but not well enough to refuse "
    "the recording."),
  warning("sides.exchanged_pair", "motion.file",
    "Single pairs of points lie the other way round than on the face, by less than half of their "
    "distance there. Where they do by more, or most pairs do, the recording is refused. Where an "
    "exchange would not bring both points nearer to their places, it says how far a point is off. "
    "Where pairs contradict each other, and those that fit are not more, it names both kinds."),
  warning("anatomy.ct_fits_badly", "anatomy.ct",
    "The skin of the CT is more than 1.5 mm (median) from the scan after it was laid on it."),
  warning("anatomy.bone_outside", "anatomy.skull",
    "Bone lies outside the skin at more than 1 % of the face; at more than 10 % it is refused."),
  warning("anatomy.no_condyles", "anatomy.mandible",
    "The heads of the mandible were not found within 45 mm of where landmarks place them."),
  warning("anatomy.no_mandible", "anatomy.mandible",
    "Bones are given without a mandible."),
  warning("head.pose_unknown", "motion.rigid_points",
    "The head's position is uncertain by more than 3 mm (95 %)."),
  warning("head.points_not_rigid", "motion.rigid_points",
    "The distance between two points of motion.rigid_points changes by more than 1.5 mm (in at least "
    "5 % of the samples)."),
  warning("law.idle", "tissue.strain",
    "Keys are given that only finite strain uses, and neither the scene nor a variant has it."),
  warning("region.idle", "region.measured",
    "Keys of [region] are given, and neither the scene nor a variant has region.measured."),
  warning("support.idle", "drive.by",
    "Stiffnesses or jaw points of [support] are given, and muscles drive the scene and all of its "
    "variants."),
  warning("keys.idle", "",
    "Keys are given that another key leaves without effect. `key` is that other key."),
  warning("drive.by_key", "drive.by",
    "Not drive.by but another key, which muscles do not use, makes displacement drive the face."),
  warning("skin.far_from_scan", "mesh.element_size_mm",
    "Within 25 mm of a landmark the simulated skin is more than 5 mm off the scan."),
  warning("forces.found_anew", "drive.by",
    "Tissue or support was changed after a run whose forces were not held: other forces were found."),
  warning("drive.points_off", "drive.points",
    "A driven point ends more than 0.1 mm from where it is driven, and farther than the recording's "
    "jitter moves it. The cause is named, or what is likely where none can be established."),
  warning("contact.no_equilibrium", "contact",
    "At finite strain no equilibrium with contact was found in some frames."),
  warning("solver.reduced_not_converged", "solver.method",
    "The reduced model's estimated error stayed above solver.tolerance, and is 0.05 mm or more."),
  warning("lips.pass_through", "contact.lips",
    "The lips pass through each other by more than 0.5 mm in some frame."),
  warning("rig.lid_doubtful", "scan.landmarks",
    "A shape of `hyperex rig` moves the skin around an eye by 1.8 times the way of the landmarks "
    "there or more. Or it moves it by 1.6 times that of the other eye in the mirrored shape. 2 mm "
    "beyond either count."),
  warning("tissue.inverted", "tissue.strain",
    "More than 0.1 % of the tetrahedra are turned inside out in some frame."),
  warning("tissue.volume_changed", "mesh.element_size_mm",
    "At finite strain the volume of a single element changes more than threefold at the peak."),
  warning("symmetry.plane_of_landmarks", "",
    "The midsagittal plane is that of the landmarks alone, as the surface could not refine it."),
  warning("output.glb_coarse", "output.glb_max_mb",
    "performance.glb reaches output.glb_max_mb before output.glb_tolerance_mm."),
  warning("muscles.gain_hardly_used", "muscles.gain",
    "A gain changes the strength of muscles that the recording uses by less than their uncertainty "
    "(1 sigma)."),
  warning("variant.no_effect", "variant",
    "A variant moves as base does, to 0.001 mm: probably a mistake."),
  warning("variant.lips_pass_through", "contact.lips",
    "A variant's lips pass through each other by more than 0.5 mm and farther than base's."),
  warning("variant.muscle_hardly_used", "muscles.gain",
    "The same of a variant."),
  warning("variant.left_out", "variant",
    "A variant of a scene that was opened in the studio cannot be run. The studio leaves it out; a "
    "saved scene keeps it."),

  note("run.error_budget", "output.error_budget",
    "The 95 % interval of a corner of the mouth, or of what a variant changes there."),
  note("anatomy.ct_aligned", "anatomy.ct", "How well the CT's skin fits the scan."),
  note("anatomy.ct_in_frame", "anatomy.ct", "The CT's skin and the scan are in one frame."),
  note("anatomy.condyles", "anatomy.mandible", "The heads of the mandible were found."),
  note("scan.unit_guessed", "scan.unit", "The scan's unit was guessed from its size."),
  note("scan.mended", "scan.file", "Faults of the scan's mesh were mended in a working copy."),
  note("scan.thinned", "scan.file", "The scan has more than 60,000 vertices and was thinned."),
  note("landmarks.placed", "scan.landmarks",
    "Landmarks that were not given were placed by the canonical face."),
  note("landmarks.found", "scan.landmarks",
    "The scene names no landmarks; they were found in pictures of the scan."),
  note("landmarks.not_searched", "scan.landmarks",
    "Landmarks are not searched for before a study or where a size is estimated; what could not be "
    "checked is named."),
  note("landmarks.unknown", "scan.landmarks", "Landmarks have names that are not known."),
  note("recording.expressions", "motion", "What was assumed or left out in reading expressions."),
  note("recording.tracked", "motion.recording", "In how many frames a face was tracked."),
  note("recording.first_face", "motion.recording",
    "`hyperex check` tracks a recording to its first frame with a face."),
  note("recording.no_depth", "motion.recording",
    "The recording has no depth: lengths assume an average distance between the eyes."),
  note("recording.source", "motion.recording", "What the camera or the video reader reports."),
  note("recording.unit", "motion.unit", "The recording's unit, and how it is known."),
  note("recording.timing", "motion.file", "How long the recording lasts, and its sampling."),
  note("recording.keyframes", "motion.arkit",
    "A table of weights has up to 30 rows more than 0.1 s apart (median) at times that no device "
    "would sample at: uneven, or more than 0.5 s apart within 33 s. They are taken for keyframes."),
  note("recording.gaps_filled", "motion.max_gap_s", "Gaps of the recording were interpolated."),
  note("recording.lead_in", "motion.rest_s",
    "The face is not at rest where the run begins in the recording: the run leads face and eyes "
    "from rest into it."),
  note("time.end_of_run", "time.end_s",
    "time.end_s is after time.start_s, as if it were counted from the start of the recording."),
  note("recording.checked_by_average_face", "scan.landmarks",
    "The scan's landmarks are not known: sides and start were checked against an average face."),
  note("recording.start_unchecked", "motion.rest_s",
    "`hyperex check` does not see whether a camera's recording starts at rest."),
  note("recording.aligned", "alignment.method", "How recording and scan were aligned."),
  note("recording.rescaled", "motion.file",
    "Scan and recording differ in size by more than 3 %: results are in millimetres of the scan."),
  note("recording.jitter_stated", "output.jitter_mm", "The jitter that the scene states."),
  note("recording.jitter", "output.jitter_mm", "The jitter that the recorded points show."),
  note("recording.no_jitter", "output.jitter_mm",
    "The recorded points show no jitter, or the recording is too short to show it."),
  note("head.pose_uncertain", "motion.rigid_points",
    "The head's position is uncertain by 1 to 3 mm (95 %)."),
  note("head.still_points_unused", "motion.rigid_points",
    "The head's pose is that of the face's landmarks, and points beside them are still as those of "
    "the skull: they move against each other by at most 0.2 mm beyond their jitter."),
  note("tissue.matched_by_place", "tissue.per_vertex",
    "Values per vertex are in another order than the scan's vertices and were matched by place."),
  note("tissue.values_averaged", "tissue.per_vertex",
    "Several vertices of a file with different values lie at one vertex of the scan."),
  note("tissue.layers_end", "tissue.layer",
    "The tissue is too thin for its deepest layer under one per cent of the skin or more: the layers "
    "above it end at the inner surface there."),
  note("mesh.unchecked", "mesh.element_size_mm",
    "`hyperex check` makes no mesh of more than 40,000 nodes, nor of a scan of more than 300,000 "
    "vertices: it does not check what a run finds on it."),
  note("support.none", "support.border",
    "Nothing holds the tissue but the driven points."),
  note("drive.chosen", "drive.by", "What drives the face, and why."),
  note("drive.parts_joined", "drive.points",
    "The scene names no driven points, and brows, nostrils or lids move: they are driven too."),
  note("drive.measured_not_driven", "drive.points",
    "The scene names no driven points, and the outline of the face or further points move by 2 mm: "
    "they are not driven. Four of them are named."),
  note("drive.points_left_out", "drive.points",
    "The face model lacks some of the default points."),
  note("teeth.closed", "teeth", "Borders of a scan of teeth were filled."),
  note("teeth.average", "teeth.shape", "Average teeth were laid behind the lips."),
  note("teeth.none", "teeth.shape", "Why no average teeth could be laid behind the lips."),
  note("lips.open_already", "mesh.cut_lips",
    "The lips are open in the scan and were not cut."),
  note("lips.cut", "mesh.cut_lips", "The lips are joined in the scan and were cut."),
  note("mesh.lip_linings_dropped", "mesh",
    "Triangles inside the lips were dropped at the mouth's corners, where they lie on each other."),
  note("mesh.holes_mended", "mesh", "Small holes of the scan were closed in the simulated skin."),
  note("mesh.border_trimmed", "mesh.trim_border_mm",
    "A strip was removed along the border of the simulated skin."),
  note("mesh.folds_smoothed", "mesh", "Folds of the simulated skin were smoothed."),
  note("mesh.folds_dropped", "mesh", "Folds of the simulated skin were removed."),
  note("mesh.folds_given_up", "mesh",
    "Triangles of the simulated skin under which no layer fits were removed."),
  note("mesh.layer_thinned", "mesh",
    "The layer of tissue was turned or thinned where it would have folded."),
  note("solver.reduced_error_small", "solver.method",
    "The reduced model's estimated error stayed above solver.tolerance, but is below 0.05 mm."),
  note("drive.points_off_by_jitter", "drive.points",
    "Driven points end more than 0.1 mm from where they are driven, but no farther than the "
    "recording's jitter moves them."),
  note("drive.points_off_by_gain", "muscles.gain",
    "Driven points end more than 0.1 mm from where they are driven, as a gain of muscles changes "
    "the forces: a result, no fault."),
  note("tissue.few_inverted", "",
    "At most 0.1 % of the tetrahedra are turned inside out in some frame: too few to matter."),
  note("tissue.large_strain", "tissue.strain",
    "At small strain a tetrahedron's greatest principal strain at the peak is above 0.5: "
    "tissue.strain = \"finite\" is for such strains."),
  note("contact.none", "contact", "Contact is switched on, and nothing touches in any frame."),
  note("eyes.closed", "scan.file",
    "The recording has a gaze, and the scan has no opening at an eye: this eye is not seen to "
    "turn."),
  note("gaze.not_ahead_at_rest", "motion.rest_s",
    "The eyes look up or down by 5 degrees or more where the recording is taken for rest. Lids do "
    "not follow that part of the gaze."),
  note("symmetry.no_mesh_floor", "",
    "The run has no mirrored twin, so that the floor of the mesh (docs/symmetry.md) is not known."),
};
// clang-format on

}  // namespace

std::span<const NoteKind> note_kinds() {
  return kKinds;
}

const NoteKind* find_note_kind(std::string_view id) {
  const auto* const found =
      std::ranges::find(kKinds, id, [](const NoteKind& kind) { return std::string_view(kind.id); });
  return found == std::end(kKinds) ? nullptr : found;
}

}  // namespace hyperex
