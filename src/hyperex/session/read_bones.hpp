// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/anatomy/bones.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// The bones that [anatomy] names, in the scan's frame; null where it names none. Those of
/// anatomy.ct are laid on the scan with the CT's skin: by common landmarks, then by the surfaces
/// (anatomy::align_to_surface) without lips, brows and lids. Notes state how well they fit.
/// `landmarks`: completed; where they are empty, files are read and nothing else. Throws InputError
/// where a file cannot be read, or the bones do not lie under the skin.
std::shared_ptr<const anatomy::Bones> read_bones(const scene::Scene& scene, const io::Scan& scan,
                                                 const io::Landmarks& landmarks,
                                                 std::vector<Note>& notes);

}  // namespace hyperex::session
