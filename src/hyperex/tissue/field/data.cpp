// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/data.hpp"

__asm__(
    ".pushsection .rodata\n"
    ".global hyperex_tissue_presets_begin\n"
    ".global hyperex_tissue_presets_end\n"
    ".global hyperex_tissue_regions_begin\n"
    ".global hyperex_tissue_regions_end\n"
    "hyperex_tissue_presets_begin:\n"
    ".incbin \"" HYPEREX_TISSUE_PRESETS
    "\"\n"
    "hyperex_tissue_presets_end:\n"
    "hyperex_tissue_regions_begin:\n"
    ".incbin \"" HYPEREX_TISSUE_REGIONS
    "\"\n"
    "hyperex_tissue_regions_end:\n"
    ".byte 0\n"
    ".popsection\n");

extern "C" const char hyperex_tissue_presets_begin[], hyperex_tissue_presets_end[];
extern "C" const char hyperex_tissue_regions_begin[], hyperex_tissue_regions_end[];

namespace hyperex::tissue {

std::string_view presets_toml() {
  return {hyperex_tissue_presets_begin, hyperex_tissue_presets_end};
}

std::string_view regions_csv() {
  return {hyperex_tissue_regions_begin, hyperex_tissue_regions_end};
}

}  // namespace hyperex::tissue
