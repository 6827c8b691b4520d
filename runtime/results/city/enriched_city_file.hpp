// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "farlod/surfaces.hpp"
#include "results/city/city_format.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// The receivers of a run: on whole buildings, or on what lies in a mask or box.
enum class EnrichedExtent { whole_buildings, part_of_the_city };

/// A city file that comes back with what a run computed as attributes.
///   (1) The output is the input, byte for byte, with texts inserted.
///   (2) Semantic surfaces get the attributes of their surfaces; a building gets those of its row in the table of buildings, its
///       parts and installations those of their own surfaces.
///   (3) Nothing is inserted where there is no answer.
class EnrichedCityFile {
 public:
  /// Reads the file, whose content says its format. Throws InputError where it cannot be read, is no city, or has attributes of
  /// these names already.
  EnrichedCityFile(const std::filesystem::path& city, AnswerColumns columns);

  /// What it holds until the run has ended.
  [[nodiscard]] std::size_t bytes() const { return city_.file->bytes(); }
  /// Throws OutputError where the ending of the output promises another format.
  void require_fitting(const std::filesystem::path& output) const;
  /// Writes the file again, and returns what the user should know, a sentence each. Throws OutputError, and InputError where the
  /// surfaces of the run are not those of the file: their numbers, kinds, tilts and areas are compared.
  [[nodiscard]] std::vector<std::string> write(const SurfaceMeans& means, EnrichedExtent extent,
                                               const std::filesystem::path& output) const;

 private:
  std::filesystem::path path_;
  AnswerColumns columns_;
  ReadCity city_;
};

}  // namespace farlod
