// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>

#include "farlod/error.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod::acceptance {
namespace {

namespace fs = std::filesystem;

/// A small package, and the names of its files.
class DamagedPackage : public testing::Test {
 protected:
  DamagedPackage() {
    add_packed_town(folder, "small_town", small_town());
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("a.farlod")))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder.path("")).string());
  }
  [[nodiscard]] Outcome evaluate() const { return folder.run("farlod-svf a.farlod -o o.asc --grid 20"); }
  void expect_damage(const std::vector<std::string>& said) const {
    expect_refusal(evaluate(), exit_damaged_package, said);
    EXPECT_FALSE(folder.has("o.asc"));
  }
  /// Applies a change to each file of that name.
  void change(const std::string& name, const std::function<void(const std::string&)>& change_file) const {
    std::size_t changed = 0;
    for (const std::string& file : files) {
      if (fs::path(file).filename() != name) continue;
      change_file(file);
      ++changed;
    }
    ASSERT_GT(changed, 0U) << name;
  }
  void cut(const std::string& file, std::uintmax_t bytes) const { fs::resize_file(folder.path(file), bytes); }
  void edit_manifest(const std::string& from, const std::string& to) const {
    std::string text = folder.text_of("a.farlod/manifest.json");
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    folder.write("a.farlod/manifest.json", scenes::sealed(text.replace(place, from.size(), to)));
  }

  WorkFolder folder;
  std::vector<std::string> files;
};

TEST_F(DamagedPackage, WholeItIsRead) { EXPECT_EQ(evaluate().exit_code, exit_done); }

TEST_F(DamagedPackage, TilesCutShort) {
  change("tiles.bin", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"tiles.bin is damaged", "bytes", "pack the city again"});
}

TEST_F(DamagedPackage, TilesOfNoBytes) {
  change("tiles.bin", [this](const std::string& file) { cut(file, 0); });
  expect_damage({"tiles.bin is damaged", "0 bytes"});
}

TEST_F(DamagedPackage, TilesMissing) {
  change("tiles.bin", [this](const std::string& file) { fs::remove(folder.path(file)); });
  expect_damage({"tiles.bin"});
}

TEST_F(DamagedPackage, OneBitOfTheTilesTurned) {
  change("tiles.bin", [this](const std::string& file) {
    std::string bytes = folder.text_of(file);
    char& middle = bytes[bytes.size() / 2];
    middle = static_cast<char>(middle ^ 1);
    folder.write(file, bytes);
  });
  expect_damage({"tiles.bin is damaged", "checksum", "pack the city again"});
}

TEST_F(DamagedPackage, FarMapsCutShort) {
  change("far.exr", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"far.exr is damaged", "bytes", "pack the city again"});
}

TEST_F(DamagedPackage, FarMapsMissing) {
  change("far.exr", [this](const std::string& file) { fs::remove(folder.path(file)); });
  expect_damage({"far.exr"});
}

TEST_F(DamagedPackage, ManifestCutShort) {
  change("manifest.json", [this](const std::string& file) { cut(file, fs::file_size(folder.path(file)) / 2); });
  expect_damage({"manifest.json is damaged", "pack the city again"});
}

TEST_F(DamagedPackage, ManifestWithAnImpossibleCell) {
  edit_manifest("\"cell_m\": 150.0", "\"cell_m\": -150.0");
  expect_damage({"manifest.json is damaged", "cell edge"});
}

TEST_F(DamagedPackage, ManifestWithAnEvenNeighborhood) {
  edit_manifest("\"neighborhood\": 3", "\"neighborhood\": 4");
  expect_damage({"manifest.json is damaged", "neighborhood"});
}

TEST_F(DamagedPackage, ManifestOfSomethingElse) {
  folder.write("a.farlod/manifest.json", "{\"name\": \"a web application\"}");
  expect_damage({"manifest.json is damaged"});
}

TEST_F(DamagedPackage, OneDigitOfTheManifestsOriginChanged) {
  // Within the range of origins: nothing but the checksum tells
  std::string text = folder.text_of("a.farlod/manifest.json");
  char& digit = text[text.find_first_of("0123456789", text.find("\"origin_m\""))];
  digit = digit == '5' ? '4' : '5';
  folder.write("a.farlod/manifest.json", text);
  expect_damage({"manifest.json is damaged", "checksum"});
  const Outcome checked = folder.run("farlod-info a.farlod --check");
  expect_refusal(checked, exit_damaged_package, {"manifest.json is damaged", "checksum"});
}

TEST_F(DamagedPackage, ANewerVersionIsNoDamage) {
  edit_manifest("\"version\": 10", "\"version\": 11");
  expect_refusal(evaluate(), exit_unusable_input,
                 {"manifest.json has format version 11", "reads versions 8 to 10", "newer release"});
}

TEST_F(DamagedPackage, AnOlderVersionIsNoDamage) {
  const std::string text = folder.text_of("a.farlod/manifest.json");
  for (const std::string version : {"5", "6", "7"}) {
    folder.write("a.farlod/manifest.json", text);
    edit_manifest("\"version\": 10", "\"version\": " + version);
    const std::vector<std::string> said{"manifest.json has format version " + version, "reads versions 8 to 10",
                                        "Pack the city again"};
    expect_refusal(evaluate(), exit_unusable_input, said);
    expect_refusal(folder.run("farlod-info a.farlod --check"), exit_unusable_input, said);
  }
}

TEST_F(DamagedPackage, AnInterruptedPackingIsNoDamage) {
  fs::remove(folder.path("a.farlod/manifest.json"));
  expect_refusal(evaluate(), exit_unusable_input, {"a.farlod is not a finished package", "interrupted", "Pack the city again"});
}

}  // namespace
}  // namespace farlod::acceptance
