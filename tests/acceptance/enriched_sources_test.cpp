// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/acceptance/random_towns.hpp"

namespace farlod::acceptance {
namespace {

// ---- What the package says of its sources

class SourcesOfPackage : public EnrichedRandomCity {
 protected:
  SourcesOfPackage() { folder.write("town.gml", CityGmlTown(1).text()); }
  void pack(const std::string& options) const { folder.must("farlod-pack town.gml --quiet --crs EPSG:25832 " + options); }
  [[nodiscard]] Outcome enrich(const std::string& options) const {
    return folder.run("farlod-svf a.farlod --surfaces all --quiet " + options);
  }
  void edit_manifest(const std::function<void(json&)>& edit) const {
    std::string text = folder.text_of("a.farlod/manifest.json");
    json manifest = json::parse(text);
    manifest.erase("xxh3");
    edit(manifest);
    folder.write("a.farlod/manifest.json", scenes::sealed(manifest.dump(1) + "\n"));
  }
};

TEST_F(SourcesOfPackage, AreTheSameForAnyThreadsAndShards) {
  pack("-o a.farlod --threads 1 --cell 10");
  pack("-o b.farlod --threads 4 --cell 10");
  for (const char* shard : {"1/2", "0/2"}) pack("-o c.farlod --cell 10 --shard " + std::string(shard));
  folder.must("farlod-pack -o c.farlod --merge --quiet");
  EXPECT_TRUE(folder.has("a.farlod/sources.bin"));
  pack("-o b.farlod --threads 4 --cell 10 --force");
  folder.must("diff -r a.farlod b.farlod && diff -r a.farlod c.farlod");
}

TEST_F(SourcesOfPackage, AreChecked) {
  pack("-o a.farlod");
  EXPECT_EQ(folder.run("farlod-info a.farlod --check").exit_code, exit_done);
  std::string bytes = folder.text_of("a.farlod/sources.bin");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  folder.write("a.farlod/sources.bin", bytes);
  const Outcome checked = folder.run("farlod-info a.farlod --check");
  EXPECT_EQ(checked.exit_code, exit_damaged_package);
  EXPECT_THAT(checked.out + checked.err, testing::HasSubstr("sources.bin"));
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_damaged_package, {"sources.bin", "damaged"});
  EXPECT_EQ(enrich("-o b.csv").exit_code, exit_done) << "who does not ask for places does not read them";
}

TEST_F(SourcesOfPackage, OlderPackagesDoNotSayThem) {
  pack("-o a.farlod");
  edit_manifest([](json& manifest) {
    manifest["version"] = 8;
    manifest.erase("sources");
  });
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_unusable_input,
                 {"a.farlod has format version 8", "town.gml", "pack the file again"});
  EXPECT_EQ(enrich("-o b.csv").exit_code, exit_done);
}

TEST_F(SourcesOfPackage, APackedFileHasNone) {
  folder.must("gzip -k town.gml && farlod-pack town.gml.gz -o a.farlod --quiet --crs EPSG:25832");
  EXPECT_FALSE(folder.has("a.farlod/sources.bin"));
  expect_refusal(enrich("--city town.gml.gz -o b.gml"), exit_unusable_input, {"town.gml.gz has no places", "archive"});
  expect_refusal(enrich("--city town.gml -o b.gml"), exit_unusable_input, {"town.gml is not a file that a.farlod was made of"});
}

TEST_F(SourcesOfPackage, OfSeveralFilesEachComesBackByItself) {
  const CityJsonTown other(2);
  std::string renamed = other.text();
  for (std::size_t at = renamed.find("\"b"); at != renamed.npos; at = renamed.find("\"b", at + 1))
    if (std::isdigit(static_cast<unsigned char>(renamed[at + 2])) != 0) renamed.replace(at, 2, "\"c");
  folder.write("other.city.json", renamed);
  folder.must("farlod-pack town.gml other.city.json -o a.farlod --quiet --crs EPSG:25832");
  for (const std::string& name : {std::string("town.gml"), std::string("other.city.json")})
    EXPECT_EQ(enrich("--city " + name + " -o out_" + name).exit_code, exit_done);
  EXPECT_TRUE(std::regex_replace(folder.text_of("out_town.gml"), gml_attribute, "") == folder.text_of("town.gml"));
  EXPECT_TRUE(without_values(folder.text_of("out_other.city.json")) == renamed);
  EXPECT_THAT(folder.text_of("out_other.city.json"), testing::HasSubstr("\"svf_mean\":"));
  EXPECT_THAT(folder.text_of("out_town.gml"), testing::HasSubstr("\"svf_mean\""));
}

TEST_F(SourcesOfPackage, BuildingsThatShareAnIdGetNothing) {
  std::string text = folder.text_of("town.gml");
  for (const char* id : {"\"b1\"", "\"b2\""}) text.replace(text.find(id), 4, "\"b0\"");
  folder.write("town.gml", text);
  pack("-o a.farlod");
  const Outcome outcome = folder.run("farlod-svf a.farlod --surfaces all --city town.gml -o b.gml");
  EXPECT_THAT(outcome.out, testing::HasSubstr("3 buildings share their ids with others of the package"));
  const std::string after = folder.text_of("b.gml");
  EXPECT_TRUE(after.substr(0, text.find("\"b3\"")) == text.substr(0, text.find("\"b3\"")));
}

}  // namespace
}  // namespace farlod::acceptance
