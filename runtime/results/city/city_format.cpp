// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/city_format.hpp"

#include <array>
#include <fstream>
#include <string_view>
#include <utility>

#include "contract/lower_case.hpp"
#include "farlod/error.hpp"
#include "results/city/citygml_city.hpp"
#include "results/city/cityjson_city.hpp"
#include "results/city/xml_text.hpp"

namespace farlod {
namespace {

struct CityEnding {
  std::string_view ending;
  EnrichedFormat format;
};

constexpr std::array<CityEnding, 6> city_endings{{{".city.json", EnrichedFormat::cityjson},
                                                  {".city.jsonl", EnrichedFormat::cityjsonseq},
                                                  {".jsonl", EnrichedFormat::cityjsonseq},
                                                  {".gml", EnrichedFormat::citygml},
                                                  {".xml", EnrichedFormat::citygml},
                                                  {".citygml", EnrichedFormat::citygml}}};

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  file.seekg(0, std::ios::end);
  if (const auto size = file.tellg(); size > 0) text.resize(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) throw InputError(path.string() + " cannot be read");
  return text;
}

/// Whether the text has two bytes a character. All positions would have to be counted otherwise.
bool is_utf16(std::string_view text) {
  using namespace std::string_view_literals;
  for (const std::string_view begin : {"\xff\xfe"sv, "\xfe\xff"sv, "<\0"sv, "\0<"sv, "{\0"sv, "\0{"sv})
    if (text.starts_with(begin)) return true;
  return false;
}

bool begins_with(std::string_view text, char first) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return at != text.npos && text[at] == first;
}

ReadCity city_in(std::string text) {
  if (begins_with(text, '<')) return {EnrichedFormat::citygml, std::make_unique<CityGmlCity>(std::move(text))};
  auto city = std::make_unique<CityJsonCity>(std::move(text));
  const EnrichedFormat format = city->is_sequence() ? EnrichedFormat::cityjsonseq : EnrichedFormat::cityjson;
  return {format, std::move(city)};
}

}  // namespace

std::string name_of(EnrichedFormat format) {
  if (format == EnrichedFormat::cityjsonseq) return "CityJSONSeq";
  return format == EnrichedFormat::cityjson ? "CityJSON" : "CityGML";
}

std::optional<EnrichedFormat> city_format_of(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  for (const auto& [ending, format] : city_endings)
    if (name.size() > ending.size() && name.ends_with(ending)) return format;
  return std::nullopt;
}

std::string endings_of(EnrichedFormat format) {
  std::string list, last;
  for (const auto& [ending, of_format] : city_endings) {
    if (of_format != format) continue;
    if (!last.empty()) list += (list.empty() ? "" : ", ") + last;
    last = ending;
  }
  return list.empty() ? last : list + " or " + last;
}

ReadCity read_city(const std::filesystem::path& path) {
  std::string text = text_of_file(path);
  if (is_utf16(text)) throw InputError(path.string() + " is UTF-16: convert it to UTF-8 and pack it again");
  ReadCity city;
  telling_file(path, [&] { city = city_in(std::move(text)); });
  return city;
}

void telling_file(const std::filesystem::path& path, const std::function<void()>& work) {
  try {
    work();
  } catch (const JsonCursorError& flaw) {
    throw InputError(path.string() + " cannot be enriched as CityJSON: " + flaw.what());
  } catch (const XmlTextError& flaw) {
    throw InputError(path.string() + " cannot be enriched as CityGML: " + flaw.what());
  }
}

}  // namespace farlod
