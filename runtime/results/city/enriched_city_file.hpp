// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "farlod/city_sources.hpp"
#include "farlod/package.hpp"
#include "farlod/surfaces.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// A city file that comes back with what a run computed as attributes. The package says where in the file they belong.
///   (1) The output is the input, byte for byte, with texts inserted.
///   (2) Semantic surfaces get the attributes of their surfaces; a building gets those of its row in the table of buildings, its
///       parts and installations those of their own surfaces.
///   (3) Nothing is inserted where there is no answer.
class EnrichedCityFile {
 public:
  /// `package_name`: in messages. Throws InputError where the file is none that the package was made of, where the package does
  /// not say where attributes belong in it, or where one of their names is in it already; and what city_files_of() throws.
  EnrichedCityFile(const Package& package, const std::string& package_name, std::filesystem::path city, AnswerColumns columns);

  /// Throws OutputError where the ending of the output promises another format.
  void require_fitting(const std::filesystem::path& output) const;
  /// Writes the file again, and returns what the user should know, a sentence each. Throws OutputError, and InputError where the
  /// file has changed meanwhile.
  [[nodiscard]] std::vector<std::string> write(const Package& package, const SurfaceMeans& means,
                                               const std::filesystem::path& output) const;

 private:
  [[nodiscard]] bool is_this_file(const PackedInput& input) const;
  void require_free_names() const;

  std::filesystem::path path_;
  AnswerColumns columns_;
  std::string xxh3_;  ///< as xxh3_of_file() tells it
  PackedCityFile packed_;
};

}  // namespace farlod
