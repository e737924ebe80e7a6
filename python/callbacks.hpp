// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <exception>

#include "bind.hpp"
#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::python {

/// Calls Python back from a run. What a callback throws ends the run and is thrown by finish().
class Callbacks {
 public:
  Callbacks(py::object progress, py::object cancelled)
      : progress_(std::move(progress)), cancelled_(std::move(cancelled)) {}

  simulate::RunCallbacks for_run() {
    simulate::RunCallbacks callbacks;
    if (!progress_.is_none())
      callbacks.progress = [this](double share) {
        const py::gil_scoped_acquire locked;
        guarded([&] { progress_(share); });
      };
    callbacks.cancelled = [this] { return must_end(); };
    return callbacks;
  }
  void rethrow_if_any() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  /// Python is called every 20 ms at most, since a step takes less than a millisecond.
  bool must_end() {
    if (thrown_) return true;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_call_) return false;
    next_call_ = now + std::chrono::milliseconds(20);
    bool end = false;
    const py::gil_scoped_acquire locked;
    guarded([&] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      end = !cancelled_.is_none() && cancelled_().cast<bool>();
    });
    return end || thrown_;
  }
  template <class Call>
  void guarded(Call call) {
    if (thrown_) return;
    try {
      call();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }

  py::object progress_, cancelled_;
  std::exception_ptr thrown_;
  std::chrono::steady_clock::time_point next_call_{};
};

}  // namespace hyperex::python
