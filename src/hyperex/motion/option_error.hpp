// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/error.hpp"

namespace hyperex::motion {

/// An InputError that an option would mend. Whoever gives the option another name, as files of
/// settings do, says the sentence anew with that name.
class OptionError : public InputError {
 public:
  /// The sentence is BEFORE, OPTION and AFTER one behind the other. `option`: as it is named here.
  OptionError(const std::string& file, std::string before, std::string option, std::string after);

  const std::string& option() const { return option_; }
  std::string sentence(const std::string& option_name) const;

 private:
  std::string file_, before_, option_, after_;
};

}  // namespace hyperex::motion
