// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "base/shard_parts.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/unfinished_package.hpp"
#include "pipeline/pack_target.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/scenes/footprints_text.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::pipeline::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

constexpr std::size_t block_count = 16;

/// Rows of houses in 4 × 4 blocks of 2 × 2 cells. One house has a problem.
struct ResumedPacking : Packing {
  explicit ResumedPacking(FarMapKind kind = FarMapKind::horizon) {
    settings.grid.block_edge = 2;
    settings.grid.cell_edge_m = 25.0;
    settings.grid.align = AlignMode::none;
    settings.far_map = scenes::small_maps(kind);
    settings.inputs = {write("town.geojson", town(30.0))};
    settings.ingest.footprints.height_field = "height";
  }
  static std::string town(double height_m) {
    scenes::FootprintsText houses;
    for (int n = 0; n < 36; ++n) {
      const Point2d p{500001.0 + 25.0 * (n % 6), 5500001.0 + 25.0 * (n / 6)};
      const double own_m = n == 7 ? -1.0 : height_m * (1 + n % 5) / 5.0;
      houses.add(scenes::building("h" + std::to_string(n), own_m), Box2d{p, p + Point2d{9.0, 9.0}});
    }
    return houses.text();
  }
  void run_as(const std::string& name) {
    settings.output = folder.path() / name;
    run();
  }
  /// Stops when so many blocks are done.
  void interrupt_after(std::size_t blocks) {
    std::stop_source source;
    RunSettings stopped;
    stopped.stop = source.get_token();
    stopped.on_progress = [&](const Progress& p) {
      if (p.stage == "far maps" && p.done == blocks) source.request_stop();
    };
    EXPECT_THROW((void)pack(settings, report, stopped), Cancelled);
  }
  [[nodiscard]] std::string refusal() {
    return scenes::refusal_of<OutputError>([&] { run(); });
  }
  [[nodiscard]] std::string bytes_of(const std::string& name) const { return scenes::text_of(folder.path() / name); }
  [[nodiscard]] fs::path work() const { return unfinished_folder_of(settings.output); }
};

class Resumed : public testing::TestWithParam<FarMapKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Resumed, testing::Values(FarMapKind::box, FarMapKind::horizon),
                         [](const auto& test) { return scenes::name_of(test.param); });

TEST_P(Resumed, RunsTakeOverWhatIsFinishedAndEndInTheSameBytes) {
  ResumedPacking p(GetParam());
  p.run_as("whole.farlod");
  ASSERT_EQ(p.result.manifest.blocks.size(), block_count);
  p.settings.output = p.folder.path() / "resumed.farlod";
  p.interrupt_after(4);
  EXPECT_FALSE(fs::exists(p.settings.output));
  for (const bool resume : {false, true}) {
    p.settings.resume = resume;
    p.interrupt_after(6);
  }
  p.run();
  EXPECT_GE(p.result.blocks_found, 4U);
  EXPECT_LT(p.result.blocks_found, block_count);
  EXPECT_EQ(p.bytes_of("resumed.farlod"), p.bytes_of("whole.farlod"));
  EXPECT_FALSE(fs::exists(p.work()));
}

/// The same command must not refuse what it has made itself.
TEST(Resume, RunsThatWereKilledWhenThePackageHadItsNameAreDone) {
  ResumedPacking p;
  p.interrupt_after(4);
  const fs::path copy = p.folder.path() / "copy";
  fs::copy(p.work(), copy, fs::copy_options::recursive);
  p.run();
  const package::FileStamp manifest = stamp_of(p.settings.output / "manifest.json");
  const auto note_publishing = [&] { std::ofstream(p.work() / "publishing") << manifest.bytes << ' ' << manifest.xxh3; };
  // A kill at the very end leaves a folder with nothing but a lock, or with the note as well
  for (const bool has_note : {false, true}) {
    fs::create_directory(p.work());
    std::ofstream(p.work() / "lock").close();
    if (has_note) note_publishing();
    EXPECT_THAT(p.refusal(), HasSubstr("exists already"));
    EXPECT_FALSE(fs::exists(p.work()));
  }
  // As such a kill leaves it
  fs::rename(copy, p.work());
  note_publishing();
  p.run();
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("whole already")));
  EXPECT_EQ(stamp_of(p.settings.output / "manifest.json"), manifest);
  EXPECT_FALSE(fs::exists(p.work()));
}

TEST_P(Resumed, ShardsMakeThePackageOfOneRun) {
  ResumedPacking p(GetParam());
  p.run_as("whole.farlod");
  const auto problems = p.report.problems().size();
  const PackedCity whole = p.result;
  p.settings.output = p.folder.path() / "shards.farlod";
  p.settings.part = PackPart::shard;
  std::size_t blocks = 0;
  for (const std::size_t index : {2U, 0U, 1U}) {
    ResumedPacking shard(GetParam());
    shard.settings = p.settings;
    shard.settings.shard = {index, 3};
    shard.run();
    blocks += shard.result.blocks;
    EXPECT_EQ(shard.report.problems().size(), problems) << "each shard reports what is wrong with the city";
    EXPECT_FALSE(fs::exists(p.settings.output));
  }
  EXPECT_EQ(blocks, block_count);
  p.settings.part = PackPart::merge;
  p.report = {};
  p.run();
  EXPECT_EQ(p.bytes_of("shards.farlod"), p.bytes_of("whole.farlod"));
  EXPECT_EQ(p.report.problems().size(), problems);
  EXPECT_EQ(p.result.package_bytes, whole.package_bytes);
  EXPECT_EQ(p.result.facets, whole.facets);
  EXPECT_FALSE(fs::exists(p.work()));
}

TEST(Resume, AShardReadsNoInputOnceTheCityIsSaved) {
  ResumedPacking p;
  p.settings.part = PackPart::shard;
  p.settings.shard = {0, 2};
  p.run();
  EXPECT_THAT(p.stages_timed(), Contains("save"));
  p.settings.shard = {1, 2};
  p.run();
  for (const char* stage : {"ingest", "tiles", "save"}) EXPECT_THAT(p.stages_timed(), testing::Not(Contains(stage)));
}

TEST(Resume, MergingNamesWhatIsMissing) {
  ResumedPacking p;
  p.settings.part = PackPart::merge;
  EXPECT_THAT(p.refusal(), HasSubstr("nothing to merge"));
  p.settings.part = PackPart::shard;
  p.settings.shard = {1, 3};
  p.run();
  p.settings.part = PackPart::merge;
  p.settings.inputs.clear();
  EXPECT_THAT(p.refusal(), testing::AllOf(HasSubstr("shard 0/3 (blocks"), HasSubstr("shard 2/3 (blocks")));
  EXPECT_THAT(p.refusal(), testing::Not(HasSubstr("shard 1/3")));
}

TEST(Resume, OtherSettingsAreRefusedWithBothValues) {
  ResumedPacking p;
  p.interrupt_after(4);
  p.settings.resume = true;
  p.settings.grid.cell_edge_m = 30.0;
  EXPECT_THAT(p.refusal(), HasSubstr("--cell was 25, and is 30"));
  p.settings.grid.cell_edge_m = 25.0;
  p.write("town.geojson", ResumedPacking::town(31.0));
  EXPECT_THAT(p.refusal(), HasSubstr("the input town.geojson has changed"));
  p.settings.resume = false;
  p.run();
  EXPECT_EQ(p.result.blocks_found, 0U);
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("Removed what an earlier run had left")));
}

TEST(Resume, MendsTheBlocksThatAreDamagedAndNoOthers) {
  ResumedPacking p;
  p.run_as("whole.farlod");
  p.run_as("mended.farlod");
  const fs::path mended = p.settings.output, file = mended / "blocks" / "0_0" / "far.exr",
                 kept = mended / "blocks" / "1_1" / "far.exr";
  ASSERT_TRUE(fs::exists(file) && fs::exists(kept));
  const auto written = fs::last_write_time(kept);
  std::fstream(file, std::ios::binary | std::ios::in | std::ios::out).seekp(60).put('!');
  fs::remove(mended / "blocks" / "2_2" / "tiles.bin");
  p.settings.resume = true;
  p.run();
  EXPECT_EQ(p.bytes_of("mended.farlod"), p.bytes_of("whole.farlod"));
  EXPECT_EQ(fs::last_write_time(kept), written);
  p.run();
  EXPECT_THAT(p.result.notes, Contains(HasSubstr("is whole already")));
}

TEST(Resume, FilesReadBesideAnInputCount) {
  ResumedPacking p;
  p.write("town.prj", "one");
  p.interrupt_after(4);
  p.write("town.prj", "other");
  p.settings.resume = true;
  EXPECT_THAT(p.refusal(), HasSubstr("the input town.prj has changed"));
}

TEST(Resume, AnInputThatIsWrittenMeanwhileIsNotPacked) {
  ResumedPacking p;
  RunSettings run;
  run.on_progress = [&](const Progress& progress) {
    if (progress.stage == "georeference") p.write("town.geojson", ResumedPacking::town(50.0) + " ");
  };
  EXPECT_THROW((void)pack(p.settings, p.report, run), InputError);
  EXPECT_FALSE(fs::exists(p.settings.output));
  EXPECT_FALSE(fs::exists(p.work()));
}

TEST(Resume, TwoRunsOnOnePackageDoNotMix) {
  ResumedPacking p;
  RunSettings run;
  std::string said;
  run.on_progress = [&](const Progress& progress) {
    if (progress.stage != "far maps" || !said.empty()) return;
    ResumedPacking other;
    other.settings = p.settings;
    try {
      other.run();
    } catch (const Busy& error) {
      said = error.what();
    }
  };
  (void)pack(p.settings, p.report, run);
  EXPECT_THAT(said, HasSubstr("another farlod-pack is at work"));
}

/// What a record says comes back as it was.
TEST(Resume, RecordsOfCitiesComeBack) {
  ResumedPacking p;
  p.settings.part = PackPart::shard;
  p.settings.shard = {0, 1};
  p.run();
  const auto text = SavedCity::find_record(p.work() / "city");
  ASSERT_TRUE(text);
  const auto record = city_record_from(*text);
  ASSERT_TRUE(record);
  EXPECT_EQ(record_text(*record), *text);
  EXPECT_EQ(record->problems.size(), p.report.problems().size());
  // Behind its last brace, nothing is lost. How long it is depends on how long its stages took
  const std::size_t last = text->rfind('}');
  for (std::size_t cut = 0; cut <= last; cut += 97) EXPECT_FALSE(city_record_from(text->substr(0, cut))) << cut;
}

TEST(ShardParts, AreEachOfOneShardAndAboutEqual) {
  std::vector<double> costs;
  for (int n = 0; n < 1000; ++n) costs.push_back(1.0 + n % 7);
  for (const std::size_t count : {1U, 2U, 3U, 8U, 64U}) {
    std::vector<std::size_t> all;
    double least = 1e9, most = 0.0;
    for (std::size_t index = 0; index < count; ++index) {
      double cost = 0.0;
      for (const std::size_t n : parts_of_shard(costs, {index, count})) {
        all.push_back(n);
        cost += costs[n];
      }
      least = std::min(least, cost);
      most = std::max(most, cost);
    }
    ASSERT_EQ(all.size(), costs.size()) << count;
    for (std::size_t n = 0; n < all.size(); ++n) EXPECT_EQ(all[n], n);
    EXPECT_LE(most - least, 2.0 * 7.0) << count;
  }
}

TEST(ShardParts, OfNothingAndOfFewerPartsThanShards) {
  EXPECT_TRUE(parts_of_shard({}, {0, 2}).empty());
  std::size_t parts = 0;
  for (std::size_t index = 0; index < 8; ++index) parts += parts_of_shard(std::vector<double>{1.0, 2.0, 1.0}, {index, 8}).size();
  EXPECT_EQ(parts, 3U);
  EXPECT_EQ(parts_of_shard(std::vector<double>{0.0, 0.0}, {0, 4}).size(), 2U) << "what costs nothing is the first one's";
}

}  // namespace
}  // namespace farlod::pipeline::test
