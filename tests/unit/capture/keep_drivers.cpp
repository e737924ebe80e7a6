// SPDX-License-Identifier: GPL-3.0-or-later
// For the leak sanitizer. OpenNI2 unloads its drivers when it shuts down; memory in the drivers'
// own tables then counts as leaked and can no longer be attributed to them. The drivers are
// therefore kept loaded.
#include <dlfcn.h>

#include <string>

namespace {

[[maybe_unused]] const bool kept = [] {
  for (const char* name : {"DummyDevice", "OniFile", "PS1080", "PSLink"})
    ::dlopen((OPENNI_DRIVERS "/lib" + std::string(name) + ".so.0").c_str(),
             RTLD_LAZY | RTLD_NODELETE);  // where there is none, there is nothing to keep
  return true;
}();

}  // namespace
