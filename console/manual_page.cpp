// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "console/manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "console/roff_text.hpp"

namespace farlod {
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
