// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "package/unfinished_package.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

Json pair_of(const package::FileStamp& stamp) { return {stamp.bytes, stamp.xxh3}; }
package::FileStamp stamp_of_pair(const Json& j) { return {j.at(0).get<std::uint64_t>(), j.at(1).get<std::uint64_t>()}; }

std::string text_of(const Json& j) { return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// What `read` makes of a text; nothing of a text that is not what it should be.
template <class T, class Read>
std::optional<T> record_from(const std::string& text, const Read& read) {
  try {
    return read(Json::parse(text));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string record_text(const PackageOrigin& origin) {
  Json inputs = Json::array(), settings = Json::array();
  for (const PackageOrigin::Input& input : origin.inputs)
    inputs.push_back({{"name", input.name},
                      {"stamp", pair_of(input.stamp)},
                      {"known", input.is_known},
                      {"beside", input.is_beside},
                      {"path", input.path},
                      {"written_ns", input.written_ns}});
  for (const auto& [name, value] : origin.settings) settings.push_back({name, value});
  return text_of({{"software", origin.software}, {"inputs", inputs}, {"settings", settings}});
}

std::optional<PackageOrigin> origin_from(const std::string& text) {
  return record_from<PackageOrigin>(text, [](const Json& j) {
    PackageOrigin origin{j.at("software").get<std::string>(), {}, {}};
    for (const Json& input : j.at("inputs"))
      origin.inputs.push_back({input.at("name").get<std::string>(), stamp_of_pair(input.at("stamp")),
                               input.at("known").get<bool>(), input.at("beside").get<bool>(), input.at("path").get<std::string>(),
                               input.at("written_ns").get<std::int64_t>()});
    for (const Json& setting : j.at("settings"))
      origin.settings.emplace_back(setting.at(0).get<std::string>(), setting.at(1).get<std::string>());
    return origin;
  });
}

std::string record_text(const package::BlockFiles& files) {
  Json j = {{"block", {files.block.i, files.block.j}}, {"tiles", pair_of(files.tiles)}, {"far_map", pair_of(files.far_map)}};
  if (files.mapped) {
    j["mapped"] = Json::array();
    for (const package::CellRun& run : files.mapped->runs) j["mapped"].push_back({run.begin, run.end});
  }
  return text_of(j);
}

std::optional<package::BlockFiles> block_files_from(const std::string& text) {
  return record_from<package::BlockFiles>(text, [](const Json& j) {
    package::BlockFiles files{{j.at("block").at(0).get<std::int32_t>(), j.at("block").at(1).get<std::int32_t>()},
                              stamp_of_pair(j.at("tiles")),
                              stamp_of_pair(j.at("far_map"))};
    if (!j.contains("mapped")) return files;
    files.mapped.emplace();
    for (const Json& run : j.at("mapped"))
      files.mapped->runs.push_back({run.at(0).get<std::uint32_t>(), run.at(1).get<std::uint32_t>()});
    return files;
  });
}

}  // namespace farlod
