// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

namespace hyperex::session {

/// What to say of a recording whose lengths are as if in another unit than the one it was read in:
/// mm, cm, m or inches. `ratio`: its size over the expected one, above 0. `unit_note`:
/// Motion::unit_note, "mm (as the columns say)". `sizes_differ`: how far the ratio may be from that
/// of the unit, as a factor of 1 or more. `correct`: what to do about a unit that a recording may
/// have, "correct the unit there". Nothing where no other unit fits, or where the unit that was
/// read is not known.
std::optional<std::string> unit_that_fits(double ratio, const std::string& unit_note,
                                          double sizes_differ, const std::string& correct);

}  // namespace hyperex::session
