// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/implausible_model.hpp"

#include <gmock/gmock.h>

namespace farlod::georeference {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Model {
 public:
  explicit Model(std::string source = "town.city.json") { located_.sources = {std::move(source)}; }

  Model& box(Point3d low, Point3d size, HeightReference reference = HeightReference::elevation) {
    CityModel& city = located_.city;
    city.begin_building("b" + std::to_string(city.buildings().size()), reference);
    const auto at = [&](int x, int y, int z) { return low + Point3d{x * size.x, y * size.y, z * size.z}; };
    const auto add = [&](const std::vector<Point3d>& ring) {
      city.begin_facet(SurfaceKind::unknown, 0);
      city.add_ring(ring);
    };
    for (const int z : {0, 1}) add({at(0, 0, z), at(1, 0, z), at(1, 1, z), at(0, 1, z)});
    for (const int k : {0, 1}) {
      add({at(0, k, 0), at(1, k, 0), at(1, k, 1), at(0, k, 1)});
      add({at(k, 0, 0), at(k, 1, 0), at(k, 1, 1), at(k, 0, 1)});
    }
    return *this;
  }
  /// Some houses in rows, each of the same size, `step` of their width from each other.
  Model& town(int count, double width, double height, double step = 2.0) {
    for (int k = 0; k < count; ++k) box({step * width * (k % 5), step * width * (k / 5), 100}, {width, 0.8 * width, height});
    return *this;
  }
  [[nodiscard]] std::vector<int> codes() const {
    std::vector<int> codes;
    for (const Problem& p : problems()) codes.push_back(static_cast<int>(p.code));
    return codes;
  }
  [[nodiscard]] std::string detail() const {
    const auto all = problems();
    return all.empty() ? "" : all[0].detail;
  }
  [[nodiscard]] std::vector<Problem> problems() const {
    Report report;
    report_implausible(located_, report);
    return report.problems();
  }

 private:
  LocatedCity located_;
};

TEST(ImplausibleModel, IsNoneOfTheLargestThatThereAre) {
  EXPECT_THAT(Model().town(20, 12, 8).codes(), IsEmpty());
  EXPECT_THAT(Model().box({}, {160, 160, 828}).codes(), IsEmpty()) << "Burj Khalifa, alone";
  EXPECT_THAT(Model().box({}, {1500, 500, 45}).codes(), IsEmpty()) << "a factory or a terminal";
  EXPECT_THAT(Model().box({}, {38'000, 12, 60}).codes(), IsEmpty()) << "a bridge";
  EXPECT_THAT(Model().box({}, {9'000, 8, 14}).codes(), IsEmpty()) << "a city wall, an aqueduct";
  EXPECT_THAT(Model().town(12, 60, 380).codes(), IsEmpty()) << "a quarter of towers alone";
  EXPECT_THAT(Model().box({}, {0.8, 0.8, 20}).codes(), IsEmpty()) << "a mast";
}

TEST(ImplausibleModel, CountsInAnotherUnit) {
  EXPECT_THAT(Model().town(1, 8000, 7000).detail(),
              AllOf(HasSubstr("7000 m"), HasSubstr("in millimetres"), HasSubstr("\"transform\"")));
  EXPECT_THAT(Model().town(20, 1200, 800).detail(), AllOf(HasSubstr("in centimetres"), HasSubstr("12 m wide and 8 m high")));
  EXPECT_THAT(Model("a.obj").town(20, 0.012, 0.008).detail(),
              AllOf(HasSubstr("in kilometres"), HasSubstr("OBJ is read in metres")));
  EXPECT_THAT(Model("a.gml").town(20, 12, 800).detail(),
              AllOf(HasSubstr("are heights in centimetres?"), HasSubstr("name the CRS")));
  for (const Model& model : {Model().town(1, 8000, 7000), Model().town(20, 1200, 800), Model().town(3, 0.012, 0.008)})
    EXPECT_THAT(model.codes(), ElementsAre(208));
}

TEST(ImplausibleModel, HasOneSlip) {
  const Model model = Model().town(20, 12, 8).box({300, 0, 100}, {12, 9, 9'900});
  EXPECT_THAT(model.detail(),
              AllOf(HasSubstr("1 of 21 buildings"), HasSubstr("such as b20, 9900 m high"), HasSubstr("vertices wrong")));
  ASSERT_EQ(model.problems().size(), 1U);
  EXPECT_EQ(model.problems()[0].position->z, 10'000.0);
  EXPECT_EQ(model.problems()[0].place, "the whole file");
}

TEST(ImplausibleModel, LooksAtNoHeightThatIsNotKnownYet) {
  EXPECT_THAT(Model().box({}, {12, 9, 2600}, HeightReference::down_to_ground).codes(), IsEmpty());
}

TEST(ImplausibleModel, LiesOnItsSide) {
  Model town("a.obj"), slope, row;
  for (int k = 0; k < 100; ++k) {
    const double x = 40.0 * (k % 10), depth = 40.0 * (k / 10);
    town.box({x, 0, depth}, {12, 8, 10});
    slope.box({x, depth, 0.25 * depth}, {12, 10, 8});
    if (k < 12) row.box({25.0 * k, 0, 5.0 * k}, {12, 10, 8});
  }
  EXPECT_THAT(town.codes(), ElementsAre(209));
  EXPECT_THAT(town.detail(), AllOf(HasSubstr("lie on its side"), HasSubstr("Give --up y")));
  EXPECT_THAT(slope.codes(), IsEmpty()) << "a town on a slope of one in four";
  EXPECT_THAT(row.codes(), IsEmpty()) << "a row of houses on a slope of one in five";
}

}  // namespace
}  // namespace farlod::georeference
