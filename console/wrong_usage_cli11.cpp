// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "base/nearest_word.hpp"
#include "base/unread_file.hpp"
#include "console/option_list.hpp"
#include "console/wrong_usage.hpp"

namespace farlod {

CLI::Validator one_of_words(const std::vector<std::string>& words) {
  const auto complaint = [words](const std::string& text) {
    if (std::ranges::find(words, text) != words.end()) return std::string();
    return fmt::format("{} is not one of {}{}", text, fmt::join(words, ", "), did_you_mean(text, words));
  };
  return {complaint, fmt::format("{{{}}}", fmt::join(words, ",")), "one_of"};
}

namespace {

/// What a word processor makes of two hyphens.
constexpr std::string_view en_dash = "\u2013", em_dash = "\u2014";

bool has_long_dash(std::string_view word) { return word.starts_with(en_dash) || word.starts_with(em_dash); }

bool is_like_option(std::string_view word) {
  return has_long_dash(word) ||
         (word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0 && word[1] != '.');
}

void for_each_option(const CLI::App& app, const std::function<void(const CLI::Option&)>& visit) {
  for (const CLI::Option* o : app.get_options()) visit(*o);
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; })) for_each_option(*group, visit);
}

const CLI::Option* option_named(const CLI::App& app, const std::string& name) {
  const CLI::Option* found = nullptr;
  for_each_option(app, [&](const CLI::Option& o) {
    if (o.get_name() == name || o.get_name(true) == name || o.check_name(name)) found = &o;
  });
  return found;
}

/// Without dashes.
std::vector<std::string> long_names(const CLI::App& app) {
  std::vector<std::string> names;
  for_each_option(app, [&](const CLI::Option& o) { names.insert(names.end(), o.get_lnames().begin(), o.get_lnames().end()); });
  return names;
}

/// "there is no such option; did you mean --grid?"
std::string unknown_option(const CLI::App& app, const std::string& word) {
  const std::string written = word.substr(0, word.find('='));
  std::size_t begin = written.find_first_not_of('-');
  if (has_long_dash(written)) begin = en_dash.size();
  const std::string name = begin < written.size() ? written.substr(begin) : "";
  const std::optional<std::string> nearest = nearest_word(name, long_names(app));
  return fmt::format("{}: {}{}", written,
                     has_long_dash(written) ? "options begin with two hyphens, and not with a dash" : "there is no such option",
                     nearest ? "; did you mean --" + *nearest + "?" : "");
}

/// The option that was given a file or folder of the same kind as this one; null: none.
const CLI::Option* option_of_one_path(const CLI::App& app, const std::filesystem::path& path) {
  std::error_code unread;
  const auto is_like = [&](const std::filesystem::path& given) {
    return std::filesystem::exists(given, unread) && given.extension() == path.extension() &&
           std::filesystem::is_directory(given, unread) == std::filesystem::is_directory(path, unread);
  };
  const CLI::Option* found = nullptr;
  if (!std::filesystem::exists(path, unread)) return found;
  for_each_option(app, [&](const CLI::Option& o) {
    const bool takes_one = o.get_lnames().empty() ? false : o.get_items_expected_max() == 1;
    if (takes_one && o.count() == 1 && is_like(o.results().front())) found = &o;
  });
  return found;
}

/// One argument too many.
std::string unknown_argument(const CLI::App& app, const std::string& word) {
  if (const CLI::Option* const option = option_of_one_path(app, word)) {
    const bool is_folder = std::filesystem::is_directory(word);
    return fmt::format("{} is one too many: {} takes one {}, and has {}; {}", word, option->get_name(),
                       is_folder ? "folder" : "file", option->results().front(),
                       is_folder ? "give the folder that holds both" : "give each file a run of its own, or make one of them");
  }
  const bool is_number = !word.empty() && word.find_first_not_of("0123456789.,-+") == word.npos;
  return word + ": nothing is known of this argument; " +
         (is_number ? "numbers of one option are joined by commas, without blanks" : "put what has spaces into quotes");
}

/// What --help says of an option, up to where it goes into particulars, as a part of a sentence.
std::string first_clause_of(const std::string& help) {
  std::string clause = help.substr(0, std::min({help.find(';'), help.find(". "), help.find(" ("), help.size()}));
  const bool is_word = clause.size() > 1 && std::islower(static_cast<unsigned char>(clause[1])) != 0;
  if (is_word || clause.starts_with("A ")) clause[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(clause[0])));
  return clause;
}

/// "give a number from 0 to 10".
std::string what_to_give(const CLI::Option& option) {
  const OptionDescription d = description_of(option);
  if (!d.choices.empty()) return fmt::format("give one of {}", fmt::join(d.choices, ", "));
  const bool is_whole = d.value == "INT" || d.value == "UINT";
  if (d.range.starts_with("from ")) return std::string("give a ") + (is_whole ? "whole " : "") + "number " + d.range;
  if (is_whole) return "give a whole number";
  if (d.value == "FLOAT") return "give a number";
  return first_clause_of(d.text);
}

/// Names an option that is missing, and what it would be.
std::string missing_text(const CLI::App& app, const std::string& what) {
  constexpr std::string_view end = " is required";
  const std::string name = what.ends_with(end) ? what.substr(0, what.size() - end.size()) : "";
  const CLI::Option* const option = option_named(app, name);
  if (option == nullptr) return what;
  const std::vector<std::string> rest = app.remaining();
  std::string text = what + ": " + what_to_give(*option);
  if (rest.empty() || option->get_snames().empty()) return text;
  return fmt::format("{}; is it {}? Write -{} {}", text, rest.front(), option->get_snames().front(), rest.front());
}

/// Names the options that were given of a group of which one may be.
std::optional<std::string> two_of_a_choice(const CLI::App& app) {
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; })) {
    std::vector<std::string> all, given;
    for (const CLI::Option* o : group->get_options([&](const CLI::Option* each) { return each != group->get_help_ptr(); })) {
      all.push_back(o->get_name());
      if (o->count() > 0) given.push_back(o->get_name());
    }
    if (given.size() > 1 && group->get_require_option_max() == 1)
      return fmt::format("{} exclude each other: give at most 1 of {}", fmt::join(given, " and "), fmt::join(all, ","));
  }
  return std::nullopt;
}

/// Names an option with too few or too many values.
std::string mismatch_text(const CLI::App& app, const std::string& what) {
  const CLI::Option* const option = option_named(app, what.substr(0, what.find(':')));
  if (option == nullptr) return what;
  if (option->count() > 1) return fmt::format("{} was given {} times: give it once", option->get_name(), option->count());
  return fmt::format("{} has no value: {}", option->get_name(), what_to_give(*option));
}

/// Names a value that is no number, or that a flag has.
std::string conversion_text(const CLI::App& app, const std::string& what) {
  constexpr std::string_view begin = "Could not convert: ", between_them = " = ";
  const std::size_t equals = what.find(between_them);
  if (!what.starts_with(begin) || equals == what.npos) return what;
  const std::string name = what.substr(begin.size(), equals - begin.size()), value = what.substr(equals + between_them.size());
  const CLI::Option* const option = option_named(app, name);
  if (option == nullptr) return what;
  if (description_of(*option).value.empty()) return fmt::format("{} takes no value: leave \"{}\" out", name, value);
  return fmt::format("{}: \"{}\" is not what it takes: {}", name, value, what_to_give(*option));
}

/// "--shard excludes --merge", "--trunk requires --canopy".
std::string pair_text(const std::string& what) {
  constexpr std::string_view excludes = " excludes ", needs = " requires ";
  if (const std::size_t place = what.find(excludes); place != what.npos)
    return fmt::format("{} and {} exclude each other: leave one of the two out", what.substr(0, place),
                       what.substr(place + excludes.size()));
  if (const std::size_t place = what.find(needs); place != what.npos)
    return fmt::format("{} goes with {}, which is missing", what, what.substr(place + needs.size()));
  return what;
}

/// Names what a file of options holds besides options.
std::string config_text(const CLI::App& app, const std::string& what) {
  constexpr std::string_view begin = "INI was not able to parse ";
  const std::string name = what.starts_with(begin) ? what.substr(begin.size()) : "";
  const bool is_name = !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_-") == name.npos;
  if (!is_name)
    return fmt::format("--config: {}; give TOML, or the --summary of a run",
                       name.empty() ? what : "the file has no options, but \"" + name + "\"");
  return fmt::format("--config: {} is no option; name options as --help does, without the dashes{}", name,
                     did_you_mean(name, long_names(app)));
}

/// Names a file of options that is not there.
std::string unread_config(const std::string& what) {
  return "--config: " + why_unread(what.substr(0, what.find(" was not readable")));
}

std::optional<std::string> option_as_value(const CLI::App& app) {
  std::optional<std::string> text;
  for_each_option(app, [&](const CLI::Option& option) {
    if (option.get_type_size() == 0) return;
    for (const std::string& value : option.results())
      if (value.starts_with("--") && option_named(app, value.substr(0, value.find('='))) != nullptr)
        text = fmt::format("{} has no value, and {} follows: {}", option.get_name(), value, what_to_give(option));
  });
  return text;
}

}  // namespace

void require_no_option_as_value(const CLI::App& app) {
  if (const auto text = option_as_value(app)) throw CLI::ValidationError(*text);
}

std::string wrong_usage_text(const CLI::App& app, const CLI::ParseError& error) {
  if (const auto text = option_as_value(app)) return *text;
  const std::vector<std::string> rest = app.remaining();
  const auto misspelt = std::ranges::find_if(rest, is_like_option);
  if (misspelt != rest.end()) return unknown_option(app, *misspelt);
  std::string what = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return unknown_argument(app, rest.empty() ? what : rest.front());
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    const auto two = two_of_a_choice(app);
    return two ? *two : missing_text(app, what);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return mismatch_text(app, what);
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return conversion_text(app, what);
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr || dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
    return pair_text(what);
  if (dynamic_cast<const CLI::ConfigError*>(&error) != nullptr) return config_text(app, what);
  if (dynamic_cast<const CLI::FileError*>(&error) != nullptr) return unread_config(what);
  return what;
}

}  // namespace farlod
