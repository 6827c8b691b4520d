// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <utility>

#include "console/option_list.hpp"

namespace farlod {

CLI::Validator between(double low, double high) {
  const auto complaint = [low, high](const std::string& text) {
    double value = 0.0;
    const bool fits = CLI::detail::lexical_cast(text, value) && low <= value && value <= high;
    return fits ? std::string() : fmt::format("{} is not a number from {} to {}", text, low, high);
  };
  return {complaint, fmt::format("[{}, {}]", low, high), "between"};
}

namespace {

/// CLI11 calls the group of --help and --version "Options", as all options are called.
constexpr const char *unnamed_group = "Options", *name_of_unnamed_group = "Help";

/// What the checks of an option say of themselves, as CLI11 shows it: "{roofs,walls}", "[0, 10]".
void add_condition(const std::string& condition, OptionDescription& option) {
  static const std::regex set(R"(\{(.*)\})"), interval(R"(\[(\S+), (\S+)\])");
  std::smatch found;
  if (std::regex_match(condition, found, set))
    option.choices = CLI::detail::split(found[1], ',');
  else if (std::regex_match(condition, found, interval))
    option.range = "from " + found[1].str() + " to " + found[2].str();
  else
    option.range = condition == "POSITIVE" ? "more than 0" : condition;
}

}  // namespace

OptionDescription description_of(const CLI::Option& o) {
  OptionDescription option;
  for (const std::string& name : o.get_snames()) option.names.push_back("-" + name);
  for (const std::string& name : o.get_lnames()) option.names.push_back("--" + name);
  if (o.get_positional()) option.names = {o.get_name(true)};
  if (o.get_type_size() != 0) {
    // CLI11 puts the name of the type first, then what each check says
    const std::string type = o.get_type_name();
    const std::size_t colon = std::min(type.find(':'), type.size());
    option.value = type.substr(0, colon);
    if (colon < type.size()) add_condition(type.substr(colon + 1), option);
  }
  option.standard = o.get_default_str();
  option.text = o.get_description();
  option.required = o.get_required();
  option.repeatable = o.get_expected_max() >= CLI::detail::expected_max_vector_size;
  for (const CLI::Option* other : o.get_excludes()) option.excluded.push_back(other->get_name());
  std::sort(option.excluded.begin(), option.excluded.end());  // CLI11 keeps them by address
  return option;
}

namespace {

void add_groups(const CLI::App& app, std::vector<OptionGroup>& groups) {
  for (const std::string& name : app.get_groups()) {
    OptionGroup group{name, "", false, {}};
    for (const CLI::Option* o : app.get_options([&](const CLI::Option* each) { return each->get_group() == name; }))
      if (o->nonpositional()) group.options.push_back(description_of(*o));
    if (!name.empty() && !group.options.empty()) groups.push_back(std::move(group));
  }
}

/// CLI11's option groups are programs without a name; no program of ours has other subcommands.
OptionGroup described_group(const CLI::App& app) {
  OptionGroup group{app.get_group(), app.get_description(), false, {}};
  group.exactly_one = app.get_require_option_min() == 1 && app.get_require_option_max() == 1;
  // Each group has a --help of its own, which CLI11 does not show either
  for (const CLI::Option* o : app.get_options([&](const CLI::Option* each) { return each != app.get_help_ptr(); }))
    if (!o->get_group().empty()) group.options.push_back(description_of(*o));
  return group;
}

}  // namespace

OptionList options_of(const CLI::App& app) {
  OptionList list;
  for (const CLI::Option* o : app.get_options([](const CLI::Option* each) { return each->get_positional(); }))
    list.arguments.push_back(description_of(*o));
  for (const CLI::App* group : app.get_subcommands([](const CLI::App*) { return true; }))
    list.groups.push_back(described_group(*group));
  add_groups(app, list.groups);
  std::stable_partition(list.groups.begin(), list.groups.end(), [](const OptionGroup& g) { return g.name != unnamed_group; });
  for (OptionGroup& group : list.groups)
    if (group.name == unnamed_group) group.name = name_of_unnamed_group;
  return list;
}

}  // namespace farlod
