// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <regex>

#include "farlod/error.hpp"
#include "results/output_format.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

// --memory-limit: what it promises, and that it changes no byte of any result.

namespace farlod::acceptance {
namespace {

/// 40 × 40 blocks over 1.2 km: all in one scene, they take several MiB. Its maps are quickly made and read.
std::vector<Block> wide_town() {
  std::vector<Block> town;
  constexpr double pitch_m = 30.0;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      town.push_back({"b" + std::to_string(town.size()),
                      {pitch_m * (column - 20), pitch_m * (row - 20)},
                      17.0,
                      6.0 + (column * 7 + row * 3) % 20});
  return town;
}

std::string limit(int mib) { return " --memory-limit " + std::to_string(mib); }

class WideTown : public testing::Test {
 protected:
  WideTown() { add_packed_town(folder, "wide_town", wide_town(), "--far-map box"); }
  /// The limit that a run asks for when it is given too little; 0 when it does not ask.
  [[nodiscard]] int limit_asked_for(const std::string& arguments) const {
    const Outcome outcome = folder.run("farlod-svf a.farlod " + arguments + " --memory-limit 1");
    EXPECT_EQ(outcome.exit_code, exit_limit_reached);
    std::smatch found;
    return std::regex_search(outcome.err, found, std::regex("needs about ([0-9]+) MiB")) ? std::stoi(found[1]) : 0;
  }
  /// The run keeps the limit: of that, the program with its libraries has its share, and what it holds has the rest.
  void expect_held_within(int limit_mib, const std::string& arguments) const {
    constexpr double program_mib = 80.0;  // memory_limit.cpp
    const std::optional<double> held = folder.held_mib("farlod-svf a.farlod " + arguments + limit(limit_mib));
    if (held) {
      EXPECT_LE(*held, limit_mib - program_mib) << arguments;
    }
  }

  WorkFolder folder;
};

TEST_F(WideTown, ALimitThatIsTooLowIsRefused) {
  const Outcome outcome = folder.run("farlod-svf a.farlod -o o.asc --grid 20 --memory-limit 1");
  expect_refusal(
      outcome, exit_limit_reached,
      {"needs about", "more than the limit of 1 MiB", "raise the memory limit", "--memory-limit", "--threads", "--bbox"});
  EXPECT_FALSE(folder.has("o.asc"));
}

TEST_F(WideTown, TheLimitThatARunAsksForIsKept) {
  for (const std::string arguments :
       {"-o o.asc --grid 5 --rays 50 --preview p.png", "-o o.csv --surfaces all --spacing 5 --rays 50"}) {
    const int mib = limit_asked_for(arguments);
    ASSERT_GT(mib, 0);
    expect_held_within(mib, arguments);
  }
}

TEST_F(WideTown, WhatNeedsTheWholeCityIsRefusedWhereItHasNoRoom) {
  const std::string raster = "-o o.asc --grid 20 --rays 50";
  const int mib = limit_asked_for(raster);
  folder.must("farlod-svf a.farlod " + raster + limit(mib));
  for (const std::string whole : {" --engine exact", " --verify 3"}) {
    expect_refusal(folder.run("farlod-svf a.farlod " + raster + whole + limit(mib)), exit_limit_reached,
                   {"the whole city needs about", "--memory-limit", "--verify"});
    folder.must("farlod-svf a.farlod " + raster + whole);
    folder.must("farlod-svf a.farlod " + raster + whole + limit(1000));
  }
  const std::string beyond = "-o o.csv --at 500900,5500000";
  expect_refusal(folder.run("farlod-svf a.farlod " + beyond + limit(mib)), exit_limit_reached, {"points beyond the grid"});
  folder.must("farlod-svf a.farlod " + beyond);
  // What is asked for is enough
  folder.must("farlod-svf a.farlod " + beyond + limit(limit_asked_for(beyond)));
}

/// An output of each format, with the receivers that go with it.
std::vector<std::string> outputs_named(const std::string& name) {
  std::vector<std::string> outputs;
  for (const OutputFormat& format : output_formats())
    for (const bool is_table : {false, true})
      if (is_table ? format.holds_tables() : format.raster_writer != nullptr)
        outputs.push_back("-o " + name + (is_table ? "_table" : "") + std::string(format.endings[0]) +
                          (is_table                ? " --surfaces all --spacing 6"
                           : format.is_for_solweig ? " --grid 60"  // directional values of box maps take 30,000 rays a receiver
                                                   : " --grid 3") +
                          " --rays 50");
  return outputs;
}

TEST_F(WideTown, NeitherTheLimitNorThreadsChangeAByte) {
  int mib = 0;
  for (const std::string& output : outputs_named("o")) mib = std::max(mib, limit_asked_for(output + " --threads 3"));
  const auto make = [&](const std::string& name, const std::string& how) {
    for (const std::string& output : outputs_named(name)) folder.must("farlod-svf a.farlod " + output + how);
  };
  make("one", " --threads 1");
  make("two", " --threads 2");
  make("tight", " --threads 3" + limit(mib));
  std::size_t files = 0;
  for (const std::string& name : folder.names()) {
    if (!name.starts_with("one")) continue;
    const std::string ending = name.substr(3), expected = folder.text_of(name);
    EXPECT_FALSE(expected.empty()) << name;
    EXPECT_TRUE(folder.text_of("two" + ending) == expected) << ending;
    EXPECT_TRUE(folder.text_of("tight" + ending) == expected) << ending;
    ++files;
  }
  EXPECT_GE(files, output_formats().size());
}

#ifdef FARLOD_WITH_GDAL
TEST_F(WideTown, ARasterManyTimesTheLimitIsWritten) {
  // 16 km by 16 km from the middle of the town, every metre: a GiB of pixels, most of them beyond the grid
  const std::string raster = "-o o.tif --grid 1 --rays 50 --bbox 500550,5500000,516550,5516000";
  const int mib = limit_asked_for(raster);
  EXPECT_LT(mib, 256);
  expect_held_within(mib, raster + " --summary s.json");
  EXPECT_EQ(
      folder.json_of("s.json").at("receivers").get<std::size_t>() + folder.json_of("s.json").at("nodata").get<std::size_t>(),
      std::size_t{16000} * 16000);
}
#endif

}  // namespace
}  // namespace farlod::acceptance
