// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/manual_page.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <regex>

namespace farlod {
namespace {

constexpr std::size_t longest_source_line = 80;

/// The first character of UTF-8, which is taken from `text`. Bytes that are no UTF-8 are taken one by one.
char32_t take_character(std::string_view& text) {
  const auto first = static_cast<std::uint8_t>(text.front());
  text.remove_prefix(1);
  const int length = std::countl_one(first);
  if (length < 2) return first;
  auto character = static_cast<char32_t>(first & (0x7F >> length));
  for (int n = 1; n < length && !text.empty(); ++n, text.remove_prefix(1))
    character = character << 6 | (static_cast<std::uint8_t>(text.front()) & 0x3F);
  return character;
}

std::string roff_character(char32_t c) {
  switch (c) {
    case '\\':
      return "\\(rs";
    case '"':
      return "\\(dq";
    case '`':
      return "\\(ga";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    default:
      return c < 0x80 ? std::string(1, static_cast<char>(c)) : fmt::format("\\[u{:04X}]", static_cast<std::uint32_t>(c));
  }
}

/// What stands between names. A hyphen within a word is one; before a word it is a minus sign.
std::string roff_prose(std::string_view text, bool begins_word) {
  std::string roff;
  // At the beginning of a line these two would begin a command, and each word may come to stand there
  if (begins_word && (text.starts_with('.') || text.starts_with('\''))) roff = "\\&";
  for (bool after_letter = !begins_word; !text.empty(); after_letter = true) {
    const char32_t c = take_character(text);
    roff.append(c == '-' && !after_letter ? "\\-" : roff_character(c));
  }
  return roff;
}

std::string roff_word(const std::string& word) {
  static const std::regex name("(^|[^A-Za-z0-9-])(--?[A-Za-z][A-Za-z0-9-]*|farlod-[a-z]+)");
  std::string roff;
  std::size_t end = 0;
  for (std::sregex_iterator match(word.begin(), word.end(), name); match != std::sregex_iterator(); ++match) {
    const auto begin = static_cast<std::size_t>(match->position(2));
    roff.append(roff_prose(std::string_view(word).substr(end, begin - end), end == 0));
    roff.append("\\fB").append(roff_literal(match->str(2))).append("\\fR");
    end = begin + match->str(2).size();
  }
  return roff.append(roff_prose(std::string_view(word).substr(end), end == 0));
}

bool ends_sentence(std::string_view word) {
  while (word.ends_with(')') || word.ends_with('"')) word.remove_suffix(1);
  return word.ends_with('.') || word.ends_with('!') || word.ends_with('?');
}

}  // namespace

std::string roff_literal(std::string_view text) {
  std::string roff = text.starts_with('.') ? "\\&" : "";
  while (!text.empty()) {
    const char32_t c = take_character(text);
    roff.append(c == '-' ? "\\-" : c == '\'' ? "\\(aq" : roff_character(c));
  }
  return roff;
}

std::string roff_paragraph(std::string_view text) {
  static const std::regex blanks("\\s+");
  std::string roff;
  std::size_t length = 0;
  bool sentence_ended = false;
  const std::string all(text);
  for (std::sregex_token_iterator word(all.begin(), all.end(), blanks, -1); word != std::sregex_token_iterator(); ++word) {
    if (word->length() == 0) continue;
    const std::string next = roff_word(*word);
    const bool breaks = length > 0 && (sentence_ended || length + 1 + next.size() > longest_source_line);
    roff.append(breaks ? "\n" : length > 0 ? " " : "").append(next);
    length = (breaks || length == 0 ? 0 : length + 1) + next.size();
    sentence_ended = ends_sentence(word->str());
  }
  return roff + "\n";
}

namespace {

std::string bold(std::string_view text) { return "\\fB" + roff_literal(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff_literal(text) + "\\fR"; }

std::string ended(const std::string& text) { return text.empty() || text.ends_with('.') ? text : text + "."; }

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return ended(text);
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

/// Paragraphs, with what `man` wants between them.
std::string roff_paragraphs(const std::vector<std::string>& paragraphs) {
  std::string roff;
  for (const std::string& paragraph : paragraphs) roff.append(roff.empty() ? "" : ".PP\n").append(roff_paragraph(paragraph));
  return roff;
}

/// Names and numbers of pages are copied and searched, which hyphenation would break; wide blanks come with it.
std::string title(const ProgramDescription& program, const PageEdition& edition) {
  std::string name = program.name;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(R"(.TH {} 1 "{}" "Far\-LoD {}" "Far\-LoD manual")", roff_literal(name), edition.date,
                     roff_literal(edition.version)) +
         "\n.nh\n.ad l\n";
}

/// "-o FILE", which stays on one line.
std::string usage_of(const OptionDescription& option) {
  return bold(option.names.front()) + (option.value.empty() ? "" : "\\ " + italic(option.value));
}

std::string usage_of_argument(const OptionDescription& argument) {
  const std::string name = italic(argument.names.front()) + (argument.repeatable ? "..." : "");
  return argument.required ? name : "[" + name + "]";
}

/// What must be given; that there is more is said in three letters.
std::string synopsis(const ProgramDescription& program, const OptionList& list) {
  std::string roff = ".SH SYNOPSIS\n.SY " + roff_literal(program.name) + "\n";
  for (const OptionDescription& argument : list.arguments) roff.append(usage_of_argument(argument)).append("\n");
  for (const OptionGroup& group : list.groups) {
    std::vector<std::string> usages;
    for (const OptionDescription& option : group.options)
      if (group.exactly_one || option.required) usages.push_back(usage_of(option));
    if (usages.empty()) continue;
    roff.append(group.exactly_one ? "{" + joined(usages, " |\n") + "}" : joined(usages, "\n")).append("\n");
  }
  return roff.append("[" + italic("OPTION") + "]...\n.YS\n");
}

std::string description(const ProgramDescription& program) {
  std::vector<std::string> paragraphs{program.name + " " + program.purpose + "."};
  paragraphs.insert(paragraphs.end(), program.background.begin(), program.background.end());
  paragraphs.insert(paragraphs.end(), program.notes.begin(), program.notes.end());
  return ".SH DESCRIPTION\n" + roff_paragraphs(paragraphs);
}

/// What --help says of an option in brackets and signs, in words.
std::string explanation_of(const OptionDescription& option) {
  std::vector<std::string> sentences{ended(option.text)};  // which may begin with a choice
  if (!option.choices.empty()) sentences.push_back("One of " + joined(option.choices, ", ") + ".");
  if (!option.range.empty()) sentences.push_back(sentence(option.range));
  if (!option.standard.empty()) sentences.push_back("Default: " + option.standard + ".");
  if (option.required) sentences.emplace_back("Required.");
  if (!option.excluded.empty()) sentences.push_back("Not together with " + joined(option.excluded, ", ") + ".");
  return joined(sentences, " ");
}

std::string entry(const OptionDescription& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(name.starts_with('-') ? bold(name) : italic(name));
  std::string roff = ".TP\n" + joined(names, ", ");
  if (option.names.front().starts_with('-') && !option.value.empty()) roff.append(" ").append(italic(option.value));
  if (option.repeatable) roff.append("...");
  return roff.append("\n").append(roff_paragraph(explanation_of(option)));
}

std::string options_section(const OptionList& list) {
  std::string roff = ".SH OPTIONS\n";
  if (!list.arguments.empty()) roff.append(".SS Arguments\n");
  for (const OptionDescription& argument : list.arguments) roff.append(entry(argument));
  for (const OptionGroup& group : list.groups) {
    roff.append(".SS ").append(roff_literal(group.name)).append("\n");
    const std::string rule = group.exactly_one ? " Exactly one of these options is required." : "";
    if (!group.text.empty() || !rule.empty()) roff.append(roff_paragraph(sentence(group.text) + rule));
    for (const OptionDescription& option : group.options) roff.append(entry(option));
  }
  return roff;
}

std::string exit_status(const ProgramDescription& program) {
  std::string roff = ".SH EXIT STATUS\n";
  for (const ExitMeaning& meaning : program.exit_codes)
    roff.append(".TP\n").append(std::to_string(meaning.code)).append("\n").append(roff_paragraph(sentence(meaning.text)));
  return roff;
}

std::string examples(const ProgramDescription& program) {
  std::string roff = ".SH EXAMPLES\n";
  for (const std::string& example : program.examples)
    roff.append(example == program.examples.front() ? "" : ".PP\n").append(".nf\n.RS\n" + roff_literal(example) + "\n.RE\n.fi\n");
  return roff;
}

std::string references(const ProgramDescription& program) {
  std::string roff = ".SH COPYRIGHT\n" + roff_paragraph("The Far-LoD authors. Licence: " + program.licence + ".");
  roff.append(".SH SEE ALSO\n");
  for (const std::string& other : program.see_also)
    roff.append(".BR ").append(roff_literal(other)).append(other == program.see_also.back() ? " (1)\n" : " (1),\n");
  return roff;
}

}  // namespace

std::string manual_page(const ProgramDescription& program, const OptionList& options, const PageEdition& edition) {
  // What `whatis` reads: one line without commands
  const std::string name = ".SH NAME\n" + roff_literal(program.name) + " \\- " + roff_literal(program.purpose) + "\n";
  return title(program, edition) + name + synopsis(program, options) + description(program) + options_section(options) +
         exit_status(program) + examples(program) + references(program);
}

}  // namespace farlod
