// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <numeric>

#include "farlod/error.hpp"
#include "tests/acceptance/random_towns.hpp"
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// Another reader: it takes the values out of the file again, and compares them with the tables. A semantic surface of one
/// polygon has the values of one row of its building, whose area is that of the polygon.
constexpr const char* reader = R"(
import collections, csv, json, re, sys
import xml.etree.ElementTree as tree

before, after = (open(name, 'rb').read() for name in sys.argv[1:3])
name = rb'(?:svf|roof|wall|covered|irradiation|area)_\w+'
version_2 = rb'<(?P<g>[\w.]+:)doubleAttribute(?: xmlns:gen="[^"]+")? name="' + name + \
    rb'"><(?P=g)value>[0-9.]+</(?P=g)value></(?P=g)doubleAttribute>'
version_3 = rb'<(?P<c>[\w.]*:?)genericAttribute><(?P<h>[\w.]+:)DoubleAttribute(?: xmlns:gen="[^"]+")?><(?P=h)name>' + name + \
    rb'</(?P=h)name><(?P=h)value>[0-9.]+</(?P=h)value></(?P=h)DoubleAttribute></(?P=c)genericAttribute>'
rows = collections.defaultdict(list)
for row in csv.DictReader(open('a.surfaces.csv')): rows[row['building']].append(row)
named = {building: list(of_building) for building, of_building in rows.items()}
buildings = {row['building']: row for row in csv.DictReader(open('a.buildings.csv'))}
found = collections.Counter(rows=sum(map(len, rows.values())), buildings=0, surfaces=0, single=0, of_one_polygon=0, areas=0, wrong=0, lit=0,
    named=0, misnamed=0, unnamed=0)
found['same'] = re.sub(version_2 + b'|' + version_3, b'', after) == before

def local(element): return element.tag.split('}')[1]
def values_of(element):
    pairs = [(c.get('name'), c[0].text) for c in element if local(c) == 'doubleAttribute']
    return dict(pairs + [(c[0][0].text, c[0][1].text) for c in element if local(c) == 'genericAttribute'])
def id_of(element): return next((v for k, v in element.items() if k.endswith('}id')), None)

city = tree.fromstring(after)
by_id = {id_of(e): e for e in city.iter() if id_of(e)}

def polygons_of(element):
    for child in element:
        if local(child) == 'Polygon': yield child
        elif child.get('{http://www.w3.org/1999/xlink}href'):
            target = by_id[child.get('{http://www.w3.org/1999/xlink}href')[1:]]
            yield from [target] if local(target) == 'Polygon' else polygons_of(target)
        elif local(child) not in ('opening', 'fillingSurface'): yield from polygons_of(child)
def area_of(polygon):
    total = [0.0, 0.0, 0.0]
    for ring in (e for e in polygon.iter() if local(e) == 'LinearRing'):
        numbers = [float(x) for e in ring.iter() if local(e) in ('posList', 'pos') for x in e.text.split()]
        points = [[numbers[i + k] - numbers[k] for k in range(3)] for i in range(0, len(numbers), 3)]
        for p, q in zip(points, points[1:]):
            for k in range(3): total[k] += 0.5 * (p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3])
    return sum(x * x for x in total) ** 0.5

def compare_surface(surface, values, building):
    of_table = ('svf_mean', 'svf_min', 'svf_max', 'area_m2', 'covered_area_m2')
    of_light = ('irradiation_mean', 'irradiation_kwh', 'area_above_m2')
    mine = [values.get(k, '') for k in ('svf_mean', 'svf_min', 'svf_max', 'svf_area_m2', 'covered_area_m2', *of_light)]
    same = [row for row in rows[building] if [row[k] for k in of_table] + [row.get(k, '') for k in of_light] == mine]
    found['lit'] += ('irradiation_kwh' in values) == ('svf_mean' in values)
    polygons = list(polygons_of(surface))
    found['surfaces'] += 1
    if same: found['single'] += 1; rows[building].remove(same[0])
    if len(polygons) != 1: return
    found['of_one_polygon'] += 1
    found['wrong'] += not same
    called = id_of(surface) or id_of(polygons[0])
    own = [row for row in named[building] if row['surface_id'] == called]
    found['named'] += len(own) == 1 and [own[0][k] for k in of_table] == mine[:5]
    found['misnamed'] += len(own) == 1 and [own[0][k] for k in of_table] != mine[:5]
    found['unnamed'] += not own and called is not None
    area = area_of(polygons[0])
    found['areas'] += abs(float(mine[3]) + float(mine[4]) - area) <= 0.02 * area + 0.05

def walk(element, building):
    values = values_of(element)
    if building is None and local(element) in ('Building', 'Bridge'):
        building = id_of(element)
        found['buildings'] += 'roof_area_m2' in values or 'wall_area_m2' in values
        if building in buildings:
            found['wrong'] += any(v != values.get(k, '') for k, v in buildings[building].items()
                                  if k in ('svf_roofs', 'svf_walls') or 'irradiation' in k or 'above' in k or (v != '0' and k.endswith('area_m2')))
    elif 'svf_area_m2' in values: compare_surface(element, values, building)
    for child in element: walk(child, building)
walk(city, None)
found['rows_of_several'] = sum(map(len, rows.values()))
found['buildings_of_run'] = len(buildings)
json.dump(found, open('found.json', 'w'))
)";

class EnrichedCityGml : public RealCity {
 protected:
  void SetUp() override {
    if (folder.run("python3 -c 'import xml.etree.ElementTree'").exit_code != 0)
      GTEST_SKIP() << "no python3, which reads the files";
  }
  /// Packs a city, writes it again with its values, and compares them with the tables. Returns what there is.
  [[nodiscard]] nlohmann::json enriched(const std::string& file, const std::string& pack_options = "",
                                        const std::string& svf_options = "") const {
    const std::string spacing = " --surfaces all --spacing 3" + svf_options;
    folder.must("farlod-pack " + file + " -o a.farlod --quiet --crs EPSG:25832 " + pack_options);
    folder.must("farlod-svf a.farlod -o a.gml --city " + file + spacing);
    folder.must("farlod-svf a.farlod -o a.csv --quiet" + spacing);
    folder.write("read.py", reader);
    folder.must("python3 read.py " + file + " a.gml");
    return folder.json_of("found.json");
  }
  /// The city is the same when it is packed once more, but for the places in its file.
  void expect_same_city(const std::string& pack_options = "") const {
    folder.must("farlod-pack a.gml -o b.farlod --quiet --crs EPSG:25832 " + pack_options);
    folder.must("diff -r --exclude=manifest.json --exclude=sources.bin a.farlod b.farlod");
  }
};

struct CityGmlCase {
  const char* file;
  std::size_t surfaces;  ///< semantic surfaces with values
  std::size_t single;    ///< of them those that have the values of one row
};
void PrintTo(const CityGmlCase& city, std::ostream* out) { *out << city.file; }

class EnrichedRealCityGml : public EnrichedCityGml, public testing::WithParamInterface<CityGmlCase> {};

TEST_P(EnrichedRealCityGml, HasTheValuesOfTheTables) {
  needs({GetParam().file});
  if (IsSkipped()) return;
  const nlohmann::json found = enriched(data(GetParam().file));
  EXPECT_TRUE(found.at("same").get<bool>());
  EXPECT_EQ(found.at("wrong"), 0);
  // The id in the table leads to the surface with the values of its row
  EXPECT_EQ(found.at("misnamed"), 0);
  EXPECT_EQ(found.at("unnamed"), 0);
  EXPECT_GT(found.at("named"), GetParam().single / 2);
  EXPECT_EQ(found.at("buildings"), found.at("buildings_of_run"));
  EXPECT_EQ(found.at("surfaces"), GetParam().surfaces);
  EXPECT_EQ(found.at("single"), GetParam().single);
  // Slivers and bent polygons have another area in the package
  EXPECT_GE(found.at("areas").get<double>(), 0.95 * found.at("of_one_polygon").get<double>());
  expect_same_city();
}

INSTANTIATE_TEST_SUITE_P(Files, EnrichedRealCityGml,
                         testing::Values(CityGmlCase{"nrw/LoD2_32_280_5657_1_NW.gml", 956, 935},
                                         CityGmlCase{"nrw/LoD2_32_280_5659_1_NW.gml", 1227, 1185},
                                         CityGmlCase{"formats/citygml10_lod2.gml", 600, 600},
                                         CityGmlCase{"formats/citygml20_lod2.gml", 600, 600},
                                         CityGmlCase{"formats/citygml30_lod2.gml", 600, 600},
                                         CityGmlCase{"formats/Building_and_garage_LOD2-EPSG25832.gml", 10, 9},
                                         CityGmlCase{"formats/Building_LOD3-EPSG25832.gml", 9, 5}));

TEST_F(EnrichedCityGml, AGeneratedCityHasAllValues) {
  folder.must("farlod-city -o town.gml --size 150 --lod 2 --facade-details --quiet");
  const nlohmann::json found = enriched("town.gml");
  EXPECT_TRUE(found.at("same").get<bool>());
  EXPECT_EQ(found.at("wrong"), 0);
  EXPECT_EQ(found.at("buildings"), found.at("buildings_of_run"));
  EXPECT_GT(found.at("surfaces"), 500);
  EXPECT_EQ(found.at("areas"), found.at("of_one_polygon"));
  expect_same_city();
}

TEST_F(EnrichedCityGml, AGeneratedCityHasItsIrradiation) {
  folder.must("farlod-city -o town.gml --size 150 --lod 2 --quiet");
  const nlohmann::json found =
      enriched("town.gml", "", " --quantity irradiation --period 2026-06-21 --step 60 --irradiation-threshold 5");
  EXPECT_TRUE(found.at("same").get<bool>());
  EXPECT_EQ(found.at("wrong"), 0);
  EXPECT_GT(found.at("surfaces"), 50);
  EXPECT_EQ(found.at("lit"), found.at("surfaces"));
}

/// The faces of a box: floor, roof, and walls.
std::vector<std::string> box(const std::string& id, double x, double edge, double height) {
  const double y = 5500000, e = x + edge, n = y + edge + 2;
  const auto face = [&](int k, const Corners& corners) { return gml_polygon(corners, id + std::to_string(k)); };
  return {face(0, {{x, y, 0}, {x, n, 0}, {e, n, 0}, {e, y, 0}}),
          face(1, {{x, y, height}, {e, y, height}, {e, n, height}, {x, n, height}}),
          face(2, {{x, y, 0}, {e, y, 0}, {e, y, height}, {x, y, height}}),
          face(3, {{e, y, 0}, {e, n, 0}, {e, n, height}, {e, y, height}}),
          face(4, {{e, n, 0}, {x, n, 0}, {x, n, height}, {e, n, height}}),
          face(5, {{x, n, 0}, {x, y, 0}, {x, y, height}, {x, n, height}})};
}
std::vector<std::string> references(const std::string& id) {
  std::vector<std::string> members;
  for (int face = 0; face < 6; ++face) members.push_back(gml_reference(id + std::to_string(face)));
  return members;
}
std::string solid(const std::vector<std::string>& members, int lod = 2) {
  const std::string property = "bldg:lod" + std::to_string(lod) + "Solid>";
  return "<" + property + gml_solid(std::accumulate(members.begin(), members.end(), std::string())) + "</" + property;
}
std::string boundaries(const std::vector<std::string>& faces) {
  std::string text;
  for (std::size_t k = 0; k < faces.size(); ++k)
    text += gml_boundary(k == 0   ? "GroundSurface"
                         : k == 1 ? "RoofSurface"
                                  : "WallSurface",
                         "><gml:name>" + std::to_string(k) + "</gml:name>", faces[k]) +
            "\r\n";
  return text;
}

/// Ways to write a box, each in a building of its own.
std::string strange_town(const std::string& encoding) {
  std::vector<std::string> shared = box("s", 500180, 11, 9);
  shared[3] = gml_reference("p5");
  return gml_model(gml_building("H\xe4user", solid(references("h")) + boundaries(box("h", 500000, 7, 5))) +
                       gml_building("refers", solid(box("r", 500020, 8, 6)) + boundaries(references("r"))) +
                       gml_building("copies", boundaries(box("c", 500040, 9, 7)) + solid(box("d", 500040, 9, 7))) +
                       gml_building("levels", solid(box("e", 500060, 12, 4), 1) + boundaries(box("f", 500060, 13, 5))) +
                       gml_building("parts", solid(box("q", 500080, 14, 3)) + gml_part(boundaries(box("p", 500100, 10, 8)))) +
                       gml_building("shares", boundaries(shared)),
                   encoding);
}

TEST_F(EnrichedCityGml, EachWayToWriteABoxHasItsValues) {
  folder.write("town.xml", strange_town("ISO-8859-1"));
  const nlohmann::json found = enriched("town.xml");
  EXPECT_TRUE(found.at("same").get<bool>());
  EXPECT_EQ(found.at("wrong"), 0);
  EXPECT_EQ(found.at("buildings"), 6);
  // A roof and four walls of six boxes, but for the wall that another building has
  EXPECT_EQ(found.at("surfaces"), 29);
  EXPECT_EQ(found.at("single"), 29);
  EXPECT_EQ(found.at("areas"), 29);
  expect_same_city();
}

TEST_F(EnrichedCityGml, TheLevelOfDetailOfThePackageGetsTheValues) {
  folder.write("town.xml", strange_town("ISO-8859-1"));
  const nlohmann::json found = enriched("town.xml", "--lod 1");
  EXPECT_EQ(found.at("buildings"), 1) << "one building has a level 1, which is a solid";
  EXPECT_EQ(found.at("surfaces"), 0);
  EXPECT_THAT(folder.run("farlod-svf a.farlod -o b.gml --surfaces all --spacing 3 --city town.xml").out,
              HasSubstr("5 surfaces with values have no semantics of their own"));
}

TEST_F(EnrichedCityGml, WhatDoesNotFitIsRefused) {
  folder.write("town.gml", strange_town("ISO-8859-1"));
  folder.must("farlod-pack town.gml -o a.farlod --quiet --crs EPSG:25832");
  const std::string run = "farlod-svf a.farlod --surfaces all --spacing 3 --city ";
  expect_refusal(folder.run(run + "town.gml -o o.csv"), exit_usage, {"-o", ".gml, .xml or .citygml"});
  expect_refusal(folder.run(run + "town.gml -o o.city.json"), exit_unusable_input,
                 {"o.city.json", "town.gml is CityGML", "ends in .gml, .xml or .citygml"});
  expect_refusal(folder.run("farlod-svf a.farlod --surfaces all --spacing 3 -o o.gml"), exit_usage, {"-o", "--city"});
  folder.must("sed 's/ 500000/ 500001/' town.gml > edited.gml");
  expect_refusal(folder.run(run + "edited.gml -o o.gml"), exit_unusable_input,
                 {"edited.gml is not a file that a.farlod was made of"});
  folder.must("farlod-svf a.farlod -o o.gml --city town.gml --surfaces all --spacing 3");
  folder.must("farlod-pack o.gml -o o.farlod --quiet --crs EPSG:25832");
  expect_refusal(folder.run("farlod-svf o.farlod --surfaces all --spacing 3 --city o.gml -o twice.gml"), exit_unusable_input,
                 {"o.gml", "already", "as it was before"});
  EXPECT_FALSE(folder.has("twice.gml"));
}

TEST_F(EnrichedCityGml, Utf16IsRefused) {
  folder.write("town.gml", strange_town("UTF-16"));
  folder.must("iconv -f ISO-8859-1 -t UTF-16 town.gml > wide.gml");
  folder.must("farlod-pack wide.gml -o a.farlod --quiet --crs EPSG:25832");
  expect_refusal(folder.run("farlod-svf a.farlod --surfaces all --spacing 3 --city wide.gml -o o.gml"), exit_unusable_input,
                 {"wide.gml is UTF-16", "convert it to UTF-8"});
}

}  // namespace
}  // namespace farlod::acceptance
