// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/vocabulary.hpp"

#include <cctype>
#include <fstream>
#include <stdexcept>

namespace farlod {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_name_part(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool holds_identifier(std::string_view line, const std::string& name) {
  line = line.substr(0, line.find("//"));
  for (std::size_t at = line.find(name); at != std::string_view::npos; at = line.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_name_part(line[at - 1])) && (end == line.size() || !is_name_part(line[end]))) return true;
  }
  return false;
}

}  // namespace

std::string words_of(std::string_view line) {
  std::string words = " ";
  for (std::size_t n = 0; n < line.size(); ++n) {
    const bool begins_word = n > 0 && is_upper(line[n]) && is_letter(line[n - 1]) && !is_upper(line[n - 1]);
    if ((begins_word || !is_letter(line[n])) && words.back() != ' ') words += ' ';
    if (is_letter(line[n])) words += static_cast<char>(std::tolower(static_cast<unsigned char>(line[n])));
  }
  if (words.back() != ' ') words += ' ';
  return words;
}

std::vector<RetiredWord> read_retired_words(const std::filesystem::path& list) {
  std::ifstream in(list);
  std::vector<RetiredWord> words;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t bar = line.find(" | ");
    if (bar == 0 || bar == std::string::npos) throw std::runtime_error(list.string() + ": not \"word | term\": " + line);
    const std::string word = line.substr(0, bar), term = line.substr(bar + 3);
    const bool is_identifier = word.size() > 2 && word.front() == '`' && word.back() == '`';
    words.push_back({is_identifier ? word.substr(1, word.size() - 2) : word, term, is_identifier});
  }
  if (words.empty()) throw std::runtime_error(list.string() + " has no words");
  return words;
}

std::vector<std::string> find_retired_words(const std::vector<SourceFile>& files, const std::vector<RetiredWord>& words) {
  std::vector<std::string> found;
  for (const SourceFile& file : files)
    for (std::size_t n = 0; n < file.lines.size(); ++n) {
      const std::string plain = words_of(file.lines[n]);
      for (const RetiredWord& w : words)
        if (w.is_identifier ? is_cpp(file) && holds_identifier(file.lines[n], w.word)
                            : plain.find(words_of(w.word)) != std::string::npos)
          found.push_back(file.path + ":" + std::to_string(n + 1) + ": " + w.word + " -> " + w.use_instead);
    }
  return found;
}

}  // namespace farlod
