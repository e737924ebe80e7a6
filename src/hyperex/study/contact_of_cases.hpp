// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/study/study.hpp"

namespace hyperex::study {

/// Where the cases set tissue.strain and one of them has finite strain, in its scene or a variant,
/// lips are kept apart in none of those that do not give contact.lips, as among the variants of one
/// scene: else contact would make a part of what strain seems to make. Such cases get
/// contact.lips=false behind their overrides. Cases that cannot be read stay as they are:
/// plan_cases() says why.
void settle_contact(Study& study);

}  // namespace hyperex::study
