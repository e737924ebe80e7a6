// SPDX-License-Identifier: GPL-3.0-or-later
// A face as it is, and the same pull in other tissue:
//   what_if SCENE.toml KEY VALUE OUT.glb    or    what_if SCAN MOTION KEY VALUE OUT.glb
#include <cstdio>
#include <cstdlib>
#include <hyperex/hyperex.hpp>

using namespace hyperex;

int main(int argc, char** argv) try {
  if (argc != 5 && argc != 6) {
    std::fprintf(stderr, "what_if SCENE.toml|SCAN MOTION KEY VALUE OUT.glb\n");
    return 2;
  }
  FaceSession face =
      argc == 6 ? FaceSession(read_face(argv[1]), read_motion(argv[2])) : FaceSession(argv[1]);
  const auto before = face.run();
  face.set(argv[argc - 3], std::atof(argv[argc - 2]));  // where forces drive, they are kept
  const auto after = face.run();
  write_glb(argv[argc - 1], after);
  for (const auto& result : {before, after})
    for (const auto& pair : result.measures().excursions.pairs)
      if (pair.name == "cheilion")
        std::printf("%s: corners of the mouth left %.2f mm, right %.2f mm\n", result.name.c_str(),
                    pair.left_side.excursion_mm, pair.right_side.excursion_mm);
  for (const Note& warning : face.warnings()) std::fprintf(stderr, "%s\n", warning.text.c_str());
} catch (const InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
