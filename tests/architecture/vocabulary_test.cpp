// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/rules.hpp"

// Words that the project no longer uses, and classes that have one name.

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A word that the project no longer uses, and the term of docs/glossary.md that replaces it.
///   (1) between backticks it is an identifier, and is found where it stands as a whole in code, not in comments
///   (2) otherwise it is a phrase, and is found in names and in prose, however it is written: "unnamed city" also in UnnamedCity
///       and unnamed_city
struct RetiredWord {
  std::string word, use_instead;
  bool is_identifier = false;
};

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

/// The words of a line in lower case, parted by single blanks, with one before and behind: of names, too.
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

/// The lines of retired_words.txt. Throws std::runtime_error where there are none, or where one is not "word | term".
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

/// "path:line: word -> term" for each retired word in a file.
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

/// The classes, structs, unions and enums that a file defines outside of functions and of unnamed namespaces, with their
/// namespaces and outer classes: "farlod::tiles::EdgeTable::Hash".
std::vector<std::string> class_definitions(const SourceFile& file) { return ScopeWalk(code_of(file)).classes; }

/// Qualified names with two definitions in the code that may be linked into one program: the library folders, which the tests
/// link together, and their programs. Two definitions break the one-definition rule, which no compiler reports. Each is one
/// sentence.
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

const std::filesystem::path source_root = FARLOD_SOURCE_DIR;

/// All but the tests of the list, the changelog, which tells old names, and the bibliography, whose titles are those of others.
std::vector<SourceFile> texts() {
  std::vector<SourceFile> files = read_source_tree(source_root), documents = read_documents(source_root);
  files.insert(files.end(), documents.begin(), documents.end());
  std::erase_if(files, [](const SourceFile& f) {
    return f.path == "CHANGELOG.md" || f.path == "docs/bibliography.md" || f.path.starts_with("tests/architecture/vocabulary");
  });
  return files;
}

TEST(Vocabulary, NoRetiredWordIsLeft) {
  EXPECT_THAT(find_retired_words(texts(), read_retired_words(source_root / "tests/architecture/retired_words.txt")), IsEmpty());
}

TEST(Vocabulary, NamesAndProseAreReadAsWords) {
  EXPECT_EQ(words_of("class UnnamedCity : unnamed_city2 {"), " class unnamed city unnamed city ");
  EXPECT_EQ(words_of(""), " ");
}

TEST(Vocabulary, APhraseIsFoundHoweverItIsWritten) {
  const std::vector<RetiredWord> words{{"unnamed city", "residual horizon", false}};
  EXPECT_THAT(
      find_retired_words({{"a.cpp", {"", "UnnamedCity city;", "the unnamed", "unnamed_city_", "// The unnamed city"}}}, words),
      ElementsAre(HasSubstr("a.cpp:2: unnamed city -> residual horizon"), HasSubstr("a.cpp:4"), HasSubstr("a.cpp:5")));
}

TEST(Vocabulary, AnIdentifierIsFoundAsAWhole) {
  const std::vector<RetiredWord> words{{"likely", "estimate", true}};
  EXPECT_THAT(find_retired_words({{"a.cpp", {"likely = 1;", "unlikely", "likely_", "x.likely", "a;  // likely"}}}, words),
              ElementsAre(HasSubstr("a.cpp:1"), HasSubstr("a.cpp:4")));
}

TEST(ClassNames, HaveOneDefinitionInThisTree) {
  const std::vector<SourceFile> tree = read_source_tree(FARLOD_SOURCE_DIR);
  EXPECT_THAT(classes_defined_twice(tree), IsEmpty());
  std::size_t count = 0;
  for (const SourceFile& file : tree) count += class_definitions(file).size();
  EXPECT_GT(count, 400U) << "the definitions of this tree were not found";
}

TEST(ClassNames, AreFoundWithTheirScopes) {
  const SourceFile file{"preprocess/a/a.hpp",
                        {"#define OPEN {",                                    //
                         "namespace farlod::a {",                             //
                         "enum class Kind : std::uint8_t { one, two };",      //
                         "struct Forward;",                                   //
                         "template <class T> struct Box final : Base<T> {",   //
                         "  struct Lid { int n = 1'000; };  // }",            //
                         "  bool is_open() const { return text == \"{\"; }",  //
                         "};",                                                //
                         "inline void work() { struct Local { int n; }; }",   //
                         "struct Box2::Impl { int n; };",                     //
                         "namespace {",                                       //
                         "struct Private { };",                               //
                         "}",                                                 //
                         "class Last { };",                                   //
                         "}"}};
  EXPECT_THAT(class_definitions(file), ElementsAre("farlod::a::Kind", "farlod::a::Box", "farlod::a::Box::Lid",
                                                   "farlod::a::Box2::Impl", "farlod::a::Last"));
}

TEST(ClassNames, ANameOfTwoModulesIsFound) {
  const std::vector<std::string> unit{"namespace farlod {", "struct LengthUnit { };", "}"};
  const std::vector<std::string> other{"namespace farlod {", "enum class LengthUnit { metre, foot };", "}"};
  const std::vector<std::string> of_module{"namespace farlod::ingest {", "enum class LengthUnit { metre, foot };", "}"};
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"preprocess/b/text.hpp", other}}),
              ElementsAre("farlod::LengthUnit is defined in preprocess/a/crs.hpp preprocess/b/text.hpp"));
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"preprocess/b/text.hpp", of_module}}), IsEmpty());
  EXPECT_THAT(classes_defined_twice({{"preprocess/a/crs.hpp", unit}, {"tests/b/text.hpp", other}}), IsEmpty());
}

}  // namespace
}  // namespace farlod
