// SPDX-License-Identifier: GPL-3.0-or-later
#include "access.hpp"

#include <string>

namespace hyperex::studio {

bool own_host(std::string_view host, unsigned short port) {
  const std::string at = ":" + std::to_string(port);
  return host == "127.0.0.1" + at || host == "localhost" + at;
}

bool own_origin(std::string_view origin, unsigned short port) {
  static constexpr std::string_view scheme = "http://";
  return origin.substr(0, scheme.size()) == scheme && own_host(origin.substr(scheme.size()), port);
}

}  // namespace hyperex::studio
