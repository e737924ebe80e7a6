// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::face {

/// The landmark that plain words name: "ibug68_48" for "right mouth corner" and for
/// "Mouth_corner_R", "cheek_L" for "left cheek". Words may stand in any order; sides are the
/// subject's own. The iBUG name where there is one. Empty where the words name several points
/// ("lower lip right"), or none.
std::string name_of_words(const std::string& words);

/// Whether a point moves with the mouth or the chin: a landmark of them (`ibug68_4` to 12 and 48 to
/// 67, and anatomical ones such as cheilion_L), or a name with the word lip, lips, chin or mouth.
/// Other names are not judged.
bool moves_with_mouth(const std::string& name);

}  // namespace hyperex::face
