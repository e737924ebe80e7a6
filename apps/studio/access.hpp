// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Who may speak to the studio: pages that it served itself. A page of another origin can neither
// open its socket nor upload, and a name that was made to point at this machine (DNS rebinding) is
// not its own.
#include <string_view>

namespace hyperex::studio {

/// The Host header: this machine by its loopback names, and the port that is served.
bool own_host(std::string_view host, unsigned short port);

/// The Origin header: http and own_host(). Empty (none was sent): not the studio's page.
bool own_origin(std::string_view origin, unsigned short port);

}  // namespace hyperex::studio
