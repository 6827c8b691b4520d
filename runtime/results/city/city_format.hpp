// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "results/city/city_file.hpp"

namespace farlod {

/// The formats of the city files that a run can write again.
enum class EnrichedFormat { cityjson, cityjsonseq, citygml };

[[nodiscard]] std::string name_of(EnrichedFormat format);
/// The format that the ending of a file's name promises, in capitals or not.
[[nodiscard]] std::optional<EnrichedFormat> city_format_of(const std::filesystem::path& path);
/// For messages: ".gml, .xml or .citygml".
[[nodiscard]] std::string endings_of(EnrichedFormat format);

struct ReadCity {
  EnrichedFormat format = EnrichedFormat::cityjson;
  std::unique_ptr<const CityFile> file;
};

/// Reads a city file, whose content says its format. Throws InputError.
[[nodiscard]] ReadCity read_city(const std::filesystem::path& path);

/// Does what reads more of a city file, such as CityFile::for_each_building. What its text is not is an InputError that names the
/// file.
void telling_file(const std::filesystem::path& path, const std::function<void()>& work);

}  // namespace farlod
