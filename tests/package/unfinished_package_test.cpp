// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/unfinished_package.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "farlod/error.hpp"
#include "package/existing_package.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/manifest.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/sealed_manifest.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

using OfAnotherOrigin = UnfinishedPackage::OfAnotherOrigin;

/// A package of one block without far maps; its files are texts.
class PackageInTheMaking : public testing::Test {
 protected:
  PackageInTheMaking() {
    manifest_.grid.cells = {0, 0, 1, 1};
    manifest_.far_map.kind = "box";
  }
  [[nodiscard]] UnfinishedPackage opened(const PackageOrigin& origin, OfAnotherOrigin of_another = OfAnotherOrigin::refuse,
                                         LockKind kind = LockKind::exclusive) const {
    return UnfinishedPackage::open(package_, origin, kind, of_another);
  }
  [[nodiscard]] std::string refusal(const PackageOrigin& origin) const {
    return scenes::refusal_of<OutputError>([&] { (void)opened(origin); });
  }
  /// Makes the block's file, and records it.
  package::BlockFiles make_block(const UnfinishedPackage& unfinished, const std::string& text) const {
    package::BlockFiles files{block_, {}, {}, none_};
    const fs::path tiles = unfinished.package_folder() / package::folder_of(files) / package::tiles_file;
    fs::create_directories(tiles.parent_path());
    std::ofstream(tiles) << text;
    files.tiles = stamp_of(tiles);
    unfinished.record(files);
    return files;
  }
  /// What is under the package's name.
  [[nodiscard]] std::string tiles_of_package() const {
    return scenes::text_of(package_ / package::folder_of({block_, {}, {}, none_}) / package::tiles_file);
  }
  void publish(UnfinishedPackage& unfinished, const package::BlockFiles& files) {
    manifest_.blocks = {files};
    EXPECT_EQ(unfinished.publish(manifest_), "");
  }

  scenes::TemporaryFolder folder_;
  fs::path package_ = folder_.file("town.farlod"), work_ = unfinished_folder_of(package_);
  Block block_{0, 0};
  package::CellRuns none_;
  package::Manifest manifest_;
  PackageOrigin origin_{"farlod-pack 1", {{"town.gml", {10, 1}}}, {{"cell", "50"}}};
};

TEST_F(PackageInTheMaking, TellsWhereToGoFromAFolderInWhichNothingCanBeMade) {
  std::ofstream(folder_.file("notes.txt")) << "no folder";
  package_ = folder_.file("notes.txt") / "town.farlod";
  EXPECT_THAT(refusal(origin_), AllOf(HasSubstr("town.farlod.unfinished cannot be made: "), HasSubstr("another folder for -o")));
}

TEST_F(PackageInTheMaking, IsUnderItsNameOnceItIsPublished) {
  auto unfinished = opened(origin_);
  const auto files = make_block(unfinished, "new");
  EXPECT_FALSE(fs::exists(package_));
  publish(unfinished, files);
  EXPECT_EQ(tiles_of_package(), "new");
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(PackageInTheMaking, WithNothingFinishedLeavesNothing) {
  { const auto unfinished = opened(origin_); }
  EXPECT_FALSE(fs::exists(work_));
  { const auto unfinished = opened(origin_, OfAnotherOrigin::refuse, LockKind::shared); }
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(PackageInTheMaking, IsGoneOnWithByOneOfTheSameOrigin) {
  { make_block(opened(origin_), "done"); }
  auto unfinished = opened(origin_);
  EXPECT_THAT(unfinished.finding(), HasSubstr("1 finished blocks"));
  const auto files = unfinished.finished(block_, none_);
  ASSERT_TRUE(files);
  publish(unfinished, *files);
  EXPECT_EQ(tiles_of_package(), "done");
}

TEST_F(PackageInTheMaking, KnowsNoBlockWhoseFileIsAnother) {
  { make_block(opened(origin_), "done"); }
  std::ofstream(work_ / "package" / package::folder_of({block_, {}, {}, none_}) / package::tiles_file) << "d0ne";
  EXPECT_FALSE(opened(origin_).finished(block_, none_));
}

TEST_F(PackageInTheMaking, OfAnotherOriginIsRefusedWithBothValuesOrReplaced) {
  { make_block(opened(origin_), "done"); }
  PackageOrigin other = origin_;
  other.settings = {{"cell", "100"}};
  EXPECT_THAT(refusal(other), HasSubstr("--cell was 50, and is 100"));
  other = origin_;
  other.inputs[0].stamp.xxh3 = 2;
  EXPECT_THAT(refusal(other), HasSubstr("the input town.gml has changed"));
  other = origin_;
  other.software = "farlod-pack 2";
  EXPECT_THAT(refusal(other), HasSubstr("the program was farlod-pack 1, and is farlod-pack 2"));
  const auto unfinished = opened(other, OfAnotherOrigin::replace);
  EXPECT_FALSE(unfinished.finished(block_, none_));
  EXPECT_THAT(unfinished.finding(), HasSubstr("Removed what an earlier run had left"));
}

TEST_F(PackageInTheMaking, OfAPipeIsNeverTheSame) {
  origin_.inputs[0].is_known = false;
  { make_block(opened(origin_), "done"); }
  EXPECT_THAT(refusal(origin_), HasSubstr("town.gml is a pipe"));
}

TEST_F(PackageInTheMaking, IsOfOneProcessOrOfShards) {
  const auto unfinished = opened(origin_, OfAnotherOrigin::refuse, LockKind::shared);
  EXPECT_THROW((void)opened(origin_), Busy);
  const auto other = opened(origin_, OfAnotherOrigin::refuse, LockKind::shared);
  const FileLock first = unfinished.lock_shard(0, 2);
  EXPECT_THROW((void)other.lock_shard(0, 2), Busy);
  const FileLock second = other.lock_shard(1, 2);
  EXPECT_THROW((void)other.lock_shard(2, 3), OutputError) << "another number of shards";
}

TEST_F(PackageInTheMaking, ReplacesAPackageThatNobodyReads) {
  for (const char* text : {"old", "new"}) {
    auto unfinished = opened(origin_);
    publish(unfinished, make_block(unfinished, text));
  }
  EXPECT_EQ(tiles_of_package(), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(PackageInTheMaking, KeepsAReplacedPackageWhileItIsRead) {
  {
    auto unfinished = opened(origin_);
    publish(unfinished, make_block(unfinished, "old"));
  }
  auto reader = FileLock::try_lock_existing(package_ / package::manifest_file, LockKind::shared);
  auto unfinished = opened(origin_);
  const auto files = make_block(unfinished, "new");
  manifest_.blocks = {files};
  const fs::path kept = folder_.file("town.farlod.replaced-1");
  EXPECT_THAT(unfinished.publish(manifest_), HasSubstr(kept.string()));
  EXPECT_EQ(tiles_of_package(), "new");
  EXPECT_EQ(scenes::text_of(kept / package::folder_of(files) / package::tiles_file), "old");
}

/// As a kill leaves it between the two names and the end.
TEST_F(PackageInTheMaking, ThatHasItsNameAlreadyIsNotGivenItAgain) {
  {
    auto unfinished = opened(origin_);
    publish(unfinished, make_block(unfinished, "old"));
  }
  package::BlockFiles files;
  {
    const auto unfinished = opened(origin_);
    files = make_block(unfinished, "new");
    fs::copy(work_, folder_.file("copy"), fs::copy_options::recursive);
  }
  const auto stamp = [&](const fs::path& manifest) {
    const package::FileStamp found = stamp_of(manifest);
    return std::to_string(found.bytes) + " " + std::to_string(found.xxh3);
  };
  {
    auto unfinished = opened(origin_);
    publish(unfinished, files);
  }
  // The folder comes back with the old package in it, and the note that the new one was given its name
  fs::rename(folder_.file("copy"), work_);
  std::ofstream(work_ / "publishing") << stamp(package_ / package::manifest_file);
  std::ofstream(work_ / "package" / package::manifest_file) << "the old one";
  const auto unfinished = opened(origin_);
  EXPECT_EQ(tiles_of_package(), "new");
  EXPECT_FALSE(fs::exists(work_ / "package" / package::manifest_file));
  EXPECT_FALSE(unfinished.finished(block_, none_));
}

TEST_F(PackageInTheMaking, ThatWasKilledBetweenTwoStepsGivesTheNameBack) {
  {
    auto unfinished = opened(origin_);
    publish(unfinished, make_block(unfinished, "old"));
  }
  { make_block(opened(origin_), "new"); }
  fs::rename(package_, work_ / "aside");
  const auto unfinished = opened(origin_);
  EXPECT_EQ(tiles_of_package(), "old");
  EXPECT_TRUE(unfinished.finished(block_, none_)) << "and the work stays";
}

/// In `text` from `begin` on, `from` once replaced by `to`.
std::string replaced(std::string text, std::size_t begin, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from, begin);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

/// The manifest of a package some of whose cells have far maps; nothing else of the package is there.
class PackageToGoOnWith : public testing::Test {
 protected:
  PackageToGoOnWith() { fs::create_directory(package_); }
  void write(const std::string& text) const { std::ofstream(package_ / package::manifest_file, std::ios::binary) << text; }
  [[nodiscard]] std::string refusal() const {
    return scenes::refusal_of<OutputError>([&] { (void)ExistingPackage::find(package_); });
  }

  scenes::TemporaryFolder folder_;
  fs::path package_ = folder_.file("town.farlod");
  std::string text_ = scenes::text_of(FARLOD_GOLDEN_DIR "/version_8_horizon_partial.farlod/manifest.json");
};

TEST_F(PackageToGoOnWith, HasTheBlocksThatTheRuntimeReads) {
  EXPECT_FALSE(ExistingPackage::find(package_));
  write(text_);
  const auto existing = ExistingPackage::find(package_);
  ASSERT_TRUE(existing);
  const std::vector<package::BlockFiles> read = read_manifest(package_).blocks;
  ASSERT_GT(read.size(), 0U);
  ASSERT_EQ(existing->blocks().size(), read.size());
  for (std::size_t n = 0; n < read.size(); ++n) {
    EXPECT_EQ(existing->blocks()[n].block, read[n].block);
    EXPECT_EQ(existing->blocks()[n].tiles, read[n].tiles);
    EXPECT_EQ(package::folder_of(existing->blocks()[n]), package::folder_of(read[n]));
  }
}

TEST_F(PackageToGoOnWith, OfAnOlderVersionIsRefusedWithWhatToDo) {
  for (const std::string version : {"6", "7"}) {
    write(scenes::sealed(replaced(text_, 0, "\"version\": 8", "\"version\": " + version)));
    EXPECT_THAT(refusal(),
                AllOf(HasSubstr("has format version " + version), HasSubstr("Pack the city again"), HasSubstr("--force")));
  }
}

/// Each would be cut to another number that looks right. The program that goes on with a package and those that read it refuse
/// the same ones.
TEST_F(PackageToGoOnWith, WithANumberThatDoesNotFitIsRefusedByBothPrograms) {
  const std::size_t blocks = text_.find("\"blocks\"");
  const std::string whole = replaced(text_, blocks, "\"i\": 0", "\"i\":  0");
  write(scenes::sealed(whole));
  ASSERT_EQ(refusal(), "no refusal");
  const std::pair<std::string, std::string> changes[] = {{"\"i\": 0", "\"i\": 4294967296"},
                                                         {"\"j\": 0", "\"j\": 0.5"},
                                                         {"\"bytes\": ", "\"bytes\": -"},
                                                         {"\"bytes\": ", "\"bytes\": 9999999999999999"}};
  for (const auto& [from, to] : changes) {
    write(scenes::sealed(replaced(text_, blocks, from, to)));
    EXPECT_THAT(refusal(), HasSubstr("manifest.json is damaged")) << to;
    EXPECT_THROW((void)read_manifest(package_), PackageDamaged) << to;
  }
}

TEST_F(PackageToGoOnWith, WithAnotherChecksumIsRefused) {
  write(" " + text_);
  EXPECT_THAT(refusal(), HasSubstr("manifest.json is damaged: its checksum"));
}

}  // namespace
}  // namespace farlod
