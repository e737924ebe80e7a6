// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/itk_library.hpp"

#include "hyperex/core/late_library.hpp"

namespace hyperex::ct {

const ItkLibrary& itk_library() {
  using Give = const ItkLibrary*();
  static const ItkLibrary* const library = reinterpret_cast<Give*>(load_late_library(
      "hx_itk.so", "hyperex_itk", "install ITK 5.2 and build again (make build)"))();
  return *library;
}

}  // namespace hyperex::ct
