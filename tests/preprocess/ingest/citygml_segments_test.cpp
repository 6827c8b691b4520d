// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/task_arena.h>

#include "citygml_text.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_reader.hpp"
#include "ingest/citygml/citygml_xml.hpp"

namespace farlod::ingest::test {
namespace {

/// So small that nearly each object of the city is a segment.
constexpr SegmentSizes small_segments{.least = 100, .most = 10'000};

/// Reads on so many threads; what ends the reading is described, too.
std::string read_on_threads(int threads, const std::filesystem::path& file, const SegmentSizes& segments = small_segments) {
  return oneapi::tbb::task_arena(threads).execute([&] {
    Report report;
    try {
      const SourceCity source = read_citygml(file, {}, report, {}, segments);
      return described(source, report);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  });
}

std::optional<CityGmlContents> cut_and_read(const std::filesystem::path& file, const SegmentSizes& segments = small_segments) {
  const InputFile input = file;
  const GmlSurfaces none;
  return oneapi::tbb::task_arena(4).execute([&] { return read_in_segments({input, {}, none, {}, segments}); });
}

/// Whether the file can be read in segments, and whether threads change nothing, in any case.
bool is_cut(const std::string& text, const SegmentSizes& segments = small_segments) {
  const std::filesystem::path file = write_file("a.gml", text);
  EXPECT_EQ(read_on_threads(4, file, segments), read_on_threads(1, file, segments));
  return cut_and_read(file, segments).has_value();
}

std::string house(int n, const std::string& more = "") {
  return building(surface("bldg:lod1MultiSurface", "p" + std::to_string(n), std::to_string(n)) + more,
                  "house " + std::to_string(n));
}

std::string houses(int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += house(n);
  return text;
}

TEST(CityGmlSegments, MakeTheFileWhenPutTogether) {
  const std::string text = model(houses(20) + "<!-- the end -->") + "\n";
  for (const SegmentSizes sizes : {small_segments, SegmentSizes{1000, 4000}, SegmentSizes{}}) {
    SegmentCutter cutter(write_file("a.gml", "\n " + text), sizes);
    std::string all = cutter.head();
    EXPECT_TRUE(all.ends_with(R"(xmlns:core="http://www.opengis.net/citygml/2.0">)"));
    std::size_t segments = 0;
    for (bool is_last = false; !is_last; ++segments) {
      const FileSegment segment = cutter.next().value();
      is_last = segment.is_last;
      EXPECT_TRUE(is_last || segment.text.ends_with("</cityObjectMember>"));
      EXPECT_LE(segment.text.size(), sizes.most);
      all += segment.text;
    }
    EXPECT_EQ(all, text);
    EXPECT_FALSE(cutter.next());
    EXPECT_EQ(segments > 1, text.size() > sizes.least) << segments;
  }
}

TEST(CityGmlSegments, EndAfterAnEndTagAlone) {
  const std::string padding(200, ' ');
  const std::string text = model(padding + "<core:cityObjectMember>" + padding + "</core:cityObjectMember>" + houses(2));
  SegmentCutter cutter(write_file("a.gml", text), {.least = 600, .most = 10'000});
  EXPECT_TRUE(cutter.next().value().text.ends_with("</core:cityObjectMember>"));
}

TEST(CityGmlSegments, AreNotMadeOfWhatIsNoCityModelOrHasNoEndInSight) {
  const auto cutter_of = [](const std::string& text) { return SegmentCutter(write_file("a.gml", text), {100, 400}); };
  for (const std::string text : {"", "no XML", "<other/>", "<CityModel", "<!-- <CityModel> -->"})
    EXPECT_THROW((void)cutter_of(text), CannotBeCut) << text;
  EXPECT_THROW((void)cutter_of("<CityModel>" + std::string(500, ' ') + "</CityModel>").next(), CannotBeCut);
}

constexpr std::string_view head = "<r>";

bool parses(std::string_view text, bool is_last = false) {
  CityGmlParser nobody([](const CityGmlBuilding&) {});
  return parse_xml_segment({head, text, is_last}, nobody);
}

TEST(CityGmlSegments, ParseWhereTheyEndBetweenChildrenOfTheRoot) {
  EXPECT_TRUE(parses("<m></m>"));
  EXPECT_TRUE(parses("text<m><a/></m><!-- - --><m></m>"));
  EXPECT_TRUE(parses(" <m></m></r>\n", true));
  for (const char* const text : {"<m>", "<m><a></a>", "<!-- <m></m>", "<![CDATA[ <m></m>", "<m></m><![CDATA[</m>", "<? <m></m>",
                                 "<m></m> text", "<m></m></r>", "</m>", "<m a=\"</m>", "<m></m><n", "<m>&#0;</m>"})
    EXPECT_FALSE(parses(text)) << text;
  EXPECT_FALSE(parses("<m></m>", true));
}

TEST(CityGmlSegments, GiveTheCityOfTheWholeFile) {
  const std::string text = model(houses(40));
  EXPECT_TRUE(is_cut(text));
  EXPECT_EQ(cut_and_read(write_file("a.gml", text)).value().city.city.buildings().size(), 40u);
  EXPECT_FALSE(is_cut(text, {})) << "a single segment";
}

TEST(CityGmlSegments, KeepTheOrderOfProblems) {
  const std::string open_ring =
      within("bldg:lod1MultiSurface gml:MultiSurface gml:surfaceMember gml:Polygon gml:exterior gml:LinearRing",
             "<gml:posList>0 0 5 9 0 5 9 9 5</gml:posList>");
  std::string text;
  for (int round = 0; round < 3; ++round)
    for (int n = 0; n < 20; ++n)
      text += n % 7 == 3 ? building("", "house " + std::to_string(n))
                         : house(n, n % 3 == 0   ? open_ring
                                    : n % 5 == 0 ? reference("x")
                                                 : "");
  EXPECT_TRUE(is_cut(model(text)));
  const Report report = cut_and_read(write_file("a.gml", model(text))).value().report;
  EXPECT_EQ(report.count(ProblemCode::repeated_id), 40u) << "across segments, and for buildings without surfaces, too";
  EXPECT_GT(report.count(ProblemCode::ring_not_closed), 0u);
  EXPECT_EQ(report.count(ProblemCode::no_geometry), 9u);
}

TEST(CityGmlSegments, CountWhatIsSkippedAndCollectTheTerrain) {
  const std::string relief = within(
      "cityObjectMember dem:ReliefFeature dem:reliefComponent dem:TINRelief dem:tin gml:TriangulatedSurface "
      "gml:trianglePatches gml:Triangle gml:exterior",
      ring("x") + ring("7"));
  std::string text;
  for (int n = 0; n < 10; ++n) text += house(n, "<uro:a/>") + relief + "<cityObjectMember><veg:PlantCover/></cityObjectMember>";
  EXPECT_TRUE(is_cut(model(text)));
  const SourceCity source = cut_and_read(write_file("a.gml", model(text))).value().city;
  EXPECT_EQ(source.relief_points.size(), 30u);
  EXPECT_EQ(source.skipped.at("PlantCover"), 10u);
}

TEST(CityGmlSegments, OfManyNamesOfSkippedThingsAreReadAsOne) {
  std::string text;
  for (std::size_t n = 0; n < SkippedCount::most_names; ++n)
    text += "<cityObjectMember><veg:Plant" + std::to_string(n) + "/></cityObjectMember>";
  EXPECT_TRUE(is_cut(model(text + houses(10))));
  EXPECT_FALSE(is_cut(model(text + houses(5) + "<cityObjectMember><veg:Tree/></cityObjectMember>" + houses(5))));
}

TEST(CityGmlSegments, OfBuildingsWithoutIdsAreReadAsOne) {
  std::string text = houses(20);
  text.insert(text.find("<cityObjectMember>", text.size() / 2),
              "<cityObjectMember>" + within("bldg:Building", surface("bldg:lod1MultiSurface", "q", "3")) + "</cityObjectMember>");
  EXPECT_FALSE(is_cut(model(text)));
}

TEST(CityGmlSegments, FollowReferencesIntoOtherSegments) {
  const std::string shared = R"(<bldg:lod1MultiSurface xlink:href="#p19"/>)";
  const std::string text = model(house(50, shared) + houses(20) + house(51, shared));
  EXPECT_TRUE(is_cut(text));
  const CityGmlContents r = cut_and_read(write_file("a.gml", text)).value();
  EXPECT_EQ(r.foreign_hrefs, std::unordered_set<std::string>{"#p19"});
  EXPECT_NE(read_on_threads(4, write_file("a.gml", text)).find("house 51 22"), std::string::npos);
}

/// A house with a chimney at a place that reads like degrees.
std::string house_with_prototype(int n) {
  return house(n, "<bldg:lod1ImplicitRepresentation><ImplicitGeometry><relativeGMLGeometry><gml:MultiSurface>" +
                      member(polygon("chimney", "1")) +
                      "</gml:MultiSurface></relativeGMLGeometry><referencePoint><gml:Point><gml:pos>1 2 3</gml:pos></gml:Point>"
                      "</referencePoint></ImplicitGeometry></bldg:lod1ImplicitRepresentation>");
}

TEST(CityGmlSegments, KnowWhetherACrsWasNamedBefore) {
  std::string named = houses(10);
  for (int n = 10; n < 20; ++n) named += house_with_prototype(n);
  EXPECT_TRUE(is_cut(model(named)));
  EXPECT_EQ(cut_and_read(write_file("a.gml", model(named))).value().report.count(ProblemCode::unsupported_geometry), 10u);

  std::string unnamed = model(named);
  unnamed.replace(unnamed.find("srsName"), 7, "ignored");
  EXPECT_TRUE(is_cut(unnamed));
  EXPECT_EQ(cut_and_read(write_file("a.gml", unnamed)).value().report.count(ProblemCode::unsupported_geometry), 0u);

  std::string named_late = unnamed;
  named_late.insert(named_late.find("house 15") + 10, R"(<gml:boundedBy><gml:Envelope srsName="EPSG:25832"/></gml:boundedBy>)");
  EXPECT_FALSE(is_cut(named_late));
}

TEST(CityGmlSegments, ThatTakeTooMuchByReferenceAreReadAsOne) {
  // 5,000,000 + 16 * 6,000 points are to be had, and each house asks 6,000 polygons without points, which count as one
  GmlSurfaces foreign;
  foreign.polygons.resize(6'000);
  for (std::size_t k = 0; k < 6'000; ++k) foreign.members.push_back({k, {}, false, 0});
  foreign.ranges["all"] = {0, 6'000, false};
  const auto is_cut_with = [&](int houses) {
    std::string text;
    for (int n = 0; n < houses; ++n) text += house(n, R"(<bldg:lod1MultiSurface xlink:href="#all"/>)");
    const InputFile file = write_file("a.gml", model(text));
    return read_in_segments({file, {}, foreign, {}, small_segments}).has_value();
  };
  EXPECT_TRUE(is_cut_with(200));
  EXPECT_FALSE(is_cut_with(900));
}

TEST(CityGmlSegments, HaveOneBudgetOfReferences) {
  ReferenceBudget whole({}), next({});
  EXPECT_TRUE(whole.take(1));
  EXPECT_TRUE(next.take(2));
  EXPECT_TRUE(whole.append(next));
  EXPECT_TRUE(next.take(next.most_points() - 2 - 2)) << "two are left in it";
  EXPECT_FALSE(whole.append(next)) << "together they have given more than there was";
  ReferenceBudget refusing({});
  EXPECT_FALSE(refusing.take(refusing.most_points() + 1));
  EXPECT_FALSE(ReferenceBudget({}).append(refusing));
}

TEST(CityGmlSegments, LieOutsideOfCommentsAndTheLike) {
  for (const auto& [begin, end] : {std::pair{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?x ", "?>"}}) {
    std::string text = houses(10);
    text.insert(text.find("<cityObjectMember>", text.size() / 2), begin + houses(10) + end);
    EXPECT_FALSE(is_cut(model(text))) << begin;
    EXPECT_TRUE(is_cut(model(text), {.least = text.size() - 100, .most = 10'000})) << begin << ": no segment ends in it";
  }
}

TEST(CityGmlSegments, OfAFileThatIsNotReadSayWhatTheWholeSays) {
  const std::string good = model(houses(20));
  const std::filesystem::path cut_short = write_file("cut.gml", good.substr(0, good.size() / 2));
  EXPECT_NE(read_on_threads(4, cut_short).find("not well-formed XML: line 1, column"), std::string::npos);
  std::string broken = good;
  broken.replace(good.find("</bldg:Building>", good.size() / 2), 16, "</bldg:Bilding>");
  std::string deep = good;
  for (int k = 0; k < 300; ++k) deep.insert(deep.find("<cityObjectMember>", good.size() / 2), "<gml:a>");
  for (const std::string& text :
       {good.substr(0, good.size() / 2), good.substr(0, good.size() - 12), good + "<more/>", broken, deep})
    EXPECT_FALSE(is_cut(text)) << text.size();
  std::string others;
  for (int n = 0; n < 20; ++n) others += "<cityObjectMember><veg:PlantCover/></cityObjectMember>";
  const std::filesystem::path vegetation = write_file("vegetation.gml", model(others));
  EXPECT_THROW((void)cut_and_read(vegetation), InputError);
  EXPECT_EQ(read_on_threads(4, vegetation), read_on_threads(1, vegetation));
}

TEST(CityGmlSegments, LargerThanAllowedAreReadAsOne) {
  const SegmentSizes sizes{.least = 100, .most = 1'000};
  EXPECT_FALSE(is_cut(model(houses(5) + house(9, std::string(2'000, ' ')) + houses(5)), sizes));
  EXPECT_TRUE(is_cut(model(houses(5) + house(9) + houses(5)), sizes));
}

TEST(CityGmlSegments, HaveTheEncodingOfTheFile) {
  std::string latin_1 =
      model(houses(5) + house(9) + building(surface("bldg:lod1MultiSurface", "a", "1"), "H\xE4user") + houses(5));
  latin_1.insert(latin_1.find("?>"), R"( encoding="ISO-8859-1")");
  EXPECT_TRUE(is_cut(latin_1));
  EXPECT_NE(read_on_threads(4, write_file("a.gml", latin_1)).find("H\xC3\xA4user"), std::string::npos);
  std::string utf_16 = "\xFF\xFE";
  for (const char c : model(houses(10))) utf_16 += {c, '\0'};
  EXPECT_FALSE(is_cut(utf_16));
}

TEST(CityGmlSegments, AreNotReadOnceAStopIsRequested) {
  const std::filesystem::path file = write_file("a.gml", model(houses(40)));
  std::stop_source source;
  source.request_stop();
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      Report report;
      EXPECT_THROW((void)read_citygml(file, {}, report, source.get_token(), small_segments), Cancelled) << threads;
    });
}

TEST(CityGmlSegments, OfRealCitiesGiveTheSame) {
  for (const char* const name : {"nrw/LoD2_32_280_5657_1_NW.gml", "formats/Building_LOD3-EPSG25832.gml"}) {
    FARLOD_NEEDS_DATA(name);
    for (const std::size_t least : {3'000u, 50'000u}) {
      const SegmentSizes sizes{.least = least, .most = std::size_t{1} << 22};
      EXPECT_EQ(read_on_threads(4, shared_data(name), sizes), read_on_threads(1, shared_data(name))) << name;
    }
  }
}

}  // namespace
}  // namespace farlod::ingest::test
