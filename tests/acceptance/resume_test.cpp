// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <csignal>
#include <string>

#include "farlod/error.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;

/// Interrupted, resumed and divided runs of both programs, as a user types them.
class InterruptedRuns : public testing::Test {
 protected:
  InterruptedRuns() { add_packed_town(folder, "interrupted", small_town(), "--cell 10"); }
  /// What watches a program has the core first, however busy the machine is: a run must not come to its end before the signal.
  static constexpr const char* politely = "nice -n 19 ";
  /// A shell command that becomes a program and is asked to end, as soon as a file of this name is there. Not in the background,
  /// where a shell has its programs ignore Ctrl-C.
  [[nodiscard]] static std::string signalled_once(const std::string& signal, const std::string& file,
                                                  const std::string& program) {
    return "sh -c '(until test -e " + file + "; do sleep .01; done; kill -" + signal + " $$) & exec " + politely + program + "'";
  }
  /// The same, of the last program in the background.
  [[nodiscard]] static std::string signal_once(const std::string& signal, const std::string& file) {
    return " & p=$!; until test -e " + file + "; do sleep .01; done; kill -" + signal + " $p; wait $p";
  }
  WorkFolder folder;
};

const std::string fine_grid = "farlod-svf a.farlod --grid .1 --engine exact --rays 2000 ";

TEST_F(InterruptedRuns, EndCleanlyWhenTheyAreAskedTo) {
  for (const auto& [signal, number] : {std::pair("TERM", SIGTERM), std::pair("INT", SIGINT), std::pair("HUP", SIGHUP)}) {
    const Outcome outcome = folder.run("rm -rf svf.tif.unfinished; " +
                                       signalled_once(signal, "svf.tif.unfinished/answers", fine_grid + "-o svf.tif --quiet"));
    EXPECT_EQ(outcome.exit_code, 128 + number) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
    for (const std::string& name : folder.names()) EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
    EXPECT_FALSE(folder.has("svf.tif"));
  }
  const Outcome packing = folder.run(politely + std::string("farlod-pack town.geojson --cell 5 -o b.farlod --quiet") +
                                     signal_once("TERM", "b.farlod.unfinished/finished/-2_-2.json"));
  EXPECT_EQ(packing.exit_code, 143) << packing.err;
  EXPECT_FALSE(folder.has("b.farlod"));
  EXPECT_TRUE(folder.has("b.farlod.unfinished"));
}

TEST_F(InterruptedRuns, ThatOnlyEstimateKeepNothing) {
  // As soon as it has mapped the city
  const Outcome outcome = folder.run(politely + fine_grid +
                                     "-o svf.tif --dry-run & p=$!; until grep -q a.farlod /proc/$p/maps; do sleep .01; done; "
                                     "kill -TERM $p; wait $p");
  EXPECT_EQ(outcome.exit_code, 143) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted. Nothing was kept."));
  EXPECT_FALSE(folder.has("svf.tif.unfinished"));
}

TEST_F(InterruptedRuns, TellReadersThatAPackageIsNotFinished) {
  folder.must("mkdir b.farlod.unfinished");
  expect_refusal(folder.run("farlod-info b.farlod"), exit_unusable_input, {"b.farlod is not finished", "goes on"});
}

TEST_F(InterruptedRuns, GoOnOnlyWithTheSameOptionsWhereThatIsAsked) {
  folder.must("farlod-svf a.farlod --grid 2 -o svf.tif --shard 0/2 --quiet");
  expect_refusal(folder.run("farlod-svf a.farlod --grid 2 --height 3 -o svf.tif --shard 0/2"), exit_unusable_input,
                 {"--height was 1.5, and is 3"});
  expect_refusal(folder.run("farlod-svf a.farlod --grid 2 -o svf.tif --shard 1/3"), exit_unusable_input,
                 {"in 2 shards, and --shard says 3"});
  expect_refusal(folder.run("farlod-svf a.farlod --grid 2 -o svf.tif --merge"), exit_unusable_input, {"missing: 1/2"});
  folder.must("farlod-svf a.farlod --grid 2 -o svf.tif --shard 1/2 --quiet");
  expect_refusal(folder.run("farlod-svf a.farlod --grid 2 --bounds -o svf.tif --merge"), exit_unusable_input,
                 {"--bounds was not given, and is on"});
  folder.must("farlod-svf a.farlod --grid 2 -o svf.tif --merge --quiet");
  folder.must("farlod-svf a.farlod --grid 2 -o one.tif --quiet");
  EXPECT_EQ(folder.text_of("svf.tif"), folder.text_of("one.tif"));
  EXPECT_FALSE(folder.has("svf.tif.unfinished"));
}

TEST_F(InterruptedRuns, OfEveryKindOfReceiversComeTogether) {
  folder.write("points.csv", "x,y\n500000,5500000\n500050,5500050\n500100,5500020\n499900,5499990\n");
  for (const std::string receivers :
       {"--points points.csv -o X.csv", "--surfaces all --spacing 2 -o X.gpkg",
        "--grid 3 --bounds --quantity svf,directional -o X.nc", "--surfaces roofs --spacing 3 -o X.ply"}) {
    const auto command = [&](const std::string& name) {
      std::string text = "farlod-svf a.farlod --quiet " + receivers;
      return text.replace(text.find("-o X"), 4, "-o " + name);
    };
    folder.must(command("one"));
    for (const char* shard : {"0/3", "2/3", "1/3"}) folder.must(command("many") + " --shard " + shard);
    folder.must(command("many") + " --merge");
    const std::string ending = receivers.substr(receivers.find("X.") + 1);
    std::string one = folder.text_of("one" + ending), many = folder.text_of("many" + ending);
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(one.size(), many.size()) << receivers;
  }
}

TEST_F(InterruptedRuns, OnAFullDiskGoOnLater) {
  // What may be written to a file at the most stands in for a disk
  const std::string pack = "farlod-pack town.geojson --cell 10 -o b.farlod --quiet";
  const Outcome full = folder.run("trap '' XFSZ; ulimit -f 4; " + pack);
  EXPECT_EQ(full.exit_code, exit_unusable_input);
  EXPECT_THAT(full.err, HasSubstr("cannot be written"));
  EXPECT_FALSE(folder.has("b.farlod"));
  folder.must(pack);
  EXPECT_EQ(folder.text_of("b.farlod"), folder.text_of("a.farlod"));
  EXPECT_FALSE(folder.has("b.farlod.unfinished"));
}

TEST_F(InterruptedRuns, OfTwoProcessesTheSecondOneIsTold) {
  const std::string first =
      fine_grid + "-o svf.tif --quiet & p=$!; until test -e svf.tif.unfinished/answers; do sleep .01; done; ";
  const Outcome second = folder.run(first + fine_grid + "-o svf.tif; code=$?; kill -KILL $p; wait $p; exit $code");
  EXPECT_EQ(second.exit_code, exit_busy);
  EXPECT_THAT(second.err, HasSubstr("another process is at work on svf.tif.unfinished/answers"));
}

TEST_F(InterruptedRuns, WrongShardsAreUsageErrors) {
  for (const std::string program : {"farlod-pack town.geojson -o b.farlod", "farlod-svf a.farlod --grid 2 -o svf.tif"})
    for (const auto& [shard, said] :
         {std::pair("8/8", "count from 0 to 7"), std::pair("3", "I/N"), std::pair("auto", "SLURM_ARRAY_TASK_ID")})
      expect_refusal(folder.run(program + " --shard " + shard), exit_usage, {"--shard", said});
  expect_refusal(folder.run("farlod-svf a.farlod --at 500000,5500000 -o b.csv --shard 0/2"), exit_usage, {"--shard", "--grid"});
}

/// A package that is replaced while somebody reads it stays as it was for him.
TEST_F(InterruptedRuns, ReadersOfAReplacedPackageComeToTheirEnd) {
  const std::string command = "farlod-svf a.farlod --grid .5 --engine exact --rays 500 --quiet -o ";
  folder.must(command + "expected.tif");
  const Outcome outcome = folder.run(
      politely + command + "read.tif & p=$!; until test -s read.tif.unfinished/answers; do sleep .01; done; kill -STOP $p; " +
      "farlod-pack town.geojson --cell 20 -o a.farlod --force; kill -CONT $p; wait $p");
  EXPECT_EQ(outcome.exit_code, exit_done) << outcome.err;
  EXPECT_EQ(folder.text_of("read.tif"), folder.text_of("expected.tif"));
  EXPECT_THAT(outcome.out, HasSubstr("still being read"));
  EXPECT_TRUE(folder.has("a.farlod.replaced-1"));
  folder.must("farlod-pack town.geojson --cell 30 -o a.farlod --force");
  EXPECT_FALSE(folder.has("a.farlod.replaced-1"));
}

}  // namespace
}  // namespace farlod::acceptance
