// SPDX-License-Identifier: GPL-3.0-or-later
// Three people of a rig with known answers, driven as the program chooses by itself. Their skin is
// moved by the rig's own shapes, and so is known at every vertex. Held to bounds are the error of
// the lips over that of a warp, that of the face over those of the warp and of displacement, the
// roughness of the skin, the groove between nose and mouth, and how deep the lips lie in each
// other. The shapes of real faces were made from the same rig: so this shows what breaks, not how
// good the program is. The data are not part of the repository; where they are absent the tests are
// skipped.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/core/files.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/metrics/baseline.hpp"
#include "hyperex/metrics/fold_depth.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/roughness.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/simulate/contact/lip_surfaces.hpp"

namespace hyperex {
namespace {

/// Weights of the rig's expression shapes by name. "mouthSmile" sets both mouthSmile_L and
/// mouthSmile_R, since the rig has no shape "mouthSmile".
using RigWeights = std::map<std::string, double>;

std::filesystem::path rig_data(const std::string& file) {
  return std::filesystem::path(HYPEREX_SHARED_DIR) / "data/ict" / file;
}

/// The rig of one person, metres. The shapes were made for A; they are added to all people's
/// points.
struct PersonRig {
  TriMesh mesh;
  std::vector<io::MorphShape> shapes;
  std::vector<int> landmarks;  ///< vertices of ibug68_0 to 67

  Points moved(const RigWeights& weights) const {
    Points sum = Points::Zero(mesh.points.rows(), 3);
    for (const auto& [name, weight] : weights) {
      int found = 0;
      for (const io::MorphShape& shape : shapes)
        if (shape.name == name || shape.name == name + "_L" || shape.name == name + "_R") {
          sum += weight * shape.displacement_m.cast<double>();
          ++found;
        }
      if (found == 0) throw std::runtime_error("the rig has no shape " + name);
    }
    return sum;
  }
};

PersonRig read_person_rig(const std::string& person) {
  const auto file = rig_data("subject_A_rig.glb");
  io::ShapedMesh read = io::read_gltf_shapes(file);
  PersonRig rig{std::move(read.mesh), std::move(read.shapes), {}};
  const std::string bytes = read_file(file);
  std::size_t length = 0;  // of the text, four bytes from the 13th on
  for (std::size_t k = 0; k < 4; ++k) length |= std::size_t(std::uint8_t(bytes[12 + k])) << 8 * k;
  rig.landmarks = nlohmann::json::parse(bytes.substr(20, length))
                      .at("meshes")
                      .at(0)
                      .at("extras")
                      .at("landmarks68")
                      .get<std::vector<int>>();
  if (person != "A") {
    const Points own =
        io::read_mesh(rig_data("subject_" + person + "_rig_neutral.ply"), io::LengthUnit::metre)
            .points;
    if (own.rows() != rig.mesh.points.rows())
      throw std::runtime_error("the rig of " + person + " has other vertices than that of A");
    rig.mesh.points = own;
  }
  return rig;
}

/// Transfers a motion of the rig to the vertices of a scan. Lips that touch at rest are apart in
/// the opened mouth, so that each vertex takes the motion of its own lip.
class RigToScan {
 public:
  RigToScan(const PersonRig& rig, const Points& scan, const Points& scan_opened)
      : triangles_(rig.mesh.triangles) {
    const Points opening = rig.moved({{"jawOpen", 0.75}});
    const Points opened = rig.mesh.points + opening;
    places_ = SurfaceTree(rig.mesh).query_all(scan);
    const auto other = SurfaceTree({opened, triangles_}).query_all(scan_opened);
    off_m_.resize(scan.rows());
    for (Eigen::Index v = 0; v < scan.rows(); ++v) {
      const auto off = [&](const ClosestPoint& place) {
        const Vec3 at = at_place(rig.mesh.points, place), by = at_place(opening, place);
        return (at - scan.row(v).transpose()).norm() +
               (scan.row(v).transpose() + by - scan_opened.row(v).transpose()).norm();
      };
      ClosestPoint& place = places_[std::size_t(v)];
      if (off(other[std::size_t(v)]) < off(place)) place = other[std::size_t(v)];
      off_m_[v] = off(place);
    }
  }

  Points carried(const Points& rig_motion) const {
    Points out(Eigen::Index(places_.size()), 3);
    for (std::size_t v = 0; v < places_.size(); ++v)
      out.row(Eigen::Index(v)) = at_place(rig_motion, places_[v]).transpose();
    return out;
  }
  /// How far each vertex is from the rig, at rest and opened together, m.
  const Eigen::VectorXd& off_m() const { return off_m_; }

 private:
  Vec3 at_place(const Points& of_rig, const ClosestPoint& place) const {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      sum += place.weights[k] * of_rig.row(triangles_(place.triangle, k)).transpose();
    return sum;
  }

  Triangles triangles_;
  std::vector<ClosestPoint> places_;
  Eigen::VectorXd off_m_;
};

/// Vertices of the forehead and beside the bridge of the nose, which stand still in the recording.
std::vector<int> still_vertices(const PersonRig& rig) {
  const Vec3 bridge = rig.mesh.points.row(rig.landmarks[27]).transpose();
  std::vector<char> of_skin(std::size_t(rig.mesh.points.rows()), 0);
  for (const int v : rig.mesh.triangles.reshaped()) of_skin[std::size_t(v)] = 1;
  std::vector<int> found;
  for (const auto& [x_mm, y_mm] :
       {std::pair{-45, 30}, {45, 30}, {0, 45}, {-60, -10}, {60, -10}, {0, 30}}) {
    const Eigen::Vector2d wanted = bridge.head<2>() + 1e-3 * Eigen::Vector2d(x_mm, y_mm);
    int best = -1;
    double least = 1;
    for (Eigen::Index v = 0; v < rig.mesh.points.rows(); ++v) {
      if (!of_skin[std::size_t(v)] || rig.mesh.points(v, 2) < bridge.z() - 0.08) continue;
      const double far = (rig.mesh.points.row(v).head<2>().transpose() - wanted).norm();
      if (far < least) least = far, best = int(v);
    }
    found.push_back(best);
  }
  return found;
}

/// A second from rest to the full motion, of the 68 landmarks and the still points.
motion::Motion ramp_of(const PersonRig& rig, const Points& moved) {
  const std::vector<int> still = still_vertices(rig);
  motion::Motion ramp;
  for (int k = 0; k < 68; ++k) ramp.names.push_back("ibug68_" + std::to_string(k));
  for (std::size_t k = 0; k < still.size(); ++k)
    ramp.names.push_back("head_" + std::to_string(k + 1));
  for (int i = 0; i <= 30; ++i) {
    Points now(Eigen::Index(ramp.names.size()), 3);
    for (int k = 0; k < 68; ++k) {
      const int v = rig.landmarks[std::size_t(k)];
      now.row(k) = rig.mesh.points.row(v) + i / 30.0 * moved.row(v);
    }
    for (std::size_t k = 0; k < still.size(); ++k)
      now.row(68 + Eigen::Index(k)) = rig.mesh.points.row(still[k]);
    ramp.time_s.push_back(i / 30.0);
    ramp.positions.push_back(now);
  }
  return ramp;
}

struct RigRun {
  const char *name, *person;
  RigWeights weights;
  bool all_points;
  double lips;           ///< bound on the mean error of the lips over that of the warp
  double corners = 1.3;  ///< bound on the roughness beside the corners over that of the truth
};

/// Frame 46 of the recording of talking, weights above 0.01.
const RigWeights kTalk46 = {{"browDown", 0.134136},
                            {"cheekSquint", 0.526522},
                            {"eyeBlink", 0.389828},
                            {"eyeSquint", 0.496817},
                            {"jawOpen", 1},
                            {"mouthDimple", 0.0574962},
                            {"mouthFrown", 0.765046},
                            {"mouthLowerDown", 0.74875},
                            {"mouthShrugLower", 0.916736},
                            {"mouthSmile", 0.388452},
                            {"mouthUpperUp", 0.159356}};
const RigWeights kJawOpen = {{"jawOpen", 0.75}}, kOneSmile = {{"mouthSmile_L", 0.9}},
                 kSmileCheeks = {{"mouthSmile", 0.8}, {"cheekSquint", 0.6}, {"cheekRaiser", 0.6}},
                 kPress = {{"mouthPress", 0.8}};

/// The bounds lie 0.08 above what docs/muscles.md has for the tissue alone. Seven points tell a
/// shrugged lower lip, a dimple and puffed cheeks from other shapes too badly for the rules on the
/// whole face (kWorseThanDisplacement, kWorseThanWarp). docs/muscles.md says by how much these
/// motions miss them, so that they are not among the runs.
const RigRun kRigRuns[] = {
    {"AOfJawOpenSeven", "A", kJawOpen, false, 0.42},
    {"AOfOneSmileSeven", "A", kOneSmile, false, 0.94},
    {"AOfTalkSeven", "A", kTalk46, false, 0.43},
    {"DOfJawOpenSeven", "D", kJawOpen, false, 0.40},
    {"DOfOneSmileSeven", "D", kOneSmile, false, 0.97},
    {"DOfSmileCheeksSeven", "D", kSmileCheeks, false, 0.86},
    // Above one corner the skin keeps a crease. It is 1.36 times as rough as the truth (0.04 mm
    // more).
    {"DOfJawOpenAll", "D", kJawOpen, true, 0.31, 1.4},
    {"EOfJawOpenSeven", "E", kJawOpen, false, 0.48},
    {"EOfOneSmileSeven", "E", kOneSmile, false, 1.00},
    {"EOfSmileCheeksAll", "E", kSmileCheeks, true, 0.81},
};

/// The person's face in memory, driven by the seven points or by all, as the program chooses.
session::FaceSession session_of_rig(const RigRun& run, const PersonRig& rig, const Points& moved,
                                    bool contact = false) {
  std::vector<std::string> driven;
  for (int k = 0; k < 68; ++k)
    if (run.all_points || std::ranges::count(metrics::driven_ibug_points(), k) > 0)
      driven.push_back("ibug68_" + std::to_string(k));
  const std::string base = std::string("subject_") + run.person;
  session::Face face{
      io::read_scan(rig_data(base + "_neutral_scan.ply"), io::LengthUnit::millimetre),
      io::read_landmarks(rig_data(base + "_landmarks.json"))};
  return session::FaceSession(
      std::move(face), ramp_of(rig, moved),
      {{"motion.rigid_points", {"head_1", "head_2", "head_3", "head_4", "head_5", "head_6"}},
       {"drive.points", driven},
       {"time.end_s", 1.2},
       {"contact.lips", contact},
       {"output.peak_time_s", 1.2}},
      {.certainty = session::Certainty::on_request});
}

/// Skin as rough as the truth within a factor. Roughness below 30 µm is not seen.
void expect_no_crumpling(const TriMesh& skin, const PointsF& own, const PointsF& truth,
                         const io::Landmarks& landmarks, double corners) {
  const std::map<std::string, double> factors = {
      {"brows", 1.3}, {"forehead", 1.3}, {"corners", corners}};
  std::map<std::string, double> true_mm;
  for (const auto& part :
       metrics::roughness_by_part(metrics::roughness(skin, truth), skin.points, landmarks))
    true_mm[part.part] = part.rms_mm;
  std::size_t judged = 0;
  for (const auto& part :
       metrics::roughness_by_part(metrics::roughness(skin, own), skin.points, landmarks)) {
    const auto factor = factors.find(part.part);
    if (factor == factors.end()) continue;
    ++judged;
    if (part.rms_mm > 0.03) {
      EXPECT_LE(part.rms_mm, factor->second * true_mm.at(part.part)) << part.part;
    }
  }
  EXPECT_EQ(judged, factors.size());
}

/// Mean depth of the groove between nose and mouth, mm: both sides, cuts at 0.3 and 0.5 of the way.
/// At 0.7 they cross the corner of the mouth of these faces. `moved`: where the scan's vertices
/// are.
double rig_groove_mm(const TriMesh& scan, const Points& moved, const io::Landmarks& landmarks) {
  io::Landmarks now;
  for (const auto& [name, place] : landmarks) {
    Eigen::Index nearest = 0;
    (scan.points.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    now[name] = place + (moved.row(nearest) - scan.points.row(nearest)).transpose();
  }
  double sum_mm = 0;
  for (const bool left : {false, true}) {
    const auto cuts = metrics::fold_cuts({moved, scan.triangles}, now, left);
    sum_mm += cuts[0].depth_mm + cuts[1].depth_mm;
  }
  return sum_mm / 4;
}

/// An opening jaw makes no groove of its own, and a smile with raised cheeks a true one.
void expect_true_groove(const RigRun& run, double own_mm, double true_mm) {
  testing::Test::RecordProperty("groove_mm", std::to_string(own_mm));
  testing::Test::RecordProperty("true_groove_mm", std::to_string(true_mm));
  if (run.weights == kJawOpen) {
    EXPECT_LE(own_mm, true_mm + 0.5);
  }
  if (run.weights == kSmileCheeks) {
    EXPECT_NEAR(own_mm, true_mm, 0.7);
  }
}

/// The default may be worse than the other drive by this factor, over the face.
constexpr double kWorseThanDisplacement = 1.03;
/// The default may be worse than the warp by this factor. The rule is for motions of D and E of
/// which A's is better than the warp; the test holds A to it, too.
constexpr double kWorseThanWarp = 1.05;

/// Mean error over parts of the face, mm.
struct RigErrors {
  double face_mm = 0, lips_mm = 0;
};

/// Runs the session's face again on the same mesh, by displacement. Its former results are gone.
void run_by_displacement(session::FaceSession& session) {
  scene::Scene other = session.scene();
  other.drive.by = simulate::DriveBy::displacement;
  other.origins["drive.by"] = {};  // as if the scene said so
  ASSERT_TRUE(session.set_scene(std::move(other)));
  session.run_base();
}

/// How the skin moves at the peak of the session's run, m; the vertices of the scan come first.
PointsF peak_of(const session::FaceSession& session) {
  const simulate::Performance& p = session.simulation().performance;
  return p.skin_displacement_m[std::size_t(p.peak_frame)];
}

class RigPeople : public testing::TestWithParam<RigRun> {};

TEST_P(RigPeople, MoveByDefaultAsTheRigDoes) {
  const RigRun& run = GetParam();
  if (!std::filesystem::exists(rig_data("subject_A_rig.glb"))) GTEST_SKIP() << "no rig";
  const PersonRig rig = read_person_rig(run.person);
  ASSERT_EQ(rig.landmarks.size(), 68u);
  const Points moved = rig.moved(run.weights);
  session::FaceSession session = session_of_rig(run, rig, moved);
  EXPECT_EQ(session.scene().drive.by, simulate::DriveBy::muscles) << session.drive_reason();

  const auto mesh = session.shared_mesh();
  const io::Landmarks& landmarks = session.inputs().landmarks;
  const Eigen::Index count = mesh->scan_vertices;
  const Points rest = mesh->skin.points.topRows(count);
  const TriMesh scan{rest, session.inputs().scan.mesh.triangles};
  const Points opened =
      io::read_mesh(rig_data(std::string("subject_") + run.person + "_mouth_open_truth.ply"),
                    io::LengthUnit::millimetre)
          .points;
  ASSERT_EQ(opened.rows(), count);
  const RigToScan to_scan(rig, rest, opened);
  const metrics::Regions regions = metrics::regions_of(rest, landmarks);
  const std::vector<int>& lips = regions.find("lips")->vertices;
  EXPECT_LT(metrics::statistics_of(to_scan.off_m(), lips).max_mm, 1) << "the truth is in doubt";
  const Points true_points = rest + to_scan.carried(moved);

  const auto errors_at = [&](const Points& at) {
    const Eigen::VectorXd off = metrics::distance_to_corresponding(at, true_points, count);
    return RigErrors{metrics::statistics_of(off, regions.find("face")->vertices).mean_mm,
                     metrics::statistics_of(off, lips).mean_mm};
  };
  const auto errors_of = [&](const PointsF& moves) {
    return errors_at(rest + moves.topRows(count).cast<double>());
  };
  RigErrors warp;
  for (const auto& b : metrics::baselines(scan, true_points, landmarks))
    if (b.key == (run.all_points ? "warp_68" : "warp_7")) warp = errors_at(b.moved);
  session.run_base();
  const PointsF own = peak_of(session);
  const RigErrors by_muscles = errors_of(own);
  RecordProperty("lips_over_warp", std::to_string(by_muscles.lips_mm / warp.lips_mm));
  RecordProperty("face_over_warp", std::to_string(by_muscles.face_mm / warp.face_mm));
  EXPECT_LT(by_muscles.lips_mm, run.lips * warp.lips_mm) << "of " << warp.lips_mm;
  EXPECT_LE(by_muscles.face_mm, kWorseThanWarp * warp.face_mm) << "of " << warp.face_mm;

  PointsF truth = PointsF::Zero(mesh->skin.points.rows(), 3);
  truth.topRows(count) = (true_points - rest).cast<float>();
  expect_no_crumpling(mesh->skin, own, truth, landmarks, run.corners);
  expect_true_groove(run, rig_groove_mm(scan, rest + own.topRows(count).cast<double>(), landmarks),
                     rig_groove_mm(scan, true_points, landmarks));
  const simulate::LipSurfaces both(*mesh, landmarks);
  ASSERT_FALSE(both.empty());
  EXPECT_LE(1e3 * both.depth(own), 1e3 * both.depth(truth) + 0.5) << "lips in each other, mm";

  run_by_displacement(session);
  const RigErrors by_displacement = errors_of(peak_of(session));
  RecordProperty("face_over_displacement",
                 std::to_string(by_muscles.face_mm / by_displacement.face_mm));
  EXPECT_LE(by_muscles.face_mm, kWorseThanDisplacement * by_displacement.face_mm);
}

class RigPeopleInContact : public testing::TestWithParam<RigRun> {};

/// Their skin is folded at the corners of the mouth. Judged by normals alone, lips that an opening
/// jaw parts lay up to 1.0 mm in each other there.
TEST_P(RigPeopleInContact, KeepTheirLipsApart) {
  const RigRun& run = GetParam();
  if (!std::filesystem::exists(rig_data("subject_A_rig.glb"))) GTEST_SKIP() << "no rig";
  const PersonRig rig = read_person_rig(run.person);
  session::FaceSession session = session_of_rig(run, rig, rig.moved(run.weights), true);
  session.run_base();
  const simulate::SimulationReport::Contact& contact = session.simulation().report.contact;
  RecordProperty("overlap_mm", std::to_string(contact.overlap_mm));
  RecordProperty("left_mm", std::to_string(contact.left_mm));
  EXPECT_LT(contact.left_mm, 0.1);
  if (run.weights.contains("jawOpen")) {
    EXPECT_LT(contact.overlap_mm, 0.1);
  }
  if (run.weights.contains("mouthPress")) {
    EXPECT_GT(contact.overlap_mm, 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Run, RigPeopleInContact,
                         testing::Values(RigRun{"DOfJawOpenSeven", "D", kJawOpen, false, 1},
                                         RigRun{"EOfJawOpenAll", "E", kJawOpen, true, 1},
                                         RigRun{"EOfOneSmileSeven", "E", kOneSmile, false, 1},
                                         RigRun{"DOfPressSeven", "D", kPress, false, 1}),
                         [](const auto& run) { return std::string(run.param.name); });

INSTANTIATE_TEST_SUITE_P(Run, RigPeople, testing::ValuesIn(kRigRuns),
                         [](const auto& run) { return std::string(run.param.name); });

}  // namespace
}  // namespace hyperex
