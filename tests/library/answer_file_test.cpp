// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/answer_file.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/raster.hpp"
#include "farlod/surfaces.hpp"
#include "tests/library/library_calls.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::library {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

using OfAnotherKey = AnswerFile::OfAnotherKey;

const AnswerKey some_key{{"--grid", "2"}, {"--height", "1.5"}};

class AnswerFiles : public testing::Test {
 protected:
  [[nodiscard]] AnswerFile opened(const AnswerKey& key = some_key, OfAnotherKey of_another = OfAnotherKey::refuse) const {
    return AnswerFile::open(file_, key, of_another);
  }
  [[nodiscard]] std::string refusal(const AnswerKey& key) const {
    return scenes::refusal_of<OutputError>([&] { (void)opened(key); });
  }
  static std::vector<std::byte> bytes(const std::string& text) {
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return {begin, begin + text.size()};
  }

  scenes::TemporaryFolder folder_;
  fs::path file_ = folder_.file("answers");
};

TEST_F(AnswerFiles, HaveWhatWasKept) {
  {
    const AnswerFile file = opened();
    file.keep(7, bytes("seven"));
    file.keep(3, bytes(""));
    EXPECT_EQ(file.find(7), bytes("seven"));
  }
  const AnswerFile again = opened();
  EXPECT_EQ(again.cells(), 2U);
  EXPECT_EQ(again.find(7), bytes("seven"));
  EXPECT_EQ(again.find(3), bytes(""));
  EXPECT_EQ(again.find(1), std::nullopt);
}

/// Wherever a kill cuts the file, what is before is there, and the rest is kept anew.
TEST_F(AnswerFiles, CutAnywhereHaveTheCellsBefore) {
  { const AnswerFile file = opened(); }
  const auto head = fs::file_size(file_);
  {
    const AnswerFile file = opened();
    file.keep(1, bytes("first"));
    file.keep(2, bytes("second"));
  }
  const auto whole = fs::file_size(file_);
  std::ifstream stream(file_, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t size = head; size < whole; ++size) {
    std::ofstream(file_, std::ios::binary) << text.substr(0, size);
    const AnswerFile file = opened();
    EXPECT_EQ(file.find(2), std::nullopt) << size;
    file.keep(2, bytes("again"));
    EXPECT_EQ(file.find(2), bytes("again")) << size;
  }
}

TEST_F(AnswerFiles, WithAFlippedBitInACellDoNotHaveIt) {
  {
    const AnswerFile file = opened();
    file.keep(1, bytes("first"));
    file.keep(2, bytes("second"));
  }
  std::fstream stream(file_, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekp(-static_cast<std::streamoff>(std::string("second").size() + 24 + 3), std::ios::end);
  stream.put('X');
  stream.close();
  const AnswerFile file = opened();
  EXPECT_EQ(file.find(1), std::nullopt);
  EXPECT_EQ(file.find(2), bytes("second"));
}

TEST_F(AnswerFiles, OfAnotherRunAreRefusedWithBothValues) {
  {
    const AnswerFile file = opened();
    file.keep(1, bytes("first"));
  }
  EXPECT_THAT(refusal({{"--grid", "3"}, {"--height", "1.5"}}), HasSubstr("--grid was 2, and is 3"));
  EXPECT_THAT(refusal({{"--grid", "2"}}), HasSubstr("--height was 1.5, and is not given"));
  EXPECT_THAT(refusal({{"--grid", "2"}, {"--height", "1.5"}, {"--bounds", "on"}}),
              HasSubstr("--bounds was not given, and is on"));
  EXPECT_THAT(refusal({{"--bounds", "on"}, {"--grid", "3"}, {"--height", "1.5"}}), HasSubstr("--grid was 2, and is 3"));
  EXPECT_EQ(refusal(some_key), "no refusal");
  const AnswerFile other = opened({{"--grid", "3"}}, OfAnotherKey::replace);
  EXPECT_EQ(other.cells(), 0U);
  EXPECT_THAT(other.replaced(), HasSubstr("--grid was 2, and is 3"));
}

TEST_F(AnswerFiles, ThatAreNoneAreReplacedOrRefused) {
  std::ofstream(file_) << "somebody's notes, which are longer than the head of a file of answers";
  EXPECT_THAT(refusal(some_key), HasSubstr("is damaged"));
  EXPECT_EQ(opened(some_key, OfAnotherKey::replace).cells(), 0U);
}

TEST_F(AnswerFiles, AreOfOneProcessAtATime) {
  const AnswerFile file = opened();
  EXPECT_THROW((void)opened(), Busy);
}

/// A run that keeps its answers, and what came of it.
class KeptRuns : public testing::Test {
 protected:
  struct Result {
    std::vector<float> svf, low;
    EvaluationSummary summary;
  };
  [[nodiscard]] RasterPlan plan() const { return plan_raster(package_, 2.0); }
  [[nodiscard]] Result raster(const RunSettings& run) const {
    EvaluationSettings settings;
    settings.bounds = true;
    settings.further.directional = true;
    const Raster raster = evaluate_raster(package_, plan(), {}, settings, run);
    return {raster.svf, raster.low, raster.summary};
  }
  [[nodiscard]] std::shared_ptr<AnswerFile> file(const std::string& name) const {
    return std::make_shared<AnswerFile>(AnswerFile::open(folder_.file(name), some_key, OfAnotherKey::refuse));
  }
  static void expect_same(const Result& a, const Result& b) {
    const auto same_bits = [](const std::vector<float>& x, const std::vector<float>& y) {
      return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
    };
    EXPECT_TRUE(same_bits(a.svf, b.svf));
    EXPECT_TRUE(same_bits(a.low, b.low));
    EXPECT_EQ(a.summary.receivers, b.summary.receivers);
    EXPECT_EQ(a.summary.svf_mean, b.summary.svf_mean);
    EXPECT_EQ(a.summary.by_rays, b.summary.by_rays);
    EXPECT_EQ(a.summary.no_data, b.summary.no_data);
  }

  PackedSample sample_;
  Package package_{sample_.folder()};
  scenes::TemporaryFolder folder_;
};

TEST_F(KeptRuns, ThatAreInterruptedGoOnToTheSameAnswers) {
  const Result expected = raster({});
  std::stop_source source;
  RunSettings run;
  run.answers = file("answers");
  run.stop = source.get_token();
  // Two threads might have the last of the village's four cells in work already
  run.threads = 1;
  run.on_progress = [&](const Progress& p) {
    if (p.done > 0) source.request_stop();
  };
  EXPECT_THROW((void)raster(run), Cancelled);
  const std::size_t kept = run.answers->cells();
  EXPECT_GT(kept, 0U);
  RunSettings again;
  again.answers = run.answers;
  expect_same(raster(again), expected);
  EXPECT_GT(again.answers->cells(), kept);
  // All are there now: nothing is computed
  const Result third = raster(again);
  expect_same(third, expected);
  EXPECT_EQ(third.summary.seconds.evaluate, 0.0);
}

TEST_F(KeptRuns, InShardsComeTogether) {
  const Result expected = raster({});
  std::vector<fs::path> files;
  std::size_t receivers = 0;
  for (std::size_t index = 0; index < 3; ++index) {
    RunSettings run;
    run.answers = file("shard" + std::to_string(index));
    run.shard = Shard{index, 3};
    files.push_back(folder_.file("shard" + std::to_string(index)));
    receivers += raster(run).summary.receivers;
  }
  EXPECT_EQ(receivers, expected.summary.receivers);
  RunSettings merge;
  merge.answers = std::make_shared<AnswerFile>(AnswerFile::together(files, some_key));
  expect_same(raster(merge), expected);
  files.pop_back();
  merge.answers = std::make_shared<AnswerFile>(AnswerFile::together(files, some_key));
  EXPECT_THROW((void)raster(merge), OutputError);
}

TEST_F(KeptRuns, OfSurfacesGoOn) {
  const SurfaceSettings surfaces{SurfaceChoice::all, 2.0};
  const SurfaceMeans expected = evaluate_surfaces(package_, surfaces, {}, {}, {});
  RunSettings run;
  run.answers = file("surfaces");
  for (int n = 0; n < 2; ++n) {
    const SurfaceMeans means = evaluate_surfaces(package_, surfaces, {}, {}, run);
    ASSERT_EQ(means.surfaces.size(), expected.surfaces.size());
    for (std::size_t k = 0; k < expected.surfaces.size(); ++k)
      EXPECT_EQ(means.surfaces[k].svf_mean, expected.surfaces[k].svf_mean) << k;
  }
}

TEST_F(KeptRuns, WithoutAFileHaveNoShards) {
  RunSettings run;
  run.shard = Shard{0, 2};
  EXPECT_THROW((void)raster(run), InvalidArgument);
  run.answers = file("answers");
  run.shard = Shard{2, 2};
  EXPECT_THROW((void)raster(run), InvalidArgument);
}

/// Files of a package are mapped: once checked, they may change under a program that has it open.
class ChangedPackage : public testing::Test {
 protected:
  void SetUp() override { raster.call(arguments_); }

  /// The first file of this name in the package.
  [[nodiscard]] std::filesystem::path file(const std::string& name) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sample_.folder()))
      if (entry.path().filename() == name) return entry.path();
    ADD_FAILURE() << "no " << name;
    return {};
  }
  void expect_refused(const std::string& name) {
    for (const Named& named : {points_into, points, tiles, raster, window, surfaces, cell_contents, geometry, far_view, outlines,
                               heights, plan_of_heights})
      EXPECT_THAT(scenes::refusal_of<PackageDamaged>([&] { named.call(arguments_); }),
                  testing::AllOf(HasSubstr(name), HasSubstr("open the package again")))
          << named.name;
  }

  PackedSample sample_;
  Arguments arguments_{sample_.folder()};
};

TEST_F(ChangedPackage, AsItWasAnswers) { EXPECT_NO_THROW(raster.call(arguments_)); }

TEST_F(ChangedPackage, WithAShorterFileIsRefused) {
  // A mapping of what is beyond a file's end would end the process
  std::filesystem::resize_file(file("tiles.bin"), 100);
  expect_refused("tiles.bin");
  EXPECT_FALSE(check_package(arguments_.package).damage.empty());
}

TEST_F(ChangedPackage, WithAFarMapWrittenAgainIsRefused) {
  const auto far_map = file("far.exr");
  std::filesystem::last_write_time(far_map, std::filesystem::last_write_time(far_map) + std::chrono::seconds(5));
  expect_refused("far.exr");
}

TEST_F(ChangedPackage, WithAnotherManifestIsRefused) {
  // As when it was packed again: another file under the same name
  const auto manifest = file("manifest.json");
  std::filesystem::copy_file(manifest, manifest.string() + ".new");
  std::filesystem::rename(manifest.string() + ".new", manifest);
  expect_refused("manifest.json");
}

TEST_F(ChangedPackage, WithoutAFileIsRefused) {
  std::filesystem::remove(file("tiles.bin"));
  expect_refused("tiles.bin");
}

TEST_F(ChangedPackage, OpenedAgainAnswers) {
  const auto far_map = file("far.exr");
  std::filesystem::last_write_time(far_map, std::filesystem::last_write_time(far_map) + std::chrono::seconds(5));
  arguments_.package = Package(sample_.folder());
  EXPECT_NO_THROW(raster.call(arguments_));
}

}  // namespace
}  // namespace farlod::library
