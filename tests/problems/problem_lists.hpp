// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "farlod/problem.hpp"

namespace farlod::test {

/// A problem as a list names it: its code and its slug.
using ProblemName = std::pair<int, std::string>;

/// "104 ring_not_closed" or "104_ring_not_closed" → 104, ring_not_closed. What has no code gets the code 0.
inline ProblemName problem_name(const std::string& text) {
  const std::size_t slug = text.find_first_not_of("0123456789");
  return {std::atoi(text.c_str()), slug < text.size() ? text.substr(slug + 1) : ""};
}

/// The problems that exist.
inline std::vector<ProblemName> described_problems() {
  std::vector<ProblemName> names;
  for (const ProblemDescription& d : problem_descriptions) names.emplace_back(static_cast<int>(d.code), d.slug);
  return names;
}

/// A file of datasets/broken.
struct Fixture {
  ProblemName name;
  std::filesystem::path path;
};
inline void PrintTo(const Fixture& fixture, std::ostream* out) { *out << fixture.path.filename().string(); }

/// All files of datasets/broken, by name.
inline std::vector<Fixture> fixtures() {
  std::vector<Fixture> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(FARLOD_SOURCE_DIR) / "datasets/broken")) {
    const std::string file = entry.path().filename().string();
    files.push_back({problem_name(file.substr(0, file.find('.'))), entry.path()});
  }
  std::sort(files.begin(), files.end(), [](const Fixture& a, const Fixture& b) { return a.path < b.path; });
  return files;
}

/// Those of the codes that a stage reports: 1 ingest, 2 georeference, 3 align, 4 tiles.
inline std::vector<Fixture> fixtures_of_stages(int first, int last) {
  std::vector<Fixture> files = fixtures();
  std::erase_if(files, [=](const Fixture& f) { return f.name.first / 100 < first || f.name.first / 100 > last; });
  return files;
}

/// A file without problems, in the UTM zone of all fixtures.
inline std::filesystem::path good_city() {
  return std::filesystem::path(FARLOD_SOURCE_DIR) / "datasets/samples/village.city.json";
}

/// Whether a file alone would end the run: its problem is one among several files.
inline bool needs_company(const Fixture& fixture) {
  return fixture.name.first == static_cast<int>(ProblemCode::empty_file) ||
         fixture.name.first == static_cast<int>(ProblemCode::unusable_file);
}

/// Whether a file is of trees, and read beside a city.
inline bool is_of_trees(const Fixture& fixture) {
  const auto code = static_cast<ProblemCode>(fixture.name.first);
  return (ProblemCode::tree_size_missing <= code && code <= ProblemCode::trunk_above_crown) ||
         code == ProblemCode::tree_outside_of_grid;
}

/// What has to be read for the problem to show.
inline std::vector<std::filesystem::path> inputs_with(const Fixture& fixture) {
  return needs_company(fixture) ? std::vector{fixture.path, good_city()} : std::vector{fixture.path};
}

/// The headings "### <code> <slug>" of docs/problems.md, from top to bottom.
inline std::vector<ProblemName> documented_problems() {
  std::vector<ProblemName> names;
  std::ifstream page(std::filesystem::path(FARLOD_SOURCE_DIR) / "docs/problems.md");
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("### ")) names.push_back(problem_name(line.substr(4)));
  return names;
}

}  // namespace farlod::test
