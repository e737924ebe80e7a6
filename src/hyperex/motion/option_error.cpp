// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/option_error.hpp"

namespace hyperex::motion {

OptionError::OptionError(const std::string& file, std::string before, std::string option,
                         std::string after)
    : InputError(file, before + option + after),
      file_(file),
      before_(std::move(before)),
      option_(std::move(option)),
      after_(std::move(after)) {}

std::string OptionError::sentence(const std::string& option_name) const {
  return InputError(file_, before_ + option_name + after_).what();
}

}  // namespace hyperex::motion
