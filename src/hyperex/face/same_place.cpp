// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/same_place.hpp"

#include <map>

#include "hyperex/face/ibug.hpp"

namespace hyperex::face {

std::string other_name(const std::string& name) {
  static const std::map<std::string, std::string> both = [] {
    std::map<std::string, std::string> table;
    for (const auto& [anatomical, k] : {std::pair{"exocanthion_R", 36},
                                        {"exocanthion_L", 45},
                                        {"endocanthion_R", 39},
                                        {"endocanthion_L", 42},
                                        {"pronasale", 30},
                                        {"subnasale", 33},
                                        {"cheilion_R", 48},
                                        {"cheilion_L", 54},
                                        {"crista_philtri_inferior_R", 50},
                                        {"crista_philtri_inferior_L", 52},
                                        {"labiale_superius", 51},
                                        {"labiale_inferius", 57}}) {
      table[anatomical] = ibug(k);
      table[ibug(k)] = anatomical;
    }
    return table;
  }();
  const auto found = both.find(name);
  return found == both.end() ? std::string() : found->second;
}

bool same_place(const std::string& a, const std::string& b) {
  return !b.empty() && other_name(a) == b;
}

std::optional<int> ibug_number_of_place(const std::string& name) {
  const std::optional<int> own = ibug_number(full_name(name));
  return own ? own : ibug_number(other_name(name));
}

std::string place_name(const std::string& name) {
  const std::optional<int> number = ibug_number_of_place(name);
  return number ? ibug(*number) : name;
}

std::optional<Vec3> find_place(const io::Landmarks& landmarks, const std::string& name) {
  for (const std::string& either : {name, other_name(name)})
    if (const auto found = landmarks.find(either);
        found != landmarks.end() && found->second.allFinite())
      return found->second;
  return std::nullopt;
}

}  // namespace hyperex::face
