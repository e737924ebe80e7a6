// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/core/note.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::session {

/// `recording.one_sided`: the recording shows one corner of the mouth and not the other
/// (metrics::is_recorded()). `recorded`: in the frame of the scan's `landmarks`, m.
std::optional<Note> one_sided_warning(const motion::Motion& recorded,
                                      const io::Landmarks& landmarks);

}  // namespace hyperex::session
