// SPDX-License-Identifier: GPL-3.0-or-later
// Passes the library's notes and warnings to Python's logger "hyperex".
#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include "bind.hpp"
#include "hyperex/core/remarks.hpp"

namespace hyperex::python {
namespace {

/// Callable from any thread, which must not hold what a thread with the lock of Python waits for.
void log_to_python(bool warning, const std::string& sentence) {
  if (!Py_IsInitialized()) return;
  const py::gil_scoped_acquire locked;
  try {
    const py::object logger = py::module_::import("logging").attr("getLogger")("hyperex");
    logger.attr(warning ? "warning" : "info")("%s", sentence);
  } catch (py::error_already_set& error) {
    error.discard_as_unraisable("hyperex: a message to the logger");
  }
}

/// The lock of Python is the only one: a second could wait for the first crosswise.
class PythonSink : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    log_to_python(message.level >= spdlog::level::warn,
                  std::string(message.payload.data(), message.payload.size()));
  }
  void flush_() override {}
};

}  // namespace

void bind_log(py::module_&) {
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("hyperex", std::make_shared<PythonSink>()));
  listen_to_remarks([](Remark kind, const std::string& sentence) {
    log_to_python(kind == Remark::warning, sentence);
  });
  // Before the interpreter ends.
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    listen_to_remarks({});
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("nobody"));
  }));
}

}  // namespace hyperex::python
