// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/unread_file.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/nearest_word.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

/// Whether a user has put commas between the names of several files.
bool is_list_of_files(std::string_view text) {
  if (text.find(',') == text.npos) return false;
  std::error_code unread;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    if (!fs::exists(fs::path(text.substr(0, end)), unread)) return false;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

std::string why_missing(const fs::path& file) {
  const std::string name = file.string();
  if (name.find("://") != name.npos) return name + " is an address of the web: download the file first, and name that.";
  if (is_list_of_files(name)) return name + " does not exist: put blanks between the names of files, and no commas.";
  if (const auto nearest = nearest_word(file.filename().string(), names_in_folder(file.parent_path())))
    return name + " does not exist; did you mean " + (file.parent_path() / *nearest).string() + "?";
  return name + " does not exist. Check the path.";
}

}  // namespace

std::string why_unread(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return why_missing(file);
  if (fs::is_directory(file, error)) return file.string() + " is a folder: give a file.";
  if (fs::is_regular_file(file, error) && fs::file_size(file, error) == 0)
    return file.string() + " is empty: 0 bytes. Was the download cut short?";
  return file.string() + " cannot be read: see that you may read it.";
}

std::vector<std::string> names_in_folder(const fs::path& folder) {
  constexpr std::size_t most_names = 10'000;
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator() && names.size() < most_names; entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace farlod
