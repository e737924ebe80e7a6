// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/data.hpp"

#include "hyperex/core/carried_file.hpp"

namespace hyperex::tissue {

HX_CARRIED_FILE(presets_toml, HYPEREX_TISSUE_PRESETS)
HX_CARRIED_FILE(regions_csv, HYPEREX_TISSUE_REGIONS)

}  // namespace hyperex::tissue
