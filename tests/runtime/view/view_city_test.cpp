// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_city.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "farlod/error.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "results/value_text.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/temporary_folder.hpp"
#include "view/exported_view.hpp"

namespace farlod {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

class ViewOfVillage : public testing::Test {
 protected:
  [[nodiscard]] json at(const ViewQuery& query) const {
    const ViewReply reply = city.answer("at", query);
    EXPECT_EQ(reply.status, 200) << reply.body;
    return json::parse(reply.body);
  }
  [[nodiscard]] std::string error(const std::string& path, const ViewQuery& query, int status) const {
    const ViewReply reply = city.answer(path, query);
    EXPECT_EQ(reply.status, status) << path << " " << reply.body;
    return json::parse(reply.body).at("error").get<std::string>();
  }
  /// East of the village's middle, on a street.
  [[nodiscard]] ViewQuery a_street() const {
    for (double step_m = 0.0; step_m < 50.0; step_m += 1.0) {
      const double x = library::middle_of(package).x + step_m, y = library::middle_of(package).y;
      if (!std::isnan(evaluate_points(package, {{&x, 1}, {&y, 1}}).svf.front()))
        return {{"x", shortest_decimal(x)}, {"y", shortest_decimal(y)}};
    }
    ADD_FAILURE() << "all is built up";
    return {};
  }

  library::PackedSample sample;
  Package package{sample.folder()};
  ViewCity city{package, "village.farlod", view_frame_of(package), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
};

TEST_F(ViewOfVillage, AnswersAsTheLibraryDoes) {
  const ViewQuery street = a_street();
  const double x = std::stod(street.find("x")->second), y = std::stod(street.find("y")->second);
  EvaluationSettings settings;
  settings.bounds = true;
  const PointAnswers expected = evaluate_points(package, {{&x, 1}, {&y, 1}}, {}, settings);
  const json said = at(street);
  EXPECT_EQ(said.at("svf").get<float>(), expected.svf.front());
  EXPECT_EQ(said.at("text"), svf_decimal(static_cast<double>(expected.svf.front())));
  EXPECT_EQ(said.at("low").get<float>(), expected.low.front());
  EXPECT_EQ(said.at("high").get<float>(), expected.high.front());
  EXPECT_EQ(said.at("z_m").get<double>(), expected.height_m.front());
  ASSERT_TRUE(said.at("cell").is_array());
}

TEST_F(ViewOfVillage, AWallLooksWhereItsNormalSays) {
  ViewQuery wall = a_street();
  const double up = at(wall).at("svf").get<double>();
  wall["azimuth"] = "90";
  wall["tilt"] = "90";
  const double sideways = at(wall).at("svf").get<double>();
  EXPECT_LT(sideways, up);
  EXPECT_LE(sideways, 0.5);
  EXPECT_GT(sideways, 0.0);
}

TEST_F(ViewOfVillage, HemispheresAreThoseOfLookUp) {
  const ViewQuery street = a_street();
  const ViewReply reply = city.answer("hemisphere", street);
  const auto sky = look_up(package, {std::stod(street.find("x")->second), std::stod(street.find("y")->second)});
  ASSERT_TRUE(sky);
  ASSERT_EQ(reply.body.size(), sky->parts.size() + 4 * sky->horizon.size());
  for (std::size_t n = 0; n < sky->parts.size(); n += 997) EXPECT_EQ(reply.body[n], static_cast<char>(sky->parts[n]));
}

TEST_F(ViewOfVillage, ABuildingHasNoAnswer) {
  const std::vector<MeshPart> parts = geometry_of(package, inventory_of(package).cells);
  const auto building = std::ranges::find_if(parts, [](const MeshPart& part) { return part.building.has_value(); });
  ASSERT_NE(building, parts.end());
  Point2d middle;
  for (const Point3d& p : building->vertices_projected)
    middle = middle + 1.0 / static_cast<double>(building->vertices_projected.size()) * horizontal(p);
  const ViewQuery inside{{"x", shortest_decimal(middle.x)}, {"y", shortest_decimal(middle.y)}};
  const json said = at(inside);
  EXPECT_TRUE(said.at("svf").is_null());
  EXPECT_TRUE(said.at("text").is_null());
  EXPECT_EQ(city.answer("hemisphere", inside).status, 204);
}

TEST_F(ViewOfVillage, BeyondTheGridThereIsNoCell) { EXPECT_TRUE(at({{"x", "0"}, {"y", "0"}}).at("cell").is_null()); }

TEST_F(ViewOfVillage, CellsAreThoseOfThePackage) {
  const CellPlace first{inventory_of(package).cells.i_begin, inventory_of(package).cells.j_begin};
  const json said = json::parse(city.answer("cell", {{"i", std::to_string(first.i)}, {"j", std::to_string(first.j)}}).body);
  const CellContents contents = inspect_cell(package, first);
  EXPECT_EQ(said.at("triangles"), contents.triangles);
  EXPECT_EQ(said.at("near_cells").size(), contents.near_cells.size());
  EXPECT_EQ(said.at("far").at("low").size(), inventory_of(package).azimuth_bins);
  const json description = json::parse(city.description(true));
  const auto corner = description.at("grid").at("corner_m").get<std::array<double, 2>>();
  const auto corner_of_cell = said.at("corners_m").at(0).get<std::array<double, 2>>();
  EXPECT_NEAR(corner[0], corner_of_cell[0], 1e-6) << "two ways to the same corner";
  EXPECT_NEAR(corner[1], corner_of_cell[1], 1e-6);
}

TEST_F(ViewOfVillage, RequestsThatMakeNoSenseAreRefused) {
  EXPECT_EQ(error("at", {}, 400), "x is missing");
  EXPECT_EQ(error("at", {{"x", "1e"}, {"y", "2"}}, 400), "x is not a number");
  EXPECT_NE(error("at", {{"x", "1e300"}, {"y", "2"}}, 400), "");
  EXPECT_NE(error("at", {{"x", "1"}, {"y", "2"}, {"tilt", "4000"}}, 400), "");
  EXPECT_NE(error("cell", {{"i", "1000"}, {"j", "2"}}, 404), "");
  for (const char* path : {"tiles/9/0/0.glb", "tiles/0/0.glb", "tiles/0/0/0", "tiles/0/0/-1.glb", "tiles/0/0/0/0.glb",
                           "subtrees/1.0.0.subtree", "subtrees/0.1.0.subtree", "../manifest.json", "manifest.json", ""})
    EXPECT_NE(error(path, {}, 404), "") << path;
}

TEST_F(ViewOfVillage, TilesAreTheSameAtEachCall) {
  const ViewReply once = city.answer("tiles/0/0/0.glb", {});
  EXPECT_EQ(once.status, 200);
  EXPECT_EQ(once.type, "model/gltf-binary");
  EXPECT_EQ(city.answer("tiles/0/0/0.glb", {}).body, once.body);
  EXPECT_EQ(city.tile({}), once.body) << "made anew";
  EXPECT_EQ(city.answer("tileset.json", {}).status, 200);
  EXPECT_EQ(city.answer("subtrees/0.0.0.subtree", {}).status, 200);
}

TEST_F(ViewOfVillage, ADamagedPackageIsToldAndEndsNothing) {
  const ViewFrame frame = view_frame_of(package);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sample.folder()))
    if (entry.path().filename() == "tiles.bin") std::ofstream(entry.path(), std::ios::binary | std::ios::trunc) << "nonsense";
  const Package damaged(sample.folder());
  const ViewCity view(damaged, "village.farlod", frame, {});
  const ViewReply reply = view.answer("tiles/0/0/0.glb", {});
  EXPECT_EQ(reply.status, 500);
  EXPECT_NE(reply.body.find("tiles.bin"), std::string::npos) << reply.body;
}

TEST(ExportedView, APageThatGrowsTooLargeIsRefusedAndNotLeft) {
  const library::PackedSample sample;
  const scenes::TemporaryFolder folder;
  const Package package(sample.folder());
  const ViewCity city(package, "village.farlod", view_frame_of(package), {});
  const std::filesystem::path file = folder.file("village.html");
  std::size_t done = 0;
  const auto count = [&](std::size_t n, std::size_t /*all*/) { done = n; };
  const std::uint64_t bytes = export_page(city, file, count).bytes;
  EXPECT_EQ(std::filesystem::file_size(file), bytes);
  EXPECT_GT(done, 0U);
  std::filesystem::remove(file);
  EXPECT_THAT([&] { export_page(city, file, count, bytes - 1); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("village.html"), HasSubstr("MiB"), HasSubstr("--area"))));
  EXPECT_TRUE(std::filesystem::is_empty(file.parent_path()));
}

TEST(ExportedView, AGreatCityIsRefusedAtOnce) {
  EXPECT_THAT([] { require_page_is_possible("berlin.html", 10'000'000); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("berlin.html"), HasSubstr("64 MiB"))));
  EXPECT_NO_THROW(require_page_is_possible("rotterdam.html", 59'069));
}

TEST(OnePage, HasItsFilesBeforeItsScript) {
  std::ostringstream text;
  OnePage page(text);
  page.add("a/b.bin", std::string("</script>\0<!--", 14));
  page.finish();
  const std::string html = text.str();
  EXPECT_THAT(html, StartsWith("<!doctype html>"));
  EXPECT_EQ(html.size(), page.bytes());
  const std::size_t file = html.find("data-file=\"a/b.bin\""), script = html.find("<script type=\"module\">");
  ASSERT_NE(file, std::string::npos);
  EXPECT_LT(file, script);
  const std::string element = html.substr(file, html.find('\n', file) - file);
  EXPECT_EQ(element.find("<!--"), std::string::npos) << "bytes of a file are text";
  EXPECT_EQ(element.find('<'), element.rfind("</script>"));
  EXPECT_LT(html.find("Content-Security-Policy"), html.find("<script")) << "it holds for what follows";
}

}  // namespace
}  // namespace farlod
