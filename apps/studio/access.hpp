// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Only pages that the studio served itself may talk to it. A page of another origin can neither
// open its socket nor upload; a foreign host name that resolves to this machine (DNS rebinding) is
// refused.
#include <string_view>

namespace hyperex::studio {

/// Whether a Host header names this machine by a loopback name, with the served port.
bool own_host(std::string_view host, unsigned short port);

/// Whether an Origin header is "http://" followed by an own_host(). An empty one is not.
bool own_origin(std::string_view origin, unsigned short port);

}  // namespace hyperex::studio
