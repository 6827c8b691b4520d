// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <istream>
#include <nlohmann/json.hpp>

#include "ingest/files/file_format.hpp"

namespace farlod::ingest {
namespace {

using nlohmann::json;

/// Parses until the kind of the outermost object is known: by its member "type", or by a member that only one format has.
class KindFinder : public nlohmann::json_sax<json> {
 public:
  bool string(string_t& value) override {
    if (depth_ == 1 && is_type_) decide(value.starts_with("CityJSON"));
    return goes_on();
  }
  bool key(string_t& name) override {
    is_type_ = name == "type";
    if (depth_ == 1 && name == "CityObjects") decide(true);
    if (depth_ == 1 && name == "features") decide(false);
    return goes_on();
  }
  bool start_object(std::size_t) override { return ++depth_ > 0; }
  bool end_object() override { return --depth_ > 0; }
  bool start_array(std::size_t) override { return ++depth_ > 1; }  // a city is no list
  bool end_array() override { return --depth_ > 0; }
  bool null() override { return goes_on(); }
  bool boolean(bool) override { return goes_on(); }
  bool number_integer(number_integer_t) override { return goes_on(); }
  bool number_unsigned(number_unsigned_t) override { return goes_on(); }
  bool number_float(number_float_t, const string_t&) override { return goes_on(); }
  bool binary(binary_t&) override { return goes_on(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  bool is_cityjson = false;

 private:
  bool goes_on() const { return depth_ > 0 && !is_decided_; }
  void decide(bool cityjson) {
    is_decided_ = true;
    is_cityjson = cityjson;
  }

  int depth_ = 0;
  bool is_type_ = false, is_decided_ = false;
};

}  // namespace

bool is_cityjson(const InputFile& file) {
  const std::unique_ptr<std::istream> stream = open_input(file);
  KindFinder finder;
  json::sax_parse(*stream, &finder, json::input_format_t::json, false);
  return finder.is_cityjson;
}

bool is_header_of_features(const InputFile& file) {
  constexpr std::size_t most_header_bytes = std::size_t{1} << 26;
  if (lower_case(file.unpacked_name()) != "metadata.json") return false;
  const json header = json::parse(read_beginning(file, most_header_bytes), nullptr, false);
  const auto type = header.find("type"), objects = header.find("CityObjects");
  return type != header.end() && *type == "CityJSON" && (objects == header.end() || objects->empty());
}

}  // namespace farlod::ingest
