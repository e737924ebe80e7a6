// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/point_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string_view>

#include "hyperex/face/ibug.hpp"

namespace hyperex::face {
namespace {

struct IbugWords {
  std::string_view words;
  char side = 'M';  ///< L, R, or M: on the midline
};

// Multi-PIE/iBUG order, 0-based: the jaw from the subject's right ear to the left, brows, nose,
// eyes, outer lips, inner lips.
constexpr std::array<IbugWords, 68> ibug_points = {{
    {"outline of the jaw 1 (by the ear)", 'R'},
    {"outline of the jaw 2", 'R'},
    {"outline of the jaw 3", 'R'},
    {"outline of the jaw 4", 'R'},
    {"outline of the jaw 5 (by the angle)", 'R'},
    {"outline of the jaw 6", 'R'},
    {"outline of the jaw 7", 'R'},
    {"outline of the jaw 8 (by the chin)", 'R'},
    {"chin"},
    {"outline of the jaw 8 (by the chin)", 'L'},
    {"outline of the jaw 7", 'L'},
    {"outline of the jaw 6", 'L'},
    {"outline of the jaw 5 (by the angle)", 'L'},
    {"outline of the jaw 4", 'L'},
    {"outline of the jaw 3", 'L'},
    {"outline of the jaw 2", 'L'},
    {"outline of the jaw 1 (by the ear)", 'L'},
    {"outer end of the brow", 'R'},
    {"outer part of the brow", 'R'},
    {"middle of the brow", 'R'},
    {"inner part of the brow", 'R'},
    {"inner end of the brow", 'R'},
    {"inner end of the brow", 'L'},
    {"inner part of the brow", 'L'},
    {"middle of the brow", 'L'},
    {"outer part of the brow", 'L'},
    {"outer end of the brow", 'L'},
    {"root of the nose"},
    {"bridge of the nose, upper part"},
    {"bridge of the nose, lower part"},
    {"tip of the nose"},
    {"outer edge of the nostril", 'R'},
    {"inner edge of the nostril", 'R'},
    {"base of the nose"},
    {"inner edge of the nostril", 'L'},
    {"outer edge of the nostril", 'L'},
    {"outer corner of the eye", 'R'},
    {"outer part of the upper eyelid", 'R'},
    {"inner part of the upper eyelid", 'R'},
    {"inner corner of the eye", 'R'},
    {"inner part of the lower eyelid", 'R'},
    {"outer part of the lower eyelid", 'R'},
    {"inner corner of the eye", 'L'},
    {"inner part of the upper eyelid", 'L'},
    {"outer part of the upper eyelid", 'L'},
    {"outer corner of the eye", 'L'},
    {"outer part of the lower eyelid", 'L'},
    {"inner part of the lower eyelid", 'L'},
    {"corner of the mouth", 'R'},
    {"outer part of the upper lip", 'R'},
    {"peak of the upper lip", 'R'},
    {"middle of the upper lip"},
    {"peak of the upper lip", 'L'},
    {"outer part of the upper lip", 'L'},
    {"corner of the mouth", 'L'},
    {"outer part of the lower lip", 'L'},
    {"inner part of the lower lip", 'L'},
    {"middle of the lower lip"},
    {"inner part of the lower lip", 'R'},
    {"outer part of the lower lip", 'R'},
    {"inner corner of the mouth", 'R'},
    {"edge of the upper lip", 'R'},
    {"edge of the upper lip, middle"},
    {"edge of the upper lip", 'L'},
    {"inner corner of the mouth", 'L'},
    {"edge of the lower lip", 'L'},
    {"edge of the lower lip, middle"},
    {"edge of the lower lip", 'R'},
}};

/// Plain words for anatomical landmarks, without their side.
const std::map<std::string_view, std::string_view> anatomical = {
    {"exocanthion", "outer corner of the eye (exocanthion)"},
    {"endocanthion", "inner corner of the eye (endocanthion)"},
    {"palpebrale_inferius", "lower eyelid (palpebrale inferius)"},
    {"alare", "wing of the nose (alare)"},
    {"cheilion", "corner of the mouth (cheilion)"},
    {"crista_philtri_superior", "philtrum ridge, upper end (crista philtri)"},
    {"crista_philtri_inferior", "philtrum ridge, lower end (crista philtri)"},
    {"cheek", "cheek"},
    {"nasolabial_fold_upper", "fold from nose to mouth, upper end (nasolabial fold)"},
    {"nasolabial_fold_middle", "fold from nose to mouth, middle (nasolabial fold)"},
    {"nasolabial_fold_lower", "fold from nose to mouth, lower end (nasolabial fold)"},
    {"glabella", "between the brows (glabella)"},
    {"nasion", "root of the nose (nasion)"},
    {"pronasale", "tip of the nose (pronasale)"},
    {"subnasale", "base of the nose (subnasale)"},
    {"labiale_superius", "upper lip (labiale superius)"},
    {"stomion", "between the lips (stomion)"},
    {"labiale_inferius", "lower lip (labiale inferius)"},
    {"pogonion", "chin (pogonion)"},
};

std::string plain(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// Without the term in brackets at the end: "corner of the mouth (cheilion)".
std::string_view without_term(std::string_view words) {
  return words.ends_with(')') ? words.substr(0, words.rfind(" (")) : words;
}

std::string with_side(std::string_view words, char side) {
  return std::string(words) + (side == 'L' ? ", left" : side == 'R' ? ", right" : "");
}

struct SidedStem {
  std::string_view stem;
  char side = 'M';
};

SidedStem sided_stem(std::string_view name) {
  const bool sided = name.size() > 2 && (name.ends_with("_L") || name.ends_with("_R"));
  return sided ? SidedStem{name.substr(0, name.size() - 2), name.back()} : SidedStem{name};
}

}  // namespace

std::string name_in_words(const std::string& name, const std::string& more) {
  const SidedStem at = sided_stem(name);
  const auto found = anatomical.find(at.stem);
  std::string inside;
  if (ibug_number(name))
    inside = point_words(name);
  else if (found != anatomical.end())
    inside = with_side(without_term(found->second), at.side);
  if (!more.empty()) inside += (inside.empty() ? "" : "; ") + more;
  return inside.empty() ? name : name + " (" + inside + ")";
}

std::string point_words(const std::string& name) {
  const std::string_view view = name;
  const auto slash = view.find('/');
  if (const auto k = ibug_number(view.substr(0, slash))) {
    const IbugWords& point = ibug_points[std::size_t(*k)];
    return with_side(point.words, slash == view.npos ? point.side : 'M');
  }
  const SidedStem at = sided_stem(view);
  const auto found = anatomical.find(at.stem);
  return found == anatomical.end() ? plain(view) : with_side(found->second, at.side);
}

}  // namespace hyperex::face
