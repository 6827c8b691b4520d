// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "ingest/mesh/mesh_classes.hpp"
#include "reading.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Writes an OBJ, object by object.
class ObjText {
 public:
  explicit ObjText(UpAxis up) : up_(up) {}

  void begin(const std::string& name) { text_ << "o " << name << '\n'; }
  void box(double x, double y, double bottom, double top) {
    for (const double z : {bottom, top}) corners(x, y, z, 10.0);
    for (const char* face : {"-8 -7 -3 -4", "-7 -6 -2 -3", "-6 -5 -1 -2", "-5 -8 -4 -1", "-4 -3 -2 -1", "-5 -6 -7 -8"})
      text_ << "f " << face << '\n';
  }
  /// A square of 200 m in strips of 10 m, which rises by `slope` to the east.
  void slope(double slope, double lift = 0.0) {
    for (double x = -100.0; x < 100.0; x += 10.0) {
      vertex(x, -100.0, lift + slope * x), vertex(x + 10.0, -100.0, lift + slope * (x + 10.0));
      vertex(x + 10.0, 100.0, lift + slope * (x + 10.0)), vertex(x, 100.0, lift + slope * x);
      text_ << "f -4 -3 -2 -1\n";
    }
  }
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  void vertex(double x, double y, double z) {
    if (up_ == UpAxis::z)
      text_ << "v " << x << ' ' << y << ' ' << z << '\n';
    else
      text_ << "v " << x << ' ' << z << ' ' << -y << '\n';
  }
  void corners(double x, double y, double z, double edge) {
    vertex(x, y, z), vertex(x + edge, y, z), vertex(x + edge, y + edge, z), vertex(x, y + edge, z);
  }

  UpAxis up_;
  std::ostringstream text_;
};

/// Houses on a slope of one in ten.
void add_houses(ObjText& obj, int count) {
  for (int n = 0; n < count; ++n) {
    const double x = -60.0 + 40.0 * n;
    obj.begin("house " + std::to_string(n));
    obj.box(x, 0.0, 0.1 * x - 1.0, 0.1 * x + 8.0);
  }
}

TEST(GroundSheets, AreGroundWhateverTheyAreCalled) {
  for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
    ObjText obj(up);
    obj.begin("site");
    obj.slope(0.1);
    add_houses(obj, 4);
    IngestSettings settings;
    settings.up = up;
    const Reading r = read_text("a.obj", obj.text(), settings);
    EXPECT_EQ(r.city().buildings().size(), 4U);
    EXPECT_EQ(r.source.relief_points.size(), 80U);
    EXPECT_THAT(r.source.notes, ElementsAre(HasSubstr("below buildings and have no walls: 20 of site")));
    EXPECT_THAT(r.codes(), IsEmpty());
  }
}

TEST(GroundSheets, AreNoRoofsAndNoFloorsOfAFewHouses) {
  ObjText roof(UpAxis::z);
  add_houses(roof, 4);
  roof.begin("roof over all");
  roof.slope(0.1, 30.0);
  EXPECT_EQ(read_text("roof.obj", roof.text()).city().buildings().size(), 5U);
  ObjText pair(UpAxis::z);
  pair.begin("site");
  pair.slope(0.1);
  add_houses(pair, 2);
  EXPECT_EQ(read_text("pair.obj", pair.text()).city().buildings().size(), 3U);
  ObjText walls(UpAxis::z);
  walls.begin("hall");
  walls.slope(0.1);
  walls.box(-100, -100, -20, 600);
  add_houses(walls, 4);
  EXPECT_EQ(read_text("walls.obj", walls.text()).city().buildings().size(), 5U) << "what has walls is a building";
}

TEST(GroundSheets, AreAlsoKnownByNamesWithAWordOfGeometry) {
  for (const char* name : {"terrain_mesh", "Ground Plane", "Water surface 3", "Grass_01", "Gelände", "Wasser", "Strasse.002"})
    EXPECT_EQ(class_of_name(name), MeshClass::ground) << name;
  for (const char* name :
       {"Waterloo", "Groundhog", "Streeter", "Roof_Ground", "mesh", "Ground floor", "Road model shop", "Surface"})
    EXPECT_EQ(class_of_name(name), MeshClass::building) << name;
}

}  // namespace
}  // namespace farlod::ingest::test
