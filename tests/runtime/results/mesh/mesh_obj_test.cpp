// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/mesh_obj.hpp"

#include <gtest/gtest.h>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

TEST(MeshObj, HasAGroupForEachBuildingAndCountsVerticesFromOne) {
  const std::vector<Point3d> corners{{500.5, 600.25, 1.0}, {501.5, 600.25, 1.00004}, {500.5, 601.25, 2.0}};
  const std::vector<MeshTriangle> one{{{0, 1, 2}, SurfaceKind::roof}};
  const std::vector<MeshPart> parts{{{0, 0}, std::nullopt, "", corners, one},
                                    {{0, 0}, 3, "town hall", corners, one},
                                    {{1, 0}, 3, "town hall", corners, one},
                                    {{1, 0}, 4, "", corners, one}};
  const scenes::TemporaryFolder folder;
  write_obj(parts, {500.0, 600.0}, {"a remark"}, folder.file("a.obj"));
  const std::string v = "v 0.5000 0.2500 1.0000\nv 1.5000 0.2500 1.0000\nv 0.5000 1.2500 2.0000\n";
  EXPECT_EQ(scenes::text_of(folder.file("a.obj")),
            "# a remark\n# Offset: add 500 to x and 600 to y; z is the height above sea level\n"
            "g ground\n" +
                v + "f 1 2 3\n" + "g town_hall\n" + v + "f 4 5 6\n" + v + "f 7 8 9\n" + "g building_4\n" + v + "f 10 11 12\n");
}

TEST(MeshObj, SaysWhereItCannotBeWritten) { EXPECT_THROW(write_obj({}, {}, {}, "/no such folder/a.obj"), OutputError); }

}  // namespace
}  // namespace farlod
