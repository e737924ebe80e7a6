// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

enum class Severity {
  note,    ///< what was assumed, repaired or measured
  warning  ///< probably a mistake, or a result that misleads
};

/// One remark on a run. Callers show `text`; tests and translations refer to `id`.
struct Note {
  std::string id;  ///< stable: "lips.pass_through"
  Severity severity = Severity::note;
  std::string text;  ///< one sentence
  std::string key;   ///< the scene's key that it is about, "muscles.gain"; empty: none
  bool operator==(const Note&) const = default;
};

}  // namespace hyperex
