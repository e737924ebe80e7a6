// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

/// Opens closed descriptors 0 to 2, as services and cron may leave them, on /dev/null. A file or
/// pipe opened later would else get their number and receive the output of the standard streams.
/// Call it first in main().
void open_standard_streams();

/// Whether everything that was printed to standard output arrived there; else why not.
struct Printed {
  bool whole = true;
  bool reader_left = false;  ///< as `head` does after its last line
  std::string why;           ///< "No space left on device"
};

/// Flushes std::cout and stdout. Call it once, at the end of main().
Printed flush_standard_output();

}  // namespace hyperex
