// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

/// Opens those of the descriptors 0 to 2 that are closed, as services and cron may leave them, on
/// /dev/null: a file or pipe that is opened later would get their number, and receive what is
/// meant for the standard streams. First thing in main().
void open_standard_streams();

/// Whether everything that was printed to standard output arrived there; else why not.
struct Printed {
  bool whole = true;
  bool reader_left = false;  ///< as `head` does when it has enough
  std::string why;           ///< "No space left on device"
};

/// Sends what is still buffered (std::cout and stdout). Once, at the end of main().
Printed flush_standard_output();

}  // namespace hyperex
