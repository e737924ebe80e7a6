// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/visits/read_visits.hpp"

namespace hyperex::visits {

/// The date at the beginning of a label, with its time where one follows: "2026-03-01" or
/// "2026-03-01T09:30". Empty where the label does not begin with a date of that form.
std::string date_of(const std::string& label);

/// Sorts the visits by their dates where every label begins with one; visits of one date keep their
/// order. Returns a sentence where that changed their order, or where several visits keep the order
/// of the file because a label is no date; else an empty text.
std::string sort_by_date(std::vector<VisitEntry>& visits);

}  // namespace hyperex::visits
