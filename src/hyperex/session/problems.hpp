// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/option_error.hpp"

namespace hyperex::session {

/// Runs steps that may throw InputError and collects their sentences, so that problems of
/// independent inputs are reported together.
class Problems {
 public:
  template <class Step>
  void attempt(Step step) {
    try {
      step();
    } catch (const motion::OptionError& e) {
      add(e.sentence("motion." + e.option()));
    } catch (const InputError& e) {
      add(e.what());
    }
  }
  void add(const Problems& more) {
    if (!more.text_.empty()) text_ += (text_.empty() ? "" : "\n") + more.text_;
  }
  void throw_if_any() const {
    if (!text_.empty()) throw InputError(text_);
  }

 private:
  void add(const std::string& sentences) { text_ += (text_.empty() ? "" : "\n") + sentences; }

  std::string text_;
};

}  // namespace hyperex::session
