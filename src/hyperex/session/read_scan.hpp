// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

/// The parts of read_inputs() that concern the scan. Notes go into `in`.

/// Sets in.scan. Throws InputError.
void read_scan(const scene::Scene& scene, Inputs& in);

/// `scan.turned_triangles` where triangles of the user's scan are turned inside out.
void note_turned_triangles(const scene::Scene& scene, Inputs& in);

/// The landmarks that the scene names, or the embedded face's; none where it names none. Throws
/// InputError.
io::Landmarks given_landmarks(const scene::Scene& scene);

/// Sets in.landmarks and in.placed, and notes anatomy::flat_warning(). Throws InputError as
/// anatomy::complete_landmarks(), and where half of the face is missing (anatomy::half_missing()).
void complete_landmarks(const scene::Scene& scene, const io::Landmarks& given, const io::Scan& scan,
                        Inputs& in);

/// Reads the files of tissue per vertex, of the scene and of its variants; each note once. Throws
/// InputError; of a wrong file of a variant only with `refuse_variants`.
void note_tissue_files(const scene::Scene& scene, Inputs& in, bool refuse_variants);

}  // namespace hyperex::session
