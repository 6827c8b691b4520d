// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <regex>
#include <string_view>
#include <utility>

namespace farlod {
namespace {

constexpr std::size_t longest_file = 400, longest_function = 25, longest_prose_line = 120;

/// Path and reason of each file that may be longer. Nobody has needed it so far.
constexpr std::array<std::pair<std::string_view, std::string_view>, 0> long_for_a_reason{};

/// Tests that measure time or resident memory, and why they may.
constexpr std::pair<std::string_view, std::string_view> measuring_for_a_reason[] = {
    {"tests/architecture/house_rules.cpp", "says what is forbidden"},
    {"tests/preprocess/city/paged_memory_test.cpp", "a limit lies above what is resident"},
    {"tests/reliability/soak.cpp", "goes on for so long; the memory limit before a release"},
    {"tests/runtime/view/http_server_test.cpp", "a client that is slow"},
    {"tests/scenes/packed_city.cpp", "tells benchmarks what packing took"},
};

/// What gives tests a folder of their own, of the folder that all share.
constexpr std::pair<std::string_view, std::string_view> givers_of_folders[] = {
    {"tests/scenes/temporary_folder.hpp", "for the tests"},
    {"tests/fuzz/scratch_folder.hpp", "for the fuzz programs, which link no gtest"},
};

struct LongFunction {
  std::string_view path, name, reason;
};
constexpr LongFunction long_functions[] = {
    {"datasets/generator/city_settings.hpp", "describe", "a list: one line for each setting"},
    {"preprocess/app/pack_options.cpp", "add_input_options", "a list: one statement for each option"},
    {"preprocess/ingest/citygml/citygml_reading.cpp", "undo", "a switch: one case for each meaning of an element"},
    {"package/horizon_edge.hpp", "may_be_silhouette", "a proof, case by case"},
    {"preprocess/tiles/tiles.cpp", "place_building", "one building's way through cutting, which shares a dozen values"},
};

/// CGAL, which farlod-pack is built on, and PyQGIS, which the plug-in is, have the GPL.
bool is_under_gpl(const SourceFile& file) {
  return file.path.starts_with("preprocess/") || file.path.starts_with("python/preprocess/") || file.path.starts_with("qgis/");
}

bool begins_with_licence(const SourceFile& file, std::string_view mark) {
  const std::string licence = is_under_gpl(file) ? "GPL-3.0-or-later" : "Apache-2.0";
  // A script's first line names its interpreter
  const std::size_t first = !file.lines.empty() && file.lines[0].starts_with("#!") ? 1 : 0;
  if (file.lines.size() < first + 2) return false;
  return file.lines[first] == std::string(mark) + " SPDX-FileCopyrightText: The Far-LoD authors" &&
         file.lines[first + 1] == std::string(mark) + " SPDX-License-Identifier: " + licence;
}

/// Whether a list of paths and reasons has this path.
template <class List>
bool lists(const List& excuses, std::string_view path) {
  return std::any_of(std::begin(excuses), std::end(excuses), [&](const auto& excuse) { return excuse.first == path; });
}

template <class Condition>
std::vector<std::string> paths_where(const std::vector<SourceFile>& tree, Condition condition) {
  std::vector<std::string> paths;
  for (const SourceFile& file : tree)
    if (condition(file)) paths.push_back(file.path);
  return paths;
}

}  // namespace

std::vector<std::string> files_without_licence(const std::vector<SourceFile>& tree) {
  return paths_where(tree, [](const SourceFile& file) {
    const bool has_slashes = is_cpp(file) || is_script_of_page(file);
    return !begins_with_licence(file, has_slashes ? "//" : "#");
  });
}

namespace {

bool is_long(const SourceFile& file) { return (is_cpp(file) || is_script_of_page(file)) && file.lines.size() > longest_file; }

}  // namespace

std::vector<std::string> files_too_long(const std::vector<SourceFile>& tree) {
  return paths_where(tree, [](const SourceFile& file) { return is_long(file) && !lists(long_for_a_reason, file.path); });
}

namespace {

std::size_t indentation(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

bool ends_statement(const std::string& line) {
  static const std::regex end("^\\s*(|//.*|#.*|.*[;{}:])$");
  return std::regex_match(line, end);
}

/// The name of the function that the lines [begin, brace] open the body of; empty when they open something else.
std::string function_opened_by(const SourceFile& file, std::size_t begin, std::size_t brace) {
  std::string head;
  for (std::size_t n = begin; n <= brace; ++n) head.append(file.lines[n].substr(indentation(file.lines[n]))).append(" ");
  static const std::regex other(
      "^(namespace|class|struct|union|enum|extern|if|for|while|switch|do|else|try|catch|return|case|default|"
      "static_assert|TEST|INSTANTIATE)\\b|^\\}|[=(,]\\s*(\\w|::)*\\{ $|=\\s*\\[");
  static const std::regex name(R"((~?\w+|operator\S+)\()");
  std::smatch match;
  if (std::regex_search(head, other) || !std::regex_search(head, match, name)) return "";
  return match[1];
}

bool is_line_of_code(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin != std::string::npos && line.compare(begin, 2, "//") != 0;
}

struct FoundFunction {
  std::string path, name;
  std::size_t line = 0, code = 0;

  [[nodiscard]] bool is_meant_by(const LongFunction& excuse) const { return excuse.path == path && excuse.name == name; }
};

bool is_excused(const FoundFunction& function) {
  return std::any_of(std::begin(long_functions), std::end(long_functions),
                     [&](const LongFunction& excuse) { return function.is_meant_by(excuse); });
}

void add_long_functions(const SourceFile& file, std::vector<FoundFunction>& found) {
  for (std::size_t brace = 0; brace < file.lines.size(); ++brace) {
    if (!file.lines[brace].ends_with(" {")) continue;
    std::size_t begin = brace;
    while (begin > 0 && !ends_statement(file.lines[begin - 1])) --begin;
    const std::string name = function_opened_by(file, begin, brace);
    if (name.empty()) continue;
    const std::string close = std::string(indentation(file.lines[begin]), ' ') + "}";
    std::size_t end = brace + 1, code = 0;
    for (; end < file.lines.size() && !file.lines[end].starts_with(close); ++end)
      code += is_line_of_code(file.lines[end]) ? 1 : 0;
    if (code > longest_function) found.push_back({file.path, name, begin + 1, code});
    brace = end;
  }
}

/// Those with an excuse, too.
std::vector<FoundFunction> long_functions_of(const std::vector<SourceFile>& tree) {
  std::vector<FoundFunction> found;
  for (const SourceFile& file : tree)
    if (is_cpp(file) && !file.path.starts_with("tests/")) add_long_functions(file, found);
  return found;
}

}  // namespace

std::vector<std::string> functions_too_long(const std::vector<SourceFile>& tree) {
  std::vector<std::string> found;
  for (const FoundFunction& f : long_functions_of(tree))
    if (!is_excused(f))
      found.push_back(f.path + ":" + std::to_string(f.line) + " " + f.name + " has " + std::to_string(f.code) + " lines");
  return found;
}

std::vector<std::string> files_with_empty_names(const std::vector<SourceFile>& tree) {
  static const std::regex empty_name("(^|[/_])(utils?|utilities|helpers?|common|misc|manager)([/_.]|$)");
  return paths_where(tree, [](const SourceFile& file) { return std::regex_search(file.path, empty_name); });
}

std::vector<std::string> files_with_notes_to_self(const std::vector<SourceFile>& tree) {
  // Spelt in two parts, so that this file does not find itself
  static const std::regex note(
      "\\b(TO"
      "DO|FIX"
      "ME|XX"
      "X|HA"
      "CK)\\b");
  const auto has_note = [](const std::string& line) { return std::regex_search(line, note); };
  return paths_where(tree, [&](const SourceFile& file) { return std::any_of(file.lines.begin(), file.lines.end(), has_note); });
}

namespace {

bool has_line_with(const SourceFile& file, const std::regex& what) {
  return std::ranges::any_of(file.lines, [&](const std::string& line) { return std::regex_search(line, what); });
}

bool names_shared_folder(const SourceFile& file) {
  static const std::regex shared_folder(R"(\b(TempDir|temp_directory_path)\(\))");
  return file.path.starts_with("tests/") && is_cpp(file) && has_line_with(file, shared_folder);
}

bool measures(const SourceFile& file) {
  static const std::regex measure(
      R"(\b(steady_clock|system_clock|high_resolution_clock|sleep_(for|until)|getrusage|VmHWM|VmRSS)\b|std::clock\()");
  return file.path.starts_with("tests/") && is_cpp(file) && has_line_with(file, measure);
}

}  // namespace

std::vector<std::string> tests_without_own_folder(const std::vector<SourceFile>& tree) {
  return paths_where(tree,
                     [](const SourceFile& file) { return names_shared_folder(file) && !lists(givers_of_folders, file.path); });
}

std::vector<std::string> tests_that_depend_on_the_machine(const std::vector<SourceFile>& tree) {
  return paths_where(tree, [](const SourceFile& file) { return measures(file) && !lists(measuring_for_a_reason, file.path); });
}

namespace {

/// Adds the paths of a list that do not break the rule.
template <class List, class Breaks>
void add_useless(const List& excuses, const std::vector<SourceFile>& tree, const Breaks& breaks,
                 std::vector<std::string>& found) {
  for (const auto& excuse : excuses)
    if (std::ranges::none_of(tree, [&](const SourceFile& file) { return file.path == excuse.first && breaks(file); }))
      found.emplace_back(excuse.first);
}

}  // namespace

std::vector<std::string> useless_excuses(const std::vector<SourceFile>& tree) {
  std::vector<std::string> found;
  add_useless(long_for_a_reason, tree, is_long, found);
  const std::vector<FoundFunction> functions = long_functions_of(tree);
  for (const LongFunction& excuse : long_functions)
    if (std::ranges::none_of(functions, [&](const FoundFunction& f) { return f.is_meant_by(excuse); }))
      found.push_back(std::string(excuse.path) + " " + std::string(excuse.name));
  add_useless(givers_of_folders, tree, names_shared_folder, found);
  add_useless(measuring_for_a_reason, tree, measures, found);
  return found;
}

std::vector<std::string> comments_without_subject(const std::vector<SourceFile>& tree) {
  static const std::regex room("^(base|include|console|gdal|package|preprocess|runtime)/"), begins_with_of(R"(//[/<!]*\s*Of\s)");
  std::vector<std::string> found;
  for (const SourceFile& file : tree)
    for (std::size_t n = 0; n < file.lines.size(); ++n)
      if (is_cpp(file) && std::regex_search(file.path, room) && std::regex_search(file.lines[n], begins_with_of))
        found.push_back(file.path + ":" + std::to_string(n + 1));
  return found;
}

namespace {

/// Number of characters of UTF-8, whose bytes 10xxxxxx continue a character.
std::size_t character_count(const std::string& line) {
  return static_cast<std::size_t>(std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::vector<std::string> prose_lines_too_long(const std::vector<SourceFile>& documents) {
  std::vector<std::string> found;
  for (const SourceFile& document : documents)
    for (std::size_t n = 0; n < document.lines.size(); ++n) {
      const std::size_t length = character_count(document.lines[n]);
      if (length > longest_prose_line && !document.lines[n].starts_with("|"))
        found.push_back(document.path + ":" + std::to_string(n + 1) + " has " + std::to_string(length) + " characters");
    }
  return found;
}

}  // namespace farlod
