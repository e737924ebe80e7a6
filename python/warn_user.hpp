// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bind.hpp"
#include "hyperex/core/note.hpp"

namespace hyperex::python {

/// Issues each note as a UserWarning at the caller's line of Python. Python's filters decide how
/// often; by default once a line. May be called without Python's lock.
inline void warn_user(const std::vector<Note>& notes) {
  const py::gil_scoped_acquire python;
  for (const Note& note : notes)
    if (PyErr_WarnEx(PyExc_UserWarning, note.text.c_str(), 1) != 0)
      throw py::error_already_set();  // the user's filters turn warnings into errors
}

}  // namespace hyperex::python
