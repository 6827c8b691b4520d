// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <expat.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "results/city/xml_text.hpp"

namespace farlod {
namespace {

/// Expat puts it between a namespace and a name. It cannot occur in either.
constexpr char name_separator = '\n';
constexpr std::string_view gml_space = "http://www.opengis.net/gml", xml_space = " \t\r\n";
constexpr std::size_t piece_bytes = std::size_t{1} << 20, deepest_element = 256;
/// Expat scans a tag or a comment again with each piece.
constexpr std::int64_t most_bytes_of_tag = std::int64_t{1} << 22;

/// The user data of Expat's callbacks.
struct TextParsing {
  XML_Parser parser;
  XmlTextReader& reader;
  std::string_view skipped;  ///< the beginning of the text, which Expat does not see
  std::size_t depth = 0;
  std::string refusal = {};           ///< why the text is not read on
  std::exception_ptr exception = {};  ///< of the reader: it must not pass through a library written in C

  /// One past the last byte of the current event.
  [[nodiscard]] std::size_t end_of_event() const {
    return skipped.size() + static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser)) +
           static_cast<std::size_t>(XML_GetCurrentByteCount64(parser));
  }
};

void refuse(TextParsing& parsing, std::string why) {
  if (parsing.refusal.empty()) parsing.refusal = std::move(why);
  XML_StopParser(parsing.parser, XML_FALSE);
}

template <class Call>
void tell(void* user, const Call& call) {
  TextParsing& parsing = *static_cast<TextParsing*>(user);
  // Expat may call back once more after it was stopped
  if (parsing.exception || !parsing.refusal.empty()) return;
  try {
    call(parsing);
  } catch (...) {
    parsing.exception = std::current_exception();
    XML_StopParser(parsing.parser, XML_FALSE);
  }
}

std::string_view text_or_nothing(const XML_Char* text) { return text == nullptr ? std::string_view() : std::string_view(text); }

XmlTag tag_of(const XML_Char* qualified, const XML_Char** attributes) {
  const std::string_view whole = qualified;
  const std::size_t cut = whole.rfind(name_separator);
  XmlTag tag;
  tag.space = cut == whole.npos ? std::string_view() : whole.substr(0, cut);
  tag.name = cut == whole.npos ? whole : whole.substr(cut + 1);
  for (; *attributes != nullptr; attributes += 2) {
    const std::string_view attribute = attributes[0];
    const std::size_t at = attribute.rfind(name_separator);
    const std::string_view name = at == attribute.npos ? attribute : attribute.substr(at + 1);
    if (name == "id" && attribute.starts_with(gml_space)) tag.id = attributes[1];
    if (name == "href") tag.href = attributes[1];
    if (name == "srsName") tag.srs_name = attributes[1];
    if (name == "srsDimension") tag.srs_dimension = attributes[1];
    if (name == "name") tag.attribute_name = attributes[1];
  }
  return tag;
}

void XMLCALL on_bind(void* user, const XML_Char* prefix, const XML_Char* space) {
  tell(user, [&](TextParsing& parsing) { parsing.reader.bind(text_or_nothing(prefix), text_or_nothing(space)); });
}

void XMLCALL on_unbind(void* user, const XML_Char*) {
  tell(user, [](TextParsing& parsing) { parsing.reader.unbind(); });
}

void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char** attributes) {
  tell(user, [&](TextParsing& parsing) {
    if (++parsing.depth > deepest_element)
      return refuse(parsing, "its elements are nested deeper than " + std::to_string(deepest_element));
    XmlTag tag = tag_of(name, attributes);
    tag.end = parsing.end_of_event();
    parsing.reader.start(tag);
  });
}

void XMLCALL on_end(void* user, const XML_Char*) {
  tell(user, [](TextParsing& parsing) {
    --parsing.depth;
    parsing.reader.end(parsing.end_of_event());
  });
}

void XMLCALL on_text(void* user, const XML_Char* text, int length) {
  tell(user, [&](TextParsing& parsing) { parsing.reader.text({text, static_cast<std::size_t>(length)}); });
}

void XMLCALL on_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int has_internal_subset) {
  if (has_internal_subset != 0) refuse(*static_cast<TextParsing*>(user), "it has declarations in its DOCTYPE");
}

void XMLCALL on_skipped_entity(void* user, const XML_Char* name, int) {
  refuse(*static_cast<TextParsing*>(user), "it uses the entity &" + std::string(name).substr(0, 64) + ";");
}

/// The character of a byte, in UTF-32; empty where the encoding has none.
std::optional<int> character_of(iconv_t converter, int byte) {
  char in = static_cast<char>(byte);
  std::array<unsigned char, 4> code_point{};
  char *from = &in, *to = reinterpret_cast<char*>(code_point.data());
  std::size_t from_left = 1, to_left = code_point.size();
  iconv(converter, nullptr, nullptr, nullptr, nullptr);
  if (iconv(converter, &from, &from_left, &to, &to_left) == static_cast<std::size_t>(-1) || to_left != 0) return std::nullopt;
  return code_point[0] | code_point[1] << 8 | code_point[2] << 16;
}

/// Of encodings that Expat does not know, those of one byte a character are read that begin with ASCII, in which attributes are
/// written.
int XMLCALL on_unknown_encoding(void*, const XML_Char* name, XML_Encoding* encoding) {
  const iconv_t converter = iconv_open("UTF-32LE", name);
  // POSIX says so. NOLINTNEXTLINE(performance-no-int-to-ptr)
  if (converter == reinterpret_cast<iconv_t>(-1)) return XML_STATUS_ERROR;
  bool begins_with_ascii = true;
  for (int byte = 0; byte < 256; ++byte) {
    encoding->map[byte] = character_of(converter, byte).value_or(-1);
    begins_with_ascii = begins_with_ascii && (byte >= 128 || encoding->map[byte] == byte);
  }
  iconv_close(converter);
  return begins_with_ascii ? XML_STATUS_OK : XML_STATUS_ERROR;
}

using OwnedParser = std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)>;

[[noreturn]] void throw_failure(const TextParsing& parsing) {
  if (parsing.exception) std::rethrow_exception(parsing.exception);
  const XML_Error error = XML_GetErrorCode(parsing.parser);
  if (error == XML_ERROR_UNKNOWN_ENCODING)
    throw XmlTextError("its encoding is neither UTF-8 nor one of one byte a character; convert it to UTF-8 and pack it again");
  const auto line =
      static_cast<std::size_t>(std::ranges::count(parsing.skipped, '\n')) + XML_GetCurrentLineNumber64(parsing.parser);
  throw XmlTextError((parsing.refusal.empty() ? XML_ErrorString(error) : parsing.refusal) + " at line " + std::to_string(line));
}

void set_handlers(TextParsing& parsing) {
  XML_SetUserData(parsing.parser, &parsing);
  XML_SetNamespaceDeclHandler(parsing.parser, on_bind, on_unbind);
  XML_SetElementHandler(parsing.parser, on_start, on_end);
  XML_SetCharacterDataHandler(parsing.parser, on_text);
  XML_SetStartDoctypeDeclHandler(parsing.parser, on_doctype);
  XML_SetSkippedEntityHandler(parsing.parser, on_skipped_entity);
  XML_SetUnknownEncodingHandler(parsing.parser, on_unknown_encoding, nullptr);
}

}  // namespace

void read_xml_text(std::string_view text, XmlTextReader& reader) {
  const OwnedParser parser(XML_ParserCreateNS(nullptr, name_separator), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  // An XML declaration must come first, and some exports begin with blank lines
  const std::size_t begin = std::min(text.find_first_not_of(xml_space), text.size());
  TextParsing parsing{.parser = parser.get(), .reader = reader, .skipped = text.substr(0, begin)};
  set_handlers(parsing);
  for (std::size_t at = begin; at == begin || at < text.size();) {
    const std::string_view piece = text.substr(at, piece_bytes);
    at += piece.size();
    const bool is_last = at >= text.size();
    if (XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0) != XML_STATUS_OK)
      throw_failure(parsing);
    // The bytes that were read and not parsed yet belong to a tag that has not ended
    if (static_cast<std::int64_t>(at - begin) - XML_GetCurrentByteIndex64(parser.get()) > most_bytes_of_tag) {
      parsing.refusal = "it has a tag or a comment of more than " + std::to_string(most_bytes_of_tag) + " bytes";
      throw_failure(parsing);
    }
    if (is_last) break;
  }
}

}  // namespace farlod
