// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/package_origin.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace farlod {
namespace {

std::string difference_of_inputs(const std::vector<PackageOrigin::Input>& was, const std::vector<PackageOrigin::Input>& is) {
  for (const PackageOrigin::Input& input : is)
    if (!input.is_known) return input.name + " is a pipe, and what came through it before is not known";
  if (was.size() != is.size())
    return "it was made of " + std::to_string(was.size()) + " input files, and there are " + std::to_string(is.size());
  for (std::size_t n = 0; n < is.size(); ++n) {
    if (was[n].name != is[n].name) return "its input was " + was[n].name + ", and is " + is[n].name;
    if (!was[n].is_known || was[n].stamp != is[n].stamp) return "the input " + is[n].name + " has changed";
  }
  return {};
}

std::string difference_of_settings(const std::vector<std::pair<std::string, std::string>>& was,
                                   const std::vector<std::pair<std::string, std::string>>& is) {
  const std::map<std::string, std::string> before(was.begin(), was.end()), now(is.begin(), is.end());
  std::set<std::string> names;
  for (const auto* settings : {&before, &now})
    for (const auto& [name, value] : *settings) names.insert(name);
  for (const std::string& name : names) {
    const auto old_value = before.find(name), value = now.find(name);
    if (old_value == before.end()) return "--" + name + " was not given, and is " + value->second;
    if (value == now.end()) return "--" + name + " was " + old_value->second + ", and is not given";
    if (old_value->second != value->second) return "--" + name + " was " + old_value->second + ", and is " + value->second;
  }
  return {};
}

}  // namespace

std::string difference(const PackageOrigin& was, const PackageOrigin& is) {
  if (was.software != is.software) return "the program was " + was.software + ", and is " + is.software;
  std::string of_settings = difference_of_settings(was.settings, is.settings);
  return of_settings.empty() ? difference_of_inputs(was.inputs, is.inputs) : of_settings;
}

}  // namespace farlod
