// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <numeric>
#include <stdexcept>
#include <vector>

#include "farlod/error.hpp"
#include "ingest/files/input_file.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::HasSubstr;

TEST(SeveralFiles, AreReadInTheirOrder) {
  const std::vector<InputFile> files{write_file("b.obj", obj_of("b")), write_file("a.gml", citygml_of("a"))};
  Report report;
  const std::vector<SourceCity> cities = ingest_all(files, {}, report);
  ASSERT_EQ(cities.size(), 2u);
  EXPECT_EQ(cities[0].city.buildings()[0].id, "b");
  EXPECT_EQ(cities[1].city.buildings()[0].id, "a");
}

TEST(SeveralFiles, WhatCannotBeUsedCostsItselfOnly) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("cut.gml", citygml_of("x").substr(0, 300)),
                                     write_file("good.obj", obj_of("good")), write_file("text.txt", "hello")};
  Report report;
  EXPECT_EQ(ingest_all(files, {}, report).size(), 1u);
  ASSERT_EQ(report.problems().size(), 3u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::empty_file);
  EXPECT_EQ(report.problems()[0].source, files[0].name);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::unusable_file);
  EXPECT_THAT(report.problems()[1].detail, HasSubstr("not well-formed"));
  EXPECT_EQ(report.problems()[2].code, ProblemCode::unusable_file);
}

/// The ids and the problems of files that are read on so many threads.
std::string read_on_threads(int threads, const std::vector<InputFile>& files) {
  return oneapi::tbb::task_arena(threads).execute([&] {
    Report report;
    std::string text;
    for (const SourceCity& source : ingest_all(files, {}, report))
      text += source.source + ' ' + source.city.buildings()[0].id + '\n';
    for (const Problem& problem : report.problems()) text += problem.source + ": " + problem.detail + '\n';
    return text;
  });
}

TEST(SeveralFiles, ThreadsDoNotChangeTheirOrder) {
  std::vector<InputFile> files;
  for (int n = 0; n < 20; ++n) {
    const std::string name = "town " + std::to_string(n);
    files.emplace_back(write_file(name + ".gml", n % 3 == 0 ? "not XML" : citygml_of(name)));
    files.emplace_back(write_file(name + ".obj", n % 5 == 0 ? "" : obj_of(name)));
  }
  const std::string on_one = read_on_threads(1, files);
  EXPECT_EQ(std::count(on_one.begin(), on_one.end(), '\n'), 40);
  for (const int threads : {2, 8}) EXPECT_EQ(read_on_threads(threads, files), on_one);
}

TEST(SeveralFiles, AreNotReadOnceAStopIsRequested) {
  const std::vector<InputFile> files(10, write_file("a.obj", obj_of("a")));
  std::stop_source source;
  source.request_stop();
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      Report report;
      EXPECT_THROW((void)ingest_all(files, {}, report, source.get_token()), Cancelled);
    });
}

TEST(SeveralFiles, OfWhichNoneIsLeftEndTheRun) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("text.txt", "hello")};
  Report report;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)ingest_all(files, {}, report); }),
              testing::AllOf(HasSubstr("none of the 2 files"), HasSubstr("empty.gml"), HasSubstr("0 bytes")));
  EXPECT_EQ(report.problems().size(), 2u);
}

TEST(SeveralFiles, ASingleFileEndsTheRunItself) {
  Report report;
  const std::vector<InputFile> file{write_file("empty.gml", "")};
  EXPECT_THROW((void)ingest_all(file, {}, report), InputError);
  EXPECT_TRUE(report.problems().empty());
}

constexpr int pieces = 1'000;

TEST(OrderedWork, BeginsAndEndsInOrderWithinItsPlaces) {
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_EQ(threads_here(), static_cast<std::size_t>(threads));
      std::vector<int> piece_at(3, -1), ended;
      int next = 0;
      const auto begin = [&](std::size_t place) {
        EXPECT_EQ(piece_at.at(place), -1) << "the place is free";
        if (next == pieces) return false;
        piece_at[place] = next++;
        return true;
      };
      const auto work = [&](std::size_t place) { piece_at[place] *= 2; };
      const auto end = [&](std::size_t place) {
        ended.push_back(piece_at[place] / 2);
        piece_at[place] = -1;
      };
      run_in_order(piece_at.size(), {begin, work, end});
      std::vector<int> all(pieces);
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(ended, all);
    });
}

TEST(OrderedWork, EndsWithWhatIsThrown) {
  const auto go_on = [](std::size_t) {};
  const auto fail = [](std::size_t) { throw std::runtime_error("no more"); };
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_THROW(run_in_order(2, {[](std::size_t) -> bool { throw std::runtime_error("no more"); }, go_on, go_on}),
                   std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, fail, go_on}), std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, go_on, fail}), std::runtime_error);
    });
}

}  // namespace
}  // namespace farlod::ingest::test
