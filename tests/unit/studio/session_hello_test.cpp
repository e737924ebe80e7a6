// SPDX-License-Identifier: GPL-3.0-or-later
// The page's controls take their bounds from the first answer. They must be those that the structs
// of options describe.
#include <map>

#include "hyperex/ct/thresholds.hpp"
#include "hyperex/scene/scene.hpp"
#include "unit/studio/session_fixture.hpp"

namespace hyperex::studio {
namespace {

/// Collects bounds from a struct's own description, by key and in the unit of scene files.
struct DescribedBounds {
  template <class At>
  void option(const char* member, At, const char*, const OptionDetails& details = {}) {
    if (details.bounds.limited())
      of[key_of(member, details)] = details.unit.from_si(details.bounds);
  }
  std::map<std::string, Bounds> of;
};

template <class Row>
std::map<std::string, Bounds> described_bounds() {
  DescribedBounds found;
  Row::describe(found);
  return found.of;
}

const json& named(const json& list, const std::string& name) {
  static const json none;
  for (const json& one : list)
    if (one.at("name") == name) return one;
  ADD_FAILURE() << "no " << name;
  return none;
}

void expect_bounds(const json& sent, const Bounds& bounds) {
  EXPECT_EQ(sent.value("low", 1e300), bounds.least) << sent;
  EXPECT_EQ(sent.value("high", -1e300), bounds.most) << sent;
  EXPECT_EQ(sent.value("above_low", !bounds.above_least), bounds.above_least) << sent;
}

template <class Row>
void expect_columns(const json& key, const std::vector<std::string>& needed) {
  const auto bounds = described_bounds<Row>();
  for (const std::string& name : needed) EXPECT_TRUE(bounds.contains(name)) << name;
  for (const auto& [name, of] : bounds) expect_bounds(named(key.at("columns"), name), of);
}

TEST_F(StudioSession, TellsTheBoundsOfTheColumnsOfTablesAsTheirStructsDescribeThem) {
  const json keys = ask("hello")["keys"];
  expect_columns<tissue::TissueRegion>(named(keys, "tissue.region"),
                                       {"young_factor", "viscosity_factor", "volume_ml"});
  expect_columns<tissue::TissueLayer>(named(keys, "tissue.layer"),
                                      {"thickness_mm", "young_factor"});
  expect_columns<tissue::DepthRegion>(named(keys, "mesh.thickness_region"), {"thickness_mm"});
  expect_columns<simulate::BoneMove>(named(keys, "surgery.bone"),
                                     {"move_mm", "turn_deg", "cut_shift_mm"});
  expect_bounds(named(keys, "muscles.gain"), described_bounds<simulate::MuscleGain>().at("gain"));

  const json& volume = named(named(keys, "tissue.region")["columns"], "volume_ml");
  EXPECT_EQ(volume["unit"], "ml");
  EXPECT_EQ(volume["high"], 30);
}

TEST_F(StudioSession, TellsTheDefaultsOfAScene) {
  const json keys = ask("hello")["keys"];
  EXPECT_EQ(named(keys, "drive.by")["default"], "muscles");
  EXPECT_EQ(named(keys, "tissue.young_kpa")["default"], 192.4);
  EXPECT_EQ(named(keys, "support.border")["default"], "held");
}

TEST(Protocol, TakesTheValuesOfBoneThatACtTakes) {
  const json& field = protocol().at("/requests/ct_bones/fields/bone_hu"_json_pointer);
  EXPECT_EQ(field.at("least"), ct::bone_hu_in.least);
  EXPECT_EQ(field.at("most"), ct::bone_hu_in.most);
}

}  // namespace
}  // namespace hyperex::studio
