// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/vocabulary.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <regex>
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

namespace {

/// Replaces comments, literals and preprocessor lines by blanks: braces in them open nothing.
std::string code_of(const SourceFile& file) {
  static const std::regex not_code(
      R"re(R"(\w*)\([\s\S]*?\)\1"|//[^\n]*|/\*[\s\S]*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')re");
  std::string text;
  for (const std::string& line : file.lines) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool is_directive = first != line.npos && line[first] == '#';
    text.append(is_directive ? "" : line).append("\n");
  }
  // 1'000'000 is a number, not a character
  static const std::regex separator(R"((\d)'(?=\d))");
  text = std::regex_replace(text, separator, "$1");
  return std::regex_replace(text, not_code, " ");
}

class ScopeWalk {
 public:
  explicit ScopeWalk(const std::string& code) {
    // A namespace, the head of a class up to its brace, or a brace of anything else
    static const std::regex token(R"(\bnamespace\b\s*([\w:]*)\s*\{|\b(?:enum\s+class|enum\s+struct|enum|class|struct|union)\s+)"
                                  R"((?:\[\[\w+\]\]\s*)?(\w[\w:]*)(?:\s+final)?(?:\s*:[^;{}()=]*)?\s*\{|\{|\})");
    for (std::sregex_iterator it(code.begin(), code.end(), token), end; it != end; ++it) take(*it);
  }
  std::vector<std::string> classes;

 private:
  /// What a brace opened. Names within code, or within an unnamed namespace, are of one file only.
  struct Scope {
    std::string name;
    bool is_local = false;
  };

  void take(const std::smatch& token) {
    const std::string text = token.str();
    const bool was_local = !scopes_.empty() && scopes_.back().is_local;
    if (text == "}") {
      if (!scopes_.empty()) scopes_.pop_back();
    } else if (text == "{") {
      scopes_.push_back({"", true});
    } else if (text.starts_with("namespace")) {
      scopes_.push_back({token[1], was_local || token[1].length() == 0});
    } else {
      scopes_.push_back({token[2], was_local});
      if (!was_local) classes.push_back(qualified_name());
    }
  }

  [[nodiscard]] std::string qualified_name() const {
    std::string name;
    for (const Scope& scope : scopes_) name.append(name.empty() ? "" : "::").append(scope.name);
    return name;
  }

  std::vector<Scope> scopes_;
};

bool is_of_a_library(const SourceFile& file) {
  static const std::regex library("^(benchmark|console|datasets|gdal|include|preprocess|runtime|validation)/");
  return is_cpp(file) && std::regex_search(file.path, library);
}

}  // namespace

std::vector<std::string> class_definitions(const SourceFile& file) { return ScopeWalk(code_of(file)).classes; }

std::vector<std::string> classes_defined_twice(const std::vector<SourceFile>& tree) {
  std::map<std::string, std::vector<std::string>> files_of_class;
  for (const SourceFile& file : tree)
    if (is_of_a_library(file))
      for (const std::string& name : class_definitions(file)) files_of_class[name].push_back(file.path);
  std::vector<std::string> twice;
  for (const auto& [name, files] : files_of_class)
    if (files.size() > 1) {
      std::string sentence = name + " is defined in";
      for (const std::string& file : files) sentence.append(" ").append(file);
      twice.push_back(sentence);
    }
  return twice;
}

}  // namespace farlod
