// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/enriched_city_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <system_error>

#include "farlod/city_sources.hpp"
#include "farlod/error.hpp"
#include "results/output_format.hpp"
#include "results/provenance.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

/// All files below a folder, by their names. Links are followed as farlod-pack follows them.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  } catch (const fs::filesystem_error& error) {
    throw InputError(folder.string() + " cannot be read (" + error.code().message() + "): choose another folder for --city");
  }
  std::ranges::sort(files);
  return files;
}

/// "a.gml, b.gml and 3 others".
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most_listed = 3;
  std::string list;
  for (std::size_t n = 0; n < std::min(names.size(), most_listed); ++n) list += (n > 0 ? ", " : "") + names[n];
  return names.size() > most_listed ? fmt::format("{} and {} others", list, names.size() - most_listed) : list;
}

/// City files of a package, to be found by size and checksum.
class PackedFiles {
 public:
  explicit PackedFiles(const Package& package) : files_(city_files_of(package)), is_met_(files_.size()) {}

  /// Whether it is one of them, which is noted down.
  [[nodiscard]] bool take(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(path, error);
    const auto may_be = [bytes](const PackedCityFile& file) { return file.input.bytes == bytes; };
    if (error || std::ranges::none_of(files_, may_be)) return false;
    const std::string xxh3 = xxh3_of_file(path);
    bool is_one = false;
    for (std::size_t n = 0; n < files_.size(); ++n)
      if (fmt::format("{:016x}", files_[n].input.xxh3) == xxh3) is_met_[n] = is_one = true;
    return is_one;
  }
  [[nodiscard]] std::vector<std::string> not_met() const {
    std::vector<std::string> names;
    for (std::size_t n = 0; n < files_.size(); ++n)
      if (!is_met_[n]) names.push_back(files_[n].input.name);
    return names;
  }

 private:
  std::vector<PackedCityFile> files_;
  std::vector<bool> is_met_;
};

}  // namespace

EnrichedCityFiles::EnrichedCityFiles(const Package& package, const std::string& package_name, const fs::path& city,
                                     const AnswerColumns& columns) {
  std::error_code error;
  is_folder_ = fs::is_directory(city, error);
  if (is_folder_)
    add_folder(package, package_name, city, columns);
  else
    files_.push_back({city, city.filename(), EnrichedCityFile(package, package_name, city, columns)});
}

void EnrichedCityFiles::add_folder(const Package& package, const std::string& package_name, const fs::path& folder,
                                   const AnswerColumns& columns) {
  PackedFiles packed(package);
  std::vector<std::string> others;
  for (const fs::path& path : files_below(folder)) {
    const fs::path name = path.lexically_relative(folder);
    if (packed.take(path))
      files_.push_back({path, name, EnrichedCityFile(package, package_name, path, columns)});
    else if (city_format_of(path))
      others.push_back(name.string());
  }
  if (files_.empty())
    throw InputError(folder.string() + " holds no CityGML or CityJSON file that " + package_name +
                     " was made of, by the checksums of its manifest. Give the folder as it was packed, or pack this one.");
  if (!others.empty())
    notes_.push_back("In " + folder.string() + ", " + list_of(others) + (others.size() == 1 ? " is no file" : " are no files") +
                     " of the package, and left out.");
  if (const std::vector<std::string> missing = packed.not_met(); !missing.empty())
    notes_.push_back("Of the package, " + list_of(missing) + (missing.size() == 1 ? " is" : " are") + " not in " +
                     folder.string() + ".");
}

void EnrichedCityFiles::require_fitting(const fs::path& output) const {
  if (!is_folder_) return files_.front().file.require_fitting(output);
  std::error_code error;
  if (fs::exists(output, error) && !fs::is_directory(output, error))
    throw OutputError(output, "it is a file, and --city a folder: choose a folder for -o, too");
  for (const NamedCityFile& file : files_)
    if (fs::exists(output / file.name, error))
      throw OutputError(output / file.name, "it is there already: remove it, or choose another folder for -o");
}

double EnrichedCityFiles::bytes() const {
  double bytes = 0.0;
  for (const NamedCityFile& file : files_) bytes += static_cast<double>(fs::file_size(file.path));
  return bytes;
}

std::vector<std::string> EnrichedCityFiles::write(const Package& package, const SurfaceMeans& means,
                                                  const fs::path& output) const {
  if (!is_folder_) return files_.front().file.write(package, means, output);
  std::vector<std::string> notes = notes_;
  for (const NamedCityFile& file : files_) {
    const fs::path path = output / file.name;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) throw OutputError(path, "its folder cannot be made (" + error.message() + "): choose another folder for -o");
    for (const std::string& note : file.file.write(package, means, path)) notes.push_back(file.name.string() + ": " + note);
  }
  return notes;
}

}  // namespace farlod
