// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/same_face.hpp"

#include "hyperex/scene/keys.hpp"

namespace hyperex::session {

bool makes_the_face(const std::string& key) {
  const std::string section = scene::section_of(key);
  return section == "scan" || section == "mesh" || section == "anatomy" || section == "alignment" ||
         section == "teeth" || (section == "motion" && key != "motion.gain") ||
         key == "time.start_s";
}

bool same_face(const scene::Scene& a, const scene::Scene& b, const std::string& except) {
  for (const scene::Key& key : scene::keys())
    if (key.name != except && makes_the_face(key.name) && key.get(a) != key.get(b)) return false;
  return true;
}

}  // namespace hyperex::session
