// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/gml_references.hpp"
#include "ingest/citygml/gml_surfaces_numbers.hpp"

namespace farlod::ingest::test {
namespace {

const std::string plain_house = building(surface("bldg:lod1MultiSurface", "a", "1"));

std::string refusal(const std::string& text) {
  try {
    (void)read_citygml_text(text);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

std::string with_doctype(const std::string& doctype) {
  std::string text = model(plain_house);
  return text.insert(text.find("?>") + 2, doctype);
}

TEST(CityGmlHostile, DeclarationsInADoctypeAreRefused) {
  const std::vector<std::string> doctypes{
      R"(<!DOCTYPE CityModel [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>)",      // doubles with each entity
      R"(<!DOCTYPE CityModel [<!ENTITY file SYSTEM "file:///etc/passwd">]>)",  // leads to another file
      R"(<!DOCTYPE CityModel [<!ENTITY % more SYSTEM "http://a/b.dtd">]>)",
      R"(<!DOCTYPE CityModel [<!ATTLIST CityModel href CDATA "long">]>)"};
  for (const std::string& doctype : doctypes) {
    const std::string said = refusal(with_doctype(doctype));
    EXPECT_NE(said.find("DOCTYPE"), std::string::npos) << doctype;
    EXPECT_NE(said.find("line 1"), std::string::npos) << said;
  }
}

TEST(CityGmlHostile, ADoctypeThatDeclaresNothingIsHarmless) {
  EXPECT_EQ(refusal(with_doctype(R"(<!DOCTYPE CityModel SYSTEM "http://nowhere/citygml.dtd">)")), "");
}

TEST(CityGmlHostile, EntitiesOfAnotherFileAreRefused) {
  std::string text = with_doctype(R"(<!DOCTYPE CityModel SYSTEM "http://nowhere/citygml.dtd">)");
  text.insert(text.find("<cityObjectMember>"), "<gml:name>&secret;</gml:name>");
  EXPECT_NE(refusal(text).find("&secret;"), std::string::npos);
}

TEST(CityGmlHostile, DeepElementsAreRefused) {
  const auto nested = [](std::size_t depth) {
    std::string begins, ends;
    for (std::size_t k = 0; k < depth; ++k) {
      begins += "<gml:a>";
      ends += "</gml:a>";
    }
    return model(begins + ends + plain_house);
  };
  EXPECT_EQ(refusal(nested(255)), "") << "the model itself is the first of 256";
  EXPECT_NE(refusal(nested(256)).find("nested deeper than 256"), std::string::npos);
}

TEST(CityGmlHostile, EndlessTagsAreRefused) {
  constexpr std::size_t four_mib = std::size_t{1} << 22;
  const auto said_of = [](std::size_t bytes) {
    return refusal(model("<gml:name gml:id=\"" + std::string(bytes, 'x') + "\"/>" + plain_house));
  };
  EXPECT_EQ(said_of(four_mib / 2), "");
  EXPECT_NE(said_of(four_mib + four_mib / 2).find("4194304 bytes"), std::string::npos);
}

TEST(CityGmlHostile, AnEndlessRingIsLeftOutOfItsBuilding) {
  std::string list = "0 0 0";
  for (std::size_t k = 0; k < most_points_of_ring; ++k) list += " 1 1 1";
  const auto of_list = [](const std::string& positions) {
    return within("bldg:lod1MultiSurface gml:MultiSurface gml:surfaceMember gml:Polygon gml:exterior gml:LinearRing", positions);
  };
  for (const std::string& positions :
       {within("gml:posList", list), within("gml:posList", list.substr(5)) + within("gml:pos", "0 0 0")}) {
    const Reading r =
        read_citygml_text(model(building(of_list(positions) + surface("bldg:lod1MultiSurface", "a", "1"), "endless")));
    EXPECT_EQ(r.city().facets().size(), 1u);
    ASSERT_EQ(r.codes(), std::set<int>{112});
    EXPECT_EQ(r.report.problems()[0].place, "endless");
    EXPECT_NE(r.report.problems()[0].detail.find("1048576 points"), std::string::npos);
  }
}

TEST(CityGmlHostile, ManyReferencesToManyPolygonsTakeNoTime) {
  // 20,000 x 20,000: at a nanosecond each it would take minutes under a sanitizer
  constexpr int many = 20'000;
  std::string polygons, references;
  for (int k = 0; k < many; ++k) {
    polygons += member(polygon("p" + std::to_string(k), std::to_string(k)));
    references += reference("all");
  }
  const std::string all = R"(<gml:CompositeSurface gml:id="all">)" + polygons + "</gml:CompositeSurface>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", references + member(all)))));
  EXPECT_EQ(r.city().facets().size(), std::size_t{many});
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlHostile, ManyReferencesToUnusablePolygonsTakeNoTime) {
  constexpr int many = 20'000;
  std::string polygons, references;
  for (int k = 0; k < many; ++k) {
    polygons += member("<gml:Polygon/>");
    references += reference("all");
  }
  const std::string all = R"(<gml:CompositeSurface gml:id="all">)" + polygons + "</gml:CompositeSurface>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", references + member(all))) + plain_house));
  EXPECT_EQ(r.codes(), (std::set<int>{106, 111}));
}

TEST(CityGmlHostile, ALongChainOfReferencesIsFollowedToItsEnd) {
  std::string links = member(polygon("p0", "3"));
  for (int k = 1; k < 5'000; ++k)
    links += R"(<gml:surfaceMember><gml:CompositeSurface gml:id="p)" + std::to_string(k) + R"(">)" +
             reference("p" + std::to_string(k - 1)) + "</gml:CompositeSurface></gml:surfaceMember>";
  const Reading r = read_citygml_text(model(building(multi_surface("2", reference("p4999") + links))));
  EXPECT_EQ(heights(r.city()), std::vector<double>{3});
  EXPECT_TRUE(r.codes().empty());
}

/// A house whose wall lies behind so many links, each in a thing of its own, and each found by one more reading of the
/// file.
Reading house_behind(int links) {
  const auto thing = [](int k, const std::string& content) {
    return R"(<cityObjectMember><uro:Thing><gml:MultiSurface gml:id="p)" + std::to_string(k) + R"(">)" + content +
           "</gml:MultiSurface></uro:Thing></cityObjectMember>";
  };
  std::string chain = thing(0, member(polygon("wall", "3")));
  for (int k = 1; k < links; ++k) chain += thing(k, reference("p" + std::to_string(k - 1)));
  return read_citygml_text(model(chain + building(multi_surface("2", reference("p" + std::to_string(links - 1))))));
}

TEST(CityGmlHostile, AChainOfReferencesThroughTheFileEnds) {
  for (const int links : {1, 2, 6}) EXPECT_EQ(heights(house_behind(links).city()), std::vector<double>{3}) << links;
  EXPECT_EQ(house_behind(7).codes(), (std::set<int>{111}));
}

TEST(CityGmlHostile, AReferenceIsGoneThroughOnce) {
  GmlSurfaces surfaces;
  surfaces.polygons.resize(100);
  for (std::size_t k = 0; k < 100; ++k) surfaces.members.push_back({k, {}, false, 0});
  surfaces.ranges["all"] = {0, 100, false};
  const GmlMember all{std::nullopt, "#all", false, 0};
  ReferenceBudget budget({});
  const GmlSurfaces none;
  ReferenceWalk asking(surfaces, none, budget), visiting(surfaces, none, budget);
  std::size_t asked = 0, visited = 0;
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(asking.any(all, [&](const GmlPolygon&) { return ++asked == 0; }));
    visiting.each(all, [&](const ResolvedPolygon&) { ++visited; });
  }
  for (const GmlMember& member : surfaces.members) visiting.each(member, [&](const ResolvedPolygon&) { ++visited; });
  EXPECT_EQ(asked, 100u);
  EXPECT_EQ(visited, 100u);
  ReferenceWalk finding(surfaces, none, budget);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(finding.any(all, [](const GmlPolygon&) { return true; })) << "asked again: " << k;
}

TEST(CityGmlHostile, TheBudgetOfReferencesEnds) {
  ReferenceBudget budget({});
  EXPECT_TRUE(budget.take(budget.most_points() - 1));
  EXPECT_EQ(budget.refusals(), 0u);
  EXPECT_FALSE(budget.take(2));
  EXPECT_FALSE(budget.take(1)) << "what was too much once ends it: small things after large ones would look whole";
  EXPECT_EQ(budget.refusals(), 2u);
}

TEST(CityGmlHostile, OrdinaryCitiesMayUseAllTheirReferences) {
  GmlSurfaces foreign;
  foreign.polygons.resize(1'000'000);
  ReferenceBudget budget(foreign);
  EXPECT_EQ(budget.most_points(), 5'000'000u + 16u * 1'000'000u) << "a polygon without points counts as one";
}

TEST(CityGmlHostile, BuildingsThatAllShareALargeThingSayWhatIsMissing) {
  std::string polygons, houses;
  for (int k = 0; k < 6'000; ++k) polygons += member(polygon("p" + std::to_string(k), std::to_string(k)));
  // A polygon of four points costs five: 5,000,000 + 16 * 30,000 are to be had, 200 * 30,000 are wanted
  for (int k = 0; k < 200; ++k)
    houses += building(R"(<bldg:lod2MultiSurface xlink:href="#all"/>)" + surface("bldg:lod2MultiSurface", "own", "1"),
                       "house " + std::to_string(k));
  const std::string large = building(
      R"(<bldg:lod2MultiSurface><gml:MultiSurface gml:id="all">)" + polygons + "</gml:MultiSurface></bldg:lod2MultiSurface>",
      "large");
  const Reading r = read_citygml_text(model(large + houses));
  EXPECT_EQ(r.city().buildings().size(), 201u);
  EXPECT_EQ(r.codes(), std::set<int>{112});
  EXPECT_NE(r.report.problems()[0].detail.find("5480000 points"), std::string::npos);
}

TEST(CityGmlHostile, KindsThatAreNotReadAreFewInTheReport) {
  std::string things;
  for (int k = 0; k < 1'000; ++k) things += "<gml:Thing" + std::to_string(k) + "/>";
  things += "<gml:Thing0/>";
  const Reading r = read_citygml_text(model(building(
      surface("bldg:lod1MultiSurface", "a", "1") + within("bldg:lod1MultiSurface gml:MultiSurface gml:surfaceMember", things))));
  EXPECT_EQ(r.report.problems().size(), 17u);
  EXPECT_NE(std::find_if(r.report.problems().begin(), r.report.problems().end(),
                         [](const Problem& p) { return p.detail == "a gml:Thing0 is not read (2 times)"; }),
            r.report.problems().end());
}

std::vector<double> numbers_of(const std::vector<std::string>& pieces) {
  std::vector<double> numbers;
  NumberScanner scanner;
  const auto sink = [&](double number) { numbers.push_back(number); };
  for (const std::string& piece : pieces) scanner.take(piece, sink);
  scanner.end(sink);
  return numbers;
}

TEST(CityGmlHostile, NumbersMayBeBrokenAnywhere) {
  const std::string text = " 1.5 -2e1,+3\n4\t";
  const std::vector<double> expected{1.5, -20, 3, 4};
  for (std::size_t k = 0; k <= text.size(); ++k) EXPECT_EQ(numbers_of({text.substr(0, k), text.substr(k)}), expected) << k;
  std::vector<std::string> letters;
  for (const char c : text) letters.emplace_back(1, c);
  EXPECT_EQ(numbers_of(letters), expected);
}

TEST(CityGmlHostile, WordsThatAreNoNumbersAreNaN) {
  for (const std::string word : {"x", "1x", "+", "-", "1..2", "1e999", "--1", "0x10"}) {
    const std::vector<double> numbers = numbers_of({"7 " + word + " 8"});
    ASSERT_EQ(numbers.size(), 3u) << word;
    EXPECT_TRUE(std::isnan(numbers[1])) << word;
    EXPECT_EQ(numbers[2], 8.0) << word;
  }
  EXPECT_TRUE(std::isnan(numbers_of({std::string(2'000, '1'), " "}).at(0))) << "longer than any number";
}

}  // namespace
}  // namespace farlod::ingest::test
