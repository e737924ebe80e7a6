// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/error.hpp"

namespace hyperex::motion {

/// An InputError that can be resolved by setting an option. A caller that has another name for the
/// option, such as a key of a scene file, writes the sentence again with that name.
class OptionError : public InputError {
 public:
  /// The sentence is BEFORE, OPTION and AFTER, joined. `option`: its name in this library.
  OptionError(const std::string& file, std::string before, std::string option, std::string after);

  const std::string& option() const { return option_; }
  std::string sentence(const std::string& option_name) const;

 private:
  std::string file_, before_, option_, after_;
};

}  // namespace hyperex::motion
