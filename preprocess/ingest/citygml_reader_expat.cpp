// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <expat.h>
#include <iconv.h>

#include <array>
#include <cstring>
#include <fstream>
#include <memory>

#include "city/input_error.hpp"
#include "ingest/citygml_parser.hpp"
#include "ingest/citygml_reader.hpp"

namespace farlod {
namespace {

/// Between a namespace and a name, in what Expat hands out: it cannot occur in either.
constexpr char name_separator = '\n';
constexpr std::string_view gml_space = "http://www.opengis.net/gml";
constexpr std::size_t piece_bytes = std::size_t{1} << 16;

struct QualifiedName {
  std::string_view space, name;
};

QualifiedName split(std::string_view text) {
  const std::size_t at = text.rfind(name_separator);
  return at == text.npos ? QualifiedName{{}, text} : QualifiedName{text.substr(0, at), text.substr(at + 1)};
}

void XMLCALL on_start(void* listener, const XML_Char* name, const XML_Char** attributes) {
  const QualifiedName element_name = split(name);
  XmlElement element{.space = element_name.space,
                     .name = element_name.name,
                     .id = {},
                     .href = {},
                     .srs_name = {},
                     .srs_dimension = {},
                     .orientation = {}};
  for (; *attributes != nullptr; attributes += 2) {
    const QualifiedName attribute = split(attributes[0]);
    if (attribute.name == "id" && attribute.space.starts_with(gml_space))
      element.id = attributes[1];
    else if (attribute.name == "href")
      element.href = attributes[1];
    else if (attribute.name == "srsName")
      element.srs_name = attributes[1];
    else if (attribute.name == "srsDimension")
      element.srs_dimension = attributes[1];
    else if (attribute.name == "orientation")
      element.orientation = attributes[1];
  }
  static_cast<XmlListener*>(listener)->start(element);
}

void XMLCALL on_end(void* listener, const XML_Char* name) { static_cast<XmlListener*>(listener)->end(split(name).name); }

void XMLCALL on_text(void* listener, const XML_Char* text, int length) {
  static_cast<XmlListener*>(listener)->text({text, static_cast<std::size_t>(length)});
}

/// Expat knows UTF-8, UTF-16 and Latin-1; iconv tells what the bytes of any other one-byte encoding mean.
int XMLCALL on_unknown_encoding(void*, const XML_Char* name, XML_Encoding* encoding) {
  const iconv_t converter = iconv_open("UTF-32LE", name);
  if (converter == reinterpret_cast<iconv_t>(-1)) return XML_STATUS_ERROR;
  for (int byte = 0; byte < 256; ++byte) {
    char in = static_cast<char>(byte);
    std::array<unsigned char, 4> code_point{};
    char *from = &in, *to = reinterpret_cast<char*>(code_point.data());
    std::size_t from_left = 1, to_left = code_point.size();
    const bool is_known = iconv(converter, &from, &from_left, &to, &to_left) != static_cast<std::size_t>(-1) && to_left == 0;
    encoding->map[byte] = is_known ? code_point[0] | code_point[1] << 8 | code_point[2] << 16 : -1;
    iconv(converter, nullptr, nullptr, nullptr, nullptr);
  }
  iconv_close(converter);
  return XML_STATUS_OK;
}

[[noreturn]] void throw_not_well_formed(const std::filesystem::path& file, XML_Parser parser) {
  throw InputError(file.string() + " is not well-formed XML: line " + std::to_string(XML_GetCurrentLineNumber(parser)) +
                   ", column " + std::to_string(XML_GetCurrentColumnNumber(parser) + 1) + ": " +
                   XML_ErrorString(XML_GetErrorCode(parser)) + ". Was it cut short? An XML checker (xmllint) shows the place.");
}

/// Passes the whole file by a listener, piece by piece.
void parse(const std::filesystem::path& file, XmlListener& listener) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreateNS(nullptr, name_separator),
                                                                            &XML_ParserFree);
  XML_SetUserData(parser.get(), &listener);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetUnknownEncodingHandler(parser.get(), on_unknown_encoding, nullptr);
  std::ifstream stream(file, std::ios::binary);
  for (bool is_last = false; !is_last;) {
    void* buffer = XML_GetBuffer(parser.get(), static_cast<int>(piece_bytes));
    if (buffer == nullptr) throw std::bad_alloc();
    stream.read(static_cast<char*>(buffer), static_cast<std::streamsize>(piece_bytes));
    is_last = !stream;
    if (XML_ParseBuffer(parser.get(), static_cast<int>(stream.gcount()), is_last) != XML_STATUS_OK)
      throw_not_well_formed(file, parser.get());
  }
}

struct Reading {
  SourceCity city;
  Report report;
  std::unordered_set<std::string> foreign_hrefs;
};

Reading read_buildings(const std::filesystem::path& file, LodChoice lod, const GmlSurfaces& foreign) {
  Reading reading;
  CityWriter writer(file.string(), reading.report);
  CityGmlParser parser([&](const CityGmlBuilding& building) {
    for (std::string& href : foreign_references(building)) reading.foreign_hrefs.insert(std::move(href));
    write_building(building, foreign, lod, writer);
  });
  parse(file, parser);
  if (writer.buildings_met() == 0)
    throw InputError(file.string() + (parser.root() == "CityModel"
                                          ? " holds no Building and no Bridge. Is it another theme of the city model?"
                                          : " is XML, but not CityGML: it begins with <" + parser.root() + ">."));
  reading.city = {file.string(), {parser.srs_name(), false, false}, writer.take_city()};
  return reading;
}

/// Surfaces found under foreign ids may refer on; the search goes on until it learns nothing new.
GmlSurfaces find_surfaces(const std::filesystem::path& file, std::unordered_set<std::string> hrefs) {
  while (true) {
    GmlSurfaceFinder finder(hrefs);
    parse(file, finder);
    const std::size_t known = hrefs.size();
    for (const GmlMember& member : finder.found().members)
      if (!member.polygon) hrefs.insert(member.href);
    if (hrefs.size() == known) return finder.found();
  }
}

}  // namespace

SourceCity read_citygml(const std::filesystem::path& file, LodChoice lod, Report& report) {
  Reading reading = read_buildings(file, lod, {});
  if (!reading.foreign_hrefs.empty()) reading = read_buildings(file, lod, find_surfaces(file, reading.foreign_hrefs));
  for (const Problem& problem : reading.report.problems()) report.add(problem);
  return std::move(reading.city);
}

}  // namespace farlod
