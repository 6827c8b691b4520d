// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "farlod/package.hpp"
#include "farlod/surfaces.hpp"
#include "results/city/enriched_city_file.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// A city file, or those of a folder and of the folders in it, which come back with what a run computed.
///   (1) Of a folder, each file that the package was made of comes back under its name below the output folder; others stay out.
///   (2) What is in the output folder is not replaced.
class EnrichedCityFiles {
 public:
  /// `package_name`: in messages. Throws what EnrichedCityFile throws, and InputError where no file of the folder is one that the
  /// package was made of.
  EnrichedCityFiles(const Package& package, const std::string& package_name, const std::filesystem::path& city,
                    const AnswerColumns& columns);

  /// Throws OutputError where the ending of the output promises another format, or where the output folder has a file already.
  void require_fitting(const std::filesystem::path& output) const;
  /// The size of all files as they are.
  [[nodiscard]] double bytes() const;
  /// Writes all files, and returns what the user should know, a sentence each. Throws what EnrichedCityFile::write throws.
  [[nodiscard]] std::vector<std::string> write(const Package& package, const SurfaceMeans& means,
                                               const std::filesystem::path& output) const;

 private:
  struct NamedCityFile {
    std::filesystem::path path, name;  ///< `name`: below its folder
    EnrichedCityFile file;
  };
  void add_folder(const Package& package, const std::string& package_name, const std::filesystem::path& folder,
                  const AnswerColumns& columns);

  bool is_folder_ = false;
  std::vector<NamedCityFile> files_;
  std::vector<std::string> notes_;
};

}  // namespace farlod
