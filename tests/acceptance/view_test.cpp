// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// farlod-view, as users start it
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "tests/acceptance/packed_town.hpp"

namespace farlod::acceptance {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Starts the program, asks for addresses below it one after the other, and ends it. The answers are in 0, 1, ...
std::string asking(const std::vector<std::string>& addresses, const std::string& options = "") {
  std::string text = "farlod-view a.farlod " + options +
                     " > said.txt 2> error.txt & viewer=$!\n"
                     "until grep -q http said.txt || ! kill -0 $viewer; do sleep 0.1; done\n"
                     "root=$(head -n 1 said.txt)\n";
  for (std::size_t n = 0; n < addresses.size(); ++n)
    text += "python3 -c 'import sys, urllib.request as u; sys.stdout.buffer.write(u.urlopen(sys.argv[1]).read())' \"${root}" +
            addresses[n] + "\" > " + std::to_string(n) + " || { kill $viewer; exit 1; }\n";
  return text + "kill $viewer; wait $viewer";
}

class View : public PackedTown {
 protected:
  [[nodiscard]] Outcome ask(const std::vector<std::string>& addresses, const std::string& options = "") const {
    return folder.run(asking(addresses, options));
  }
};

TEST_F(View, ServesThePageAndTheCity) {
  const Outcome outcome = ask({"", "viewer.js", "view.json", "tiles/0/0/0.glb"}, "--summary s.json");
  EXPECT_EQ(outcome.exit_code, exit_interrupted + 15) << outcome.err;
  EXPECT_THAT(folder.text_of("said.txt"), StartsWith("http://127.0.0.1:"));
  EXPECT_EQ(folder.text_of("error.txt"), "");
  EXPECT_THAT(folder.text_of("0"), HasSubstr("viewer.js"));
  EXPECT_EQ(folder.text_of("1"), folder.text_of(std::string(FARLOD_SOURCE_DIR) + "/viewer/bundle/viewer.js"));
  EXPECT_EQ(folder.json_of("2").at("counts").at("buildings"), 36);
  EXPECT_THAT(folder.text_of("3"), StartsWith("glTF"));
  EXPECT_EQ(folder.json_of("s.json").at("requests"), 4);
  EXPECT_EQ(folder.json_of("s.json").at("settings").at("PACKAGE"), "a.farlod");
}

TEST_F(View, AnswersAsFarlodSvfDoes) {
  const std::string place = text_of(p_projected({-60.0, 0.0}));
  const std::size_t comma = place.find(',');
  EXPECT_EQ(ask({"at?x=" + place.substr(0, comma) + "&y=" + place.substr(comma + 1)}).exit_code, exit_interrupted + 15);
  folder.must("farlod-svf a.farlod -o at.csv --at " + place);
  EXPECT_THAT(folder.text_of("at.csv"), HasSubstr(folder.json_of("0").at("text").get<std::string>() + "\n"));
}

TEST_F(View, OtherMachinesAreServedIfAskedFor) {
  (void)ask({"view.json"}, "--listen 127.0.0.2 --quiet");
  EXPECT_THAT(folder.text_of("said.txt"), StartsWith("http://127.0.0.2:"));
  EXPECT_EQ(lines_of(folder.text_of("said.txt")).size(), 1U) << "--quiet: only what scripts need";
  EXPECT_THAT(folder.text_of("error.txt"), HasSubstr("other machines"));
}

TEST_F(View, ExportsFilesForAnyServer) {
  folder.must("farlod-view a.farlod --export page --summary s.json --quiet");
  EXPECT_FALSE(folder.json_of("page/view.json").at("can_answer").get<bool>());
  EXPECT_EQ(folder.json_of("s.json").at("tiles").get<std::size_t>(), lines_of(folder.run("find page -name '*.glb'").out).size());
  for (const char* name : {"page/index.html", "page/viewer.js", "page/viewer.css", "page/tileset.json",
                           "page/subtrees/0.0.0.subtree", "page/tiles/0/0/0.glb"})
    EXPECT_TRUE(folder.has(name)) << name;
  folder.must("farlod-view a.farlod --export page --quiet --threads 1 && cp -r page again");
  folder.must("farlod-view a.farlod --export page --quiet && diff -r page again");
}

TEST_F(View, DrawsResultsBesideThePackage) {
  folder.must("farlod-svf a.farlod -o svf.tif --grid 5 && farlod-svf a.farlod -o at.csv --at " +
              text_of(p_projected({-60.0, 0.0})));
  folder.must("farlod-pack town.geojson -o b.farlod --report problems.geojson --quiet");
  folder.must(
      "farlod-svf a.farlod -o walls.csv --surfaces all --spacing 5 && farlod-svf a.farlod -o walls.gpkg --surfaces all --spacing "
      "5");
  folder.must("farlod-view a.farlod svf.tif at.csv:svf problems.geojson walls.surfaces.csv walls.gpkg --export page --quiet");
  const json results = folder.json_of("page/view.json").at("results");
  ASSERT_EQ(results.size(), 5U);
  EXPECT_EQ(results[0].at("form"), "raster");
  EXPECT_EQ(folder.text_of("page/results/0").size(),
            results[0].at("width").get<std::size_t>() * results[0].at("height").get<std::size_t>() * sizeof(float));
  EXPECT_EQ(results[1].at("form"), "points");
  EXPECT_EQ(folder.json_of("page/results/1.json").size(), 1U);
  EXPECT_EQ(results[2].at("form"), "problems");
  EXPECT_EQ(results[3].at("form"), "surfaces");
  EXPECT_EQ(folder.json_of("page/results/3.json").size(), 36U) << "all buildings";
  EXPECT_EQ(folder.json_of("page/results/4.json"), folder.json_of("page/results/3.json")) << "whatever the format";
  EXPECT_EQ(results[4].at("count"), results[3].at("count"));
}

/// Writes the files that a page carries to the folder `carried`.
constexpr const char* unpack_page =
    "python3 -c 'import base64, gzip, os, re\n"
    "for name, text in re.findall(r\"<script type=.text/plain. data-file=.([^>]*).>([^<]*)</script>\", "
    "open(\"town.html\").read()):\n"
    "  os.makedirs(os.path.dirname(\"carried/\" + name), exist_ok=True)\n"
    "  open(\"carried/\" + name, \"wb\").write(gzip.decompress(base64.b64decode(text, validate=True)))'";

TEST_F(View, ExportsOnePageWithAllThatTheFolderHas) {
  folder.must("farlod-view a.farlod --export town.html --summary s.json --quiet");
  folder.must("farlod-view a.farlod --export page --quiet");
  folder.must(unpack_page);
  const std::string html = folder.text_of("town.html");
  for (const char* name : {"viewer.js", "viewer.css", "licences.txt"})
    EXPECT_THAT(html, HasSubstr(folder.text_of(std::string("page/") + name))) << name;
  for (const char* request : {"src=\"", "rel=\"preload\"", "rel=\"stylesheet\""})
    EXPECT_EQ(html.find(request), std::string::npos) << request;
  EXPECT_THAT(html, HasSubstr("Content-Security-Policy"));
  folder.must("rm page/index.html page/viewer.js page/viewer.css page/licences.txt && diff -r page carried");
  EXPECT_EQ(folder.json_of("s.json").at("bytes"), html.size());
  folder.must("farlod-view a.farlod --export again.HTM --quiet --threads 1 && cmp town.html again.HTM");
}

TEST_F(View, ASignalEndsAnExportAndLeavesNothing) {
  folder.must("farlod-city -o city.obj --size 1500 --quiet && farlod-pack city.obj -o city.farlod --crs EPSG:32632 --quiet");
  for (const char* name : {"city_page", "city.html"}) {
    const std::string begun = "until ls -A | grep -q '" + std::string(name) + ".'; do sleep .01; done";
    // What watches it has the core first, however busy the machine is: the export must not come to its end before the signal
    const Outcome outcome = folder.run("nice -n 19 farlod-view city.farlod --export " + std::string(name) + " & p=$!; " + begun +
                                       "; kill -TERM $p; wait $p");
    EXPECT_EQ(outcome.exit_code, exit_interrupted + 15);
    EXPECT_THAT(outcome.err, HasSubstr("interrupted. Nothing was written."));
    EXPECT_EQ(folder.run("ls -A | grep " + std::string(name)).out, "");
  }
}

TEST_F(View, ExportsReplaceNothingElse) {
  folder.must("mkdir mine && touch mine/photo.jpg");
  expect_refusal(folder.run("farlod-view a.farlod --export mine --quiet"), exit_unusable_input, {"mine"});
  EXPECT_TRUE(folder.has("mine/photo.jpg"));
  folder.must("mv mine mine.html");
  expect_refusal(folder.run("farlod-view a.farlod --export mine.html --quiet"), exit_unusable_input, {"mine.html", "folder"});
  EXPECT_TRUE(folder.has("mine.html/photo.jpg"));
}

TEST_F(View, WrongUseIsToldInOneLine) {
  expect_refusal(folder.run("farlod-view b.farlod"), exit_unusable_input, {"b.farlod", "farlod-pack"});
  expect_refusal(folder.run("farlod-view a.farlod nowhere.tif"), exit_unusable_input, {"nowhere.tif", "does not exist"});
  expect_refusal(folder.run("farlod-view a.farlod --port 99999"), exit_usage, {"--port"});
  expect_refusal(folder.run("farlod-view a.farlod --export x --port 8000"), exit_usage, {"--export", "--port"});
  expect_refusal(folder.run("farlod-view a.farlod --export nowhere/x.html"), exit_unusable_input, {"nowhere"});
  expect_refusal(folder.run("farlod-view a.farlod --listen 192.0.2.1"), exit_unusable_input, {"192.0.2.1"});
}

}  // namespace
}  // namespace farlod::acceptance
