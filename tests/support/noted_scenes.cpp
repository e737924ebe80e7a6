// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/noted_scenes.hpp"

#include <algorithm>
#include <sstream>

#include "apps/good_inputs.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/capture/video_writer.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/scan.hpp"
#include "support/rendered_clip.hpp"

namespace hyperex::test {
namespace {
namespace fs = std::filesystem;

void write_landmarks(const fs::path& folder, const io::Landmarks& landmarks) {
  io::write_landmarks(folder / "face_landmarks.json", landmarks, io::LengthUnit::millimetre);
}

void misplace_a_landmark(const fs::path& folder) {
  io::Landmarks landmarks = good_landmarks();
  landmarks["cheilion_R"] = landmarks["cheek_R"];
  write_landmarks(folder, landmarks);
}

void shift_all_landmarks(const fs::path& folder) {
  io::Landmarks landmarks = good_landmarks();
  for (auto& [name, at] : landmarks) at.z() += 0.01;
  write_landmarks(folder, landmarks);
}

void misspell_a_landmark(const fs::path& folder) {
  io::Landmarks landmarks = good_landmarks();
  landmarks["cheilon_L"] = landmarks["cheilion_L"];
  landmarks.erase("cheilion_L");
  write_landmarks(folder, landmarks);
}

void write_video(const fs::path& folder) {
  RenderedClip clip;
  capture::VideoWriter writer(folder / "clip.mp4", clip.intrinsics().width_px,
                              clip.intrinsics().height_px, 30);
  for (int k = 0; k < 3; ++k) writer.add(clip.next()->colour);
  writer.finish();
}

void time_in_milliseconds(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 1000;
  });
}

void time_at_3_hz(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (double& t : m.time_s) t *= 10;
  });
}

void keep_four_samples(const fs::path& folder) {
  write_opening(folder, 0, 4);
}

void hold_still(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (Points& sample : m.positions) sample = m.positions.front();
    m.positions[8](m.index_of("cheilion_L"), 1) += 0.03e-3;
  });
}

void let_a_marker_jump(const fs::path& folder) {
  write_opening(folder, 0, 16,
                [](motion::Motion& m) { m.positions[8](m.index_of("cheilion_L"), 2) += 0.3; });
}

void let_a_marker_stay_away(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (std::size_t k = 8; k < 15; ++k) m.positions[k](m.index_of("cheilion_L"), 2) += 0.03;
  });
}

/// Two readings that the system did not see.
void lose_a_marker(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (std::size_t k = 8; k < 10; ++k) m.positions[k].row(m.index_of("cheilion_L")).setZero();
  });
}

/// Ten samples a second.
void let_a_marker_jump_slowly(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (double& time_s : m.time_s) time_s *= 3;
    m.positions[8](m.index_of("cheilion_L"), 2) += 0.05;
  });
}

/// Half a second in which the mouth opens.
void lose_a_marker_and_hold_it(const fs::path& folder) {
  write_opening(folder, 0, 41, [](motion::Motion& m) {
    const int lip = m.index_of(face::ibug(57));
    for (std::size_t k = 16; k <= 31; ++k) m.positions[k].row(lip) = m.positions[15].row(lip);
  });
}

/// Ten samples a second; whether it comes back is not seen.
void let_a_marker_jump_in_the_end(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (double& time_s : m.time_s) time_s *= 3;
    m.positions[15](m.index_of("cheilion_L"), 2) += 0.03;
  });
}

void let_a_marker_drift(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      m.positions[k](m.index_of("cheilion_L"), 2) += 0.05 * double(k) / 15;
  });
}

void start_with_the_mouth_open(const fs::path& folder) {
  write_opening(folder, 40, 41);
}

void end_with_the_mouth_half_open(const fs::path& folder) {
  write_opening(folder, 0, 22);
}

void open_wide(const fs::path& folder) {
  write_opening(folder, 0, 81);
}

/// The right brow's outer end rises by 20 mm while the mouth opens.
void raise_a_brow(const fs::path& folder) {
  write_opening(folder, 0, 81, [](motion::Motion& m) {
    const int brow = m.index_of("ibug68_17");
    for (std::size_t k = 0; k < m.positions.size(); ++k)
      m.positions[k](brow, 1) += 0.020 * double(k) / 80;
  });
}

/// A smile, a shape that the canonical face lacks, and a column with a misspelt name.
void write_weights(const fs::path& folder) {
  std::ostringstream table;
  table << "time_s,mouthSmileLeft,tongueOut,mouthSmilRight\n";
  for (int k = 0; k < 16; ++k)
    table << k / 30.0 << ',' << k / 15.0 << ',' << std::min(0.6, 0.15 * k) << ',' << k / 15.0
          << '\n';
  put(folder / "weights.csv", table.str());
}

void lose_a_column(const fs::path& folder) {
  std::ostringstream table;
  table << "time_s,eyeBlinkLeft,eyeBlinkRight,mouthSmileRight\n";
  for (int k = 0; k < 16; ++k) table << k / 30.0 << ",0,0," << k / 15.0 << '\n';
  put(folder / "lost.csv", table.str());
}

/// A slow smile at 30 Hz whose weight is wrong in one sample.
void write_smile_with_a_spike(const fs::path& folder, int wrong) {
  std::ostringstream table;
  table << "time_s,mouthSmileLeft,mouthSmileRight\n";
  for (int k = 0; k < 16; ++k)
    table << k / 30.0 << ',' << (k == wrong ? 1 : k / 50.0) << ',' << k / 50.0 << '\n';
  put(folder / "spike.csv", table.str());
}

void let_a_weight_jump(const fs::path& folder) {
  write_smile_with_a_spike(folder, 8);
}

void end_with_a_weight_that_jumps(const fs::path& folder) {
  write_smile_with_a_spike(folder, 15);
}

void enlarge_the_motion(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (Points& sample : m.positions) sample *= 1.5;
  });
}

void lose_a_corner(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    leave_out(m, {"cheilion_R", face::ibug(48), face::ibug(60)});
  });
}

void displace_a_marker(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    for (Points& sample : m.positions) sample(m.index_of(face::ibug(54)), 1) += 0.02;
  });
}

/// Each corner lies beyond the middle: 0.6 of the way to the other.
void exchange_the_corners(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    const int left = m.index_of("cheilion_L"), right = m.index_of("cheilion_R");
    for (Points& sample : m.positions) {
      const Eigen::RowVector3d way = 0.6 * (sample.row(right) - sample.row(left));
      sample.row(left) += way;
      sample.row(right) -= way;
    }
  });
}

/// The lower lip rises by 6 mm, the upper one stays.
void press_the_lips(const fs::path& folder) {
  write_opening(folder, 0, 16, [](motion::Motion& m) {
    const Points rest = m.positions.front();
    for (std::size_t k = 0; k < m.positions.size(); ++k) {
      m.positions[k] = rest;
      for (const int i : {55, 56, 57, 58, 59, 65, 66, 67})
        if (const int row = m.index_of(face::ibug(i)); row >= 0)
          m.positions[k](row, 1) += 6e-3 * double(k) / 15;
    }
  });
}

/// The face itself, `behind_m` behind the skin: a bone without a shape.
TriMesh mask(double behind_m) {
  TriMesh out = anatomy::embedded_face().mesh;
  out.points.col(2).array() -= behind_m;
  return out;
}

void write_skull(const fs::path& folder) {
  io::write_ply(folder / "skull.ply", mask(0.008), io::LengthUnit::millimetre);
}

void write_skull_and_mandible(const fs::path& folder) {
  write_skull(folder);
  io::write_ply(folder / "mandible.ply", mask(0.01), io::LengthUnit::millimetre);
}

/// A part of it lies in front of the skin.
void write_skull_that_sticks_out(const fs::path& folder) {
  TriMesh skull = mask(0.008);
  const Vec3 nose = good_landmarks().at(face::ibug(30));
  for (Eigen::Index v = 0; v < skull.points.rows(); ++v)
    if ((skull.points.row(v).transpose() - nose).norm() < 0.018) skull.points(v, 2) += 0.014;
  io::write_ply(folder / "skull.ply", skull, io::LengthUnit::millimetre);
}

void write_ct_of_another_face(const fs::path& folder) {
  write_skull(folder);
  TriMesh skin = mask(0);
  skin.points.col(0) *= 1.4;
  io::write_ply(folder / "skin.ply", skin, io::LengthUnit::millimetre);
  io::Landmarks landmarks;
  for (const char* name : {"pronasale", "subnasale", "nasion", "pogonion"})
    landmarks[name] = anatomy::embedded_face().landmarks.at(name);
  io::write_landmarks(folder / "landmarks.json", landmarks, io::LengthUnit::millimetre);
}

}  // namespace

const std::vector<NotedScene>& noted_scenes() {
  static const std::vector<NotedScene> all = {
      {"landmarks.doubtful", true, "", misplace_a_landmark},
      {"landmarks.many_doubtful", true, "", shift_all_landmarks},
      {"landmarks.misspelt", true, "", misspell_a_landmark},
      {"recording.mirror_unknown", true, "motion.file=\nmotion.recording=\"clip.mp4\"",
       write_video},
      {"recording.time_unit_doubtful", true, "", time_in_milliseconds},
      {"recording.one_sided", true, "drive.points=\"all\"", lose_a_corner},
      {"recording.coarse", true, "", time_at_3_hz},
      {"recording.short", true, "", keep_four_samples},
      {"recording.wild_samples", true, "", let_a_marker_jump},
      {"recording.jumps", true, "", let_a_marker_stay_away},
      {"recording.zeros", true, "", lose_a_marker},
      {"recording.lone_samples", true, "", let_a_marker_jump_slowly},
      {"recording.held_points", true, "", lose_a_marker_and_hold_it},
      {"recording.end_samples", true, "", let_a_marker_jump_in_the_end},
      {"recording.far_points", true, "", let_a_marker_drift},
      {"recording.wild_weights", true, "motion.file=\nmotion.arkit=\"spike.csv\"",
       let_a_weight_jump},
      {"recording.weight_jumps", true, "motion.file=\nmotion.arkit=\"spike.csv\"",
       end_with_a_weight_that_jumps},
      {"recording.nothing_moves", true, "", hold_still},
      {"recording.starts_in_expression", true, "", start_with_the_mouth_open},
      {"recording.ends_in_expression", true, "", end_with_the_mouth_half_open},
      {"recording.column_misspelt", true, "motion.file=\nmotion.arkit=\"weights.csv\"",
       write_weights},
      {"recording.side_missing", true, "motion.file=\nmotion.arkit=\"lost.csv\"", lose_a_column},
      {"recording.shapes_lost", true, "motion.file=\nmotion.arkit=\"weights.csv\"", write_weights},
      {"recording.fits_badly", true, "", enlarge_the_motion},
      {"recording.point_off", true, "", displace_a_marker},
      {"time.beyond_recording", true, "time.end_s=2", nullptr},
      {"sides.exchanged_pair", true, "", exchange_the_corners},
      {"anatomy.no_mandible", true, "anatomy.skull=\"skull.ply\"\nanatomy.unit=\"mm\"",
       write_skull},
      {"anatomy.no_condyles", true,
       "anatomy.skull=\"skull.ply\"\nanatomy.mandible=\"mandible.ply\"\nanatomy.unit=\"mm\"",
       write_skull_and_mandible},
      {"anatomy.bone_outside", true, "anatomy.skull=\"skull.ply\"\nanatomy.unit=\"mm\"",
       write_skull_that_sticks_out},
      {"anatomy.ct_fits_badly", true, "anatomy.ct=\".\"", write_ct_of_another_face},
      {"head.pose_unknown", true,
       "motion.rigid_points=[\"ibug68_17\", \"ibug68_26\", \"ibug68_29\"]", raise_a_brow},
      {"head.points_not_rigid", true,
       "motion.rigid_points=[\"ibug68_27\", \"ibug68_36\", \"ibug68_45\", \"ibug68_57\"]",
       open_wide},
      {"law.idle", true, "tissue.law=\"yeoh\"", nullptr},
      {"region.idle", false, "region.blend_mm=1", nullptr},
      {"support.idle", false, "drive.by=\"muscles\"\nsupport.field_kpa_per_mm=5", nullptr},
      {"keys.idle", false, "tissue.strain=\"finite\"\ntissue.yeoh_c20=1\ndrive.by=\"displacement\"",
       nullptr},
      {"drive.by_key", false, "support.field_kpa_per_mm=5", nullptr},
      {"skin.far_from_scan", false, "mesh.element_size_mm=15", nullptr},
      {"lips.pass_through", false,
       "drive.by=\"displacement\"\nmotion.gain=5\ncontact.lips=false\ntime.end_s=0.5",
       press_the_lips},
      {"tissue.inverted", false, "drive.by=\"displacement\"\nmotion.gain=5\ntime.end_s=0.5",
       press_the_lips},
      {"tissue.volume_changed", false,
       "drive.by=\"displacement\"\nmotion.gain=4\ntissue.strain=\"finite\"\ntime.end_s=0.5",
       press_the_lips},
      {"contact.no_equilibrium", false,
       "drive.by=\"displacement\"\nmotion.gain=5\ntissue.strain=\"finite\"\ncontact.lips=true\n"
       "mesh.layers=2\ntime.end_s=0.5",
       press_the_lips},
      {"drive.points_off", false, "drive.points=\"all\"\ntime.end_s=0.5", press_the_lips},
      {"output.glb_coarse", false,
       "output.glb=true\noutput.glb_tolerance_mm=0.01\noutput.glb_max_mb=0.1\ntime.end_s=0.5\n"
       "time.frame_rate_hz=60",
       nullptr},
      {"variant.no_effect", false,
       "drive.by=\"displacement\"\nvariant=[{name=\"same\", tissue={young_kpa=100}}]\n"
       "tissue.young_kpa=100",
       nullptr},
      {"variant.lips_pass_through", false,
       "drive.by=\"displacement\"\nmotion.gain=0.05\ncontact.lips=false\ntime.end_s=0.5\n"
       "variant=[{name=\"more\", motion={gain=5}}]",
       press_the_lips},
      {"muscles.gain_hardly_used", false, "muscles.gain={corrugator_L=0.3}", nullptr},
      {"variant.muscle_hardly_used", false,
       "variant=[{name=\"weak\", muscles={gain={corrugator_L=0.3}}}]", nullptr},
  };
  return all;
}

const std::map<std::string, std::string>& warnings_without_scene() {
  static const std::map<std::string, std::string> all = {
      {"forces.found_anew", "FaceSession.OtherScenesOfTheFaceGiveWhatAFreshSessionGives"},
      {"sides.doubtful", "CheckAlone.SidesThatAreExchangedLessSurelyAreAWarning"},
      {"recording.size_implausible", "CheckAlone.ASizeThatNoFaceHasIsNamedWithItsUnit"},
      {"scan.turned_triangles", "InputNotes.NameAScanWhoseTrianglesAreTurned"},
      {"scan.flat", "InputNotes.NameAScanWithoutDepth"},
      {"solver.reduced_not_converged", "ReducedError.IsAWarningWhereItMattersAndElseANote"},
      {"symmetry.plane_of_landmarks", "SymmetryNotes.SayWhyThePlaneIsTheLandmarks"},
      {"rig.lid_doubtful", "LidDoubts.NameAShapeThatMovesALidFartherThanItsLandmarks"},
      {"variant.left_out", "StudioSessionWithWrongVariants.OpensAllElseAndSaysWhatIsLeftOut"},
  };
  return all;
}

fs::path write_noted_scene(const NotedScene& scene, const fs::path& folder) {
  fs::create_directories(folder);
  write_good_inputs(folder);
  if (scene.spoil) scene.spoil(folder);
  std::map<std::string, std::string> keys = {{"scan.file", "\"face.ply\""},
                                             {"scan.unit", "\"mm\""},
                                             {"scan.landmarks", "\"face_landmarks.json\""},
                                             {"motion.file", "\"motion.csv\""},
                                             {"mesh.element_size_mm", "8"},
                                             {"mesh.layers", "1"},
                                             {"time.step_s", "0.01"},
                                             {"time.end_s", "0.2"},
                                             {"time.frame_rate_hz", "10"},
                                             {"output.vtu", "false"},
                                             {"output.glb", "false"},
                                             {"output.report", "false"}};
  std::istringstream lines(scene.keys);
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find('=');
    keys[line.substr(0, at)] = line.substr(at + 1);
  }
  std::string text;
  for (const auto& [key, value] : keys)
    if (!value.empty()) text += key + " = " + value + "\n";
  put(folder / "scene.toml", text);
  return folder / "scene.toml";
}

}  // namespace hyperex::test
