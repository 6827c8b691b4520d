// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/analytic/setups.hpp"

#include <gmock/gmock.h>

#include <array>
#include <set>

#include "tests/analytic/all_pairs.hpp"

// The chosen cases stand in for a product of all parameters. What they owe to it is counted here by name, by nothing of the code
// that chooses.

namespace farlod::analytic {
namespace {

using testing::IsEmpty;
using testing::IsSubsetOf;
using testing::UnorderedElementsAre;

std::string walls_of(const Setup& setup) { return setup.walls == Walls::houses ? "houses" : "sheets"; }
std::string share_of(const Setup& setup) { return std::array{"near", "far", "split"}.at(static_cast<std::size_t>(setup.share)); }

/// Each value with its parameter, the engine among them.
std::vector<std::vector<std::string>> named_values(const std::vector<Case>& cases) {
  std::vector<std::vector<std::string>> rows;
  for (const Case& c : cases)
    for (const Engine engine : engines_for(c.setup.kind))
      rows.push_back({"scene " + c.scene.name, "share " + share_of(c.setup), "walls " + walls_of(c.setup),
                      std::string("far maps ") + scenes::name_of(c.setup.kind), std::string("engine ") + name_of(engine),
                      "bearing " + std::to_string(c.setup.bearing_deg)});
  return rows;
}

std::set<std::string> pairs_in(const std::vector<Case>& cases) {
  std::set<std::string> pairs;
  for (const std::vector<std::string>& values : named_values(cases))
    for (const std::string& a : values)
      for (const std::string& b : values)
        if (a < b) pairs.insert(a + ", " + b);
  return pairs;
}

TEST(Setups, EachPairOfTwoValuesIsPacked) {
  const std::set<std::string> wanted = pairs_in(all_cases()), packed = pairs_in(chosen_cases());
  EXPECT_GT(wanted.size(), 200U) << "there is nothing to miss";
  EXPECT_THAT(wanted, IsSubsetOf(packed));
}

/// So that a value which is missing in the product is noticed, too.
TEST(Setups, EachValueIsInTheProduct) {
  std::set<std::string> values;
  for (const std::vector<std::string>& row : named_values(all_cases())) values.insert(row.begin(), row.end());
  std::set<std::string> scenes;
  for (const Scene& scene : all_scenes()) scenes.insert("scene " + scene.name);
  EXPECT_THAT(scenes, IsSubsetOf(values));
  std::erase_if(values, [&](const std::string& value) { return scenes.contains(value); });
  EXPECT_THAT(values,
              UnorderedElementsAre("share near", "share far", "share split", "walls sheets", "walls houses", "far maps Horizon",
                                   "far maps Box", "engine automatic", "engine horizon", "engine rays", "engine exact",
                                   "bearing 0.000000", "bearing 17.000000", "bearing 45.000000"));
}

TEST(Setups, EveryOverhangIsPackedNearFarAndSplit) {
  std::set<std::string> packed;
  for (const Case& c : chosen_cases()) packed.insert(name_of(c));
  for (const Scene& scene : all_scenes()) {
    if (!scene.is_overhead) continue;
    for (const char* share : {"Near", "Far", "Split"}) EXPECT_TRUE(packed.contains(scene.name + share + "HorizonSheets17"));
  }
}

TEST(Setups, ChosenCasesAreFewAndDiffer) {
  const std::vector<Case> chosen = chosen_cases();
  std::set<std::string> names;
  for (const Case& c : chosen) names.insert(name_of(c));
  EXPECT_EQ(names.size(), chosen.size());
  EXPECT_LT(chosen.size(), all_cases().size() / 5);
}

TEST(AllPairs, KeepTheFirstRowsAndAddWhatTheyLack) {
  const std::vector<Row> possible{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_THAT(with_all_pairs({{0, 1, 1}}, possible),
              testing::ElementsAre(Row{0, 1, 1}, Row{0, 0, 0}, Row{1, 0, 1}, Row{1, 1, 0}));
}

TEST(AllPairs, ARowThatIsNotPossibleIsNotAdded) {
  const std::vector<Row> possible{{0, 0}, {1, 1}};
  EXPECT_EQ(with_all_pairs({}, possible), possible);
  EXPECT_THAT(with_all_pairs({}, {}), IsEmpty());
}

}  // namespace
}  // namespace farlod::analytic
