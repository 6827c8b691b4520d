// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <expat.h>
#include <iconv.h>

#include <exception>
#include <new>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_xml.hpp"

namespace farlod::ingest {
namespace {

/// Expat puts it between a namespace and a name. It cannot occur in either.
constexpr char name_separator = '\n';
constexpr std::string_view gml_space = "http://www.opengis.net/gml";
constexpr std::size_t parsed_piece_bytes = std::size_t{1} << 16;
/// Known cities are nested up to 14 levels deep.
constexpr std::size_t deepest_element = 256;
/// Expat keeps a tag or a comment in memory as a whole, and scans it again with each piece.
constexpr std::size_t most_bytes_of_tag = std::size_t{1} << 22;

/// The user data of Expat's callbacks.
struct Parsing {
  XML_Parser parser;
  XmlListener& listener;
  std::uint64_t shift = 0;  ///< from what Expat counts to places in the file; it may wrap
  std::size_t depth = 0;
  bool ended_element = false;         ///< the last event was the end of an element
  std::string refusal = {};           ///< why the file is not read on
  std::exception_ptr exception = {};  ///< of the listener: it must not pass through a library written in C

  [[nodiscard]] std::uint64_t end_of_event() const {
    return shift + static_cast<std::uint64_t>(XML_GetCurrentByteIndex64(parser)) +
           static_cast<std::uint64_t>(XML_GetCurrentByteCount64(parser));
  }
};

void refuse(Parsing& parsing, std::string why) {
  if (parsing.refusal.empty()) parsing.refusal = std::move(why);
  XML_StopParser(parsing.parser, XML_FALSE);
}

template <class Call>
void tell(Parsing& parsing, const Call& call) {
  // Expat may call back once more after it was stopped
  if (parsing.exception || !parsing.refusal.empty()) return;
  try {
    call(parsing.listener);
  } catch (...) {
    parsing.exception = std::current_exception();
    XML_StopParser(parsing.parser, XML_FALSE);
  }
}

struct QualifiedName {
  std::string_view space, name;
};

QualifiedName split(std::string_view text) {
  const std::size_t at = text.rfind(name_separator);
  return at == text.npos ? QualifiedName{{}, text} : QualifiedName{text.substr(0, at), text.substr(at + 1)};
}

XmlElement element_of(const XML_Char* name, const XML_Char** attributes) {
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
  return element;
}

void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char** attributes) {
  Parsing& parsing = *static_cast<Parsing*>(user);
  parsing.ended_element = false;
  if (++parsing.depth > deepest_element)
    return refuse(parsing, "its elements are nested deeper than " + std::to_string(deepest_element) + ", as in no city model");
  tell(parsing, [&](XmlListener& listener) {
    XmlElement element = element_of(name, attributes);
    element.end = parsing.end_of_event();
    listener.start(element);
  });
}

void XMLCALL on_end(void* user, const XML_Char* name) {
  Parsing& parsing = *static_cast<Parsing*>(user);
  --parsing.depth;
  parsing.ended_element = true;
  tell(parsing, [&](XmlListener& listener) { listener.end(split(name).name, parsing.end_of_event()); });
}

std::string_view text_or_nothing(const XML_Char* text) { return text == nullptr ? std::string_view() : std::string_view(text); }

void XMLCALL on_bind(void* user, const XML_Char* prefix, const XML_Char* space) {
  tell(*static_cast<Parsing*>(user),
       [&](XmlListener& listener) { listener.bind(text_or_nothing(prefix), text_or_nothing(space)); });
}

void XMLCALL on_unbind(void* user, const XML_Char*) {
  tell(*static_cast<Parsing*>(user), [](XmlListener& listener) { listener.unbind(); });
}

void XMLCALL on_text(void* user, const XML_Char* text, int length) {
  Parsing& parsing = *static_cast<Parsing*>(user);
  parsing.ended_element = false;
  tell(parsing, [&](XmlListener& listener) { listener.text({text, static_cast<std::size_t>(length)}); });
}

/// Entities and default attributes may expand to more than the memory holds. External entities refer to other files.
constexpr const char* has_declarations =
    "it declares entities, or has other declarations in its DOCTYPE: CityGML has no use for them, and they can make a small "
    "file endless; delete the <!DOCTYPE ...>";

void XMLCALL on_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int has_internal_subset) {
  if (has_internal_subset != 0) refuse(*static_cast<Parsing*>(user), has_declarations);
}

void XMLCALL on_skipped_entity(void* user, const XML_Char* name, int) {
  refuse(*static_cast<Parsing*>(user),
         "it uses the entity &" + std::string(name).substr(0, 64) + "; which another file declares; entities are not read");
}

/// Expat knows UTF-8, UTF-16 and Latin-1. For any other one-byte encoding, iconv gives the character of each byte.
int XMLCALL on_unknown_encoding(void*, const XML_Char* name, XML_Encoding* encoding) {
  const iconv_t converter = iconv_open("UTF-32LE", name);
  // POSIX says so. NOLINTNEXTLINE(performance-no-int-to-ptr)
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

std::string place_of(XML_Parser parser) {
  return "line " + std::to_string(XML_GetCurrentLineNumber64(parser)) + ", column " +
         std::to_string(XML_GetCurrentColumnNumber64(parser) + 1);
}

[[noreturn]] void throw_failure(const InputFile& file, const Parsing& parsing) {
  if (parsing.exception) std::rethrow_exception(parsing.exception);
  if (!parsing.refusal.empty())
    throw InputError(file.name + " is not read: " + parsing.refusal + " (" + place_of(parsing.parser) + ").");
  throw InputError(file.name + " is not well-formed XML: " + place_of(parsing.parser) + ": " +
                   XML_ErrorString(XML_GetErrorCode(parsing.parser)) +
                   ". Was it cut short? An XML checker (xmllint) shows the place.");
}

using OwnedParser = std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)>;

OwnedParser make_parser() {
  OwnedParser parser(XML_ParserCreateNS(nullptr, name_separator), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  return parser;
}

void set_handlers(Parsing& parsing) {
  XML_Parser parser = parsing.parser;
  XML_SetUserData(parser, &parsing);
  XML_SetNamespaceDeclHandler(parser, on_bind, on_unbind);
  XML_SetElementHandler(parser, on_start, on_end);
  XML_SetCharacterDataHandler(parser, on_text);
  XML_SetStartDoctypeDeclHandler(parser, on_doctype);
  XML_SetSkippedEntityHandler(parser, on_skipped_entity);
  XML_SetUnknownEncodingHandler(parser, on_unknown_encoding, nullptr);
}

bool parse_text(XML_Parser parser, std::string_view text, bool is_last) {
  return XML_Parse(parser, text.data(), static_cast<int>(text.size()), is_last ? 1 : 0) == XML_STATUS_OK;
}

/// Remembers the root, and asks for no more.
struct RootSearch {
  XML_Parser parser;
  std::optional<XmlRoot> root = {};
};

void XMLCALL on_root(void* user, const XML_Char* name, const XML_Char**) {
  RootSearch& search = *static_cast<RootSearch*>(user);
  if (search.root) return;
  const std::size_t end = static_cast<std::size_t>(XML_GetCurrentByteIndex64(search.parser)) +
                          static_cast<std::size_t>(XML_GetCurrentByteCount64(search.parser));
  search.root = {std::string(split(name).name), end};
  XML_StopParser(search.parser, XML_FALSE);
}

}  // namespace

std::optional<XmlRoot> find_root(std::string_view beginning) {
  const OwnedParser parser = make_parser();
  RootSearch search{parser.get()};
  XML_SetUserData(parser.get(), &search);
  XML_SetStartElementHandler(parser.get(), on_root);
  XML_SetUnknownEncodingHandler(parser.get(), on_unknown_encoding, nullptr);
  (void)parse_text(parser.get(), beginning, false);
  return search.root;
}

bool parse_xml_segment(const XmlSegment& segment, XmlListener& listener) {
  FARLOD_EXPECTS(segment.text.size() <= most_bytes_of_tag);
  const OwnedParser parser = make_parser();
  Parsing parsing{.parser = parser.get(), .listener = listener, .shift = segment.begin - segment.head.size()};
  set_handlers(parsing);
  const bool is_well_formed =
      parse_text(parser.get(), segment.head, false) && parse_text(parser.get(), segment.text, segment.is_last);
  if (parsing.exception) std::rethrow_exception(parsing.exception);
  if (!is_well_formed || segment.is_last) return is_well_formed;
  // A comment and the like would not be parsed to its end yet; a CDATA section would have given text
  const auto size = static_cast<std::int64_t>(segment.head.size() + segment.text.size());
  return parsing.depth == 1 && parsing.ended_element && XML_GetCurrentByteIndex64(parser.get()) == size;
}

void parse_xml(const InputFile& file, XmlListener& listener, const std::stop_token& stop) {
  const OwnedParser parser = make_parser();
  Parsing parsing{.parser = parser.get(), .listener = listener};
  set_handlers(parsing);
  const std::unique_ptr<std::istream> stream = open_input(file);
  *stream >> std::ws;  // an XML declaration must come first, and some exports begin with blank lines
  // A packed file cannot tell, and nobody asks
  if (const std::streamoff begin = stream->tellg(); begin > 0) parsing.shift = static_cast<std::uint64_t>(begin);
  std::int64_t bytes_read = 0;
  for (bool is_last = false; !is_last;) {
    throw_if_cancelled(stop);
    void* buffer = XML_GetBuffer(parser.get(), static_cast<int>(parsed_piece_bytes));
    if (buffer == nullptr) throw std::bad_alloc();
    stream->read(static_cast<char*>(buffer), static_cast<std::streamsize>(parsed_piece_bytes));
    is_last = !*stream;
    bytes_read += static_cast<std::int64_t>(stream->gcount());
    if (XML_ParseBuffer(parser.get(), static_cast<int>(stream->gcount()), is_last ? 1 : 0) != XML_STATUS_OK)
      throw_failure(file, parsing);
    // The bytes that were read and not parsed yet belong to a tag that has not ended
    if (bytes_read - XML_GetCurrentByteIndex64(parser.get()) > static_cast<std::int64_t>(most_bytes_of_tag)) {
      parsing.refusal = "it has a tag or a comment of more than " + std::to_string(most_bytes_of_tag) + " bytes";
      throw_failure(file, parsing);
    }
  }
}

namespace {

/// The start tag of the root, with the namespaces of many extensions, is a few KiB long.
constexpr std::size_t most_bytes_of_head = std::size_t{1} << 16;
constexpr std::string_view member = "cityObjectMember>";

/// Whether the name that ends at `end` is that of an end tag.
bool is_end_tag(std::string_view text, std::size_t end) {
  const std::size_t before = text.substr(0, end).find_last_of("</> \t\r\n");
  return before != text.npos && before > 0 && text.substr(before - 1, 2) == "</";
}

/// One past the last end tag of a member; 0 where there is none.
std::size_t end_of_last_member(std::string_view text) {
  for (std::size_t at = text.rfind(member); at != text.npos; at = at == 0 ? text.npos : text.rfind(member, at - 1))
    if (is_end_tag(text, at)) return at + member.size();
  return 0;
}

}  // namespace

SegmentCutter::SegmentCutter(const InputFile& file, const SegmentSizes& sizes) : stream_(open_input(file)), sizes_(sizes) {
  *stream_ >> std::ws;
  if (const std::streamoff begin = stream_->tellg(); begin > 0) at_ahead_ = static_cast<std::uint64_t>(begin);
  read_up_to(most_bytes_of_head);
  const std::optional<XmlRoot> root = find_root(ahead_);
  if (!root || root->name != "CityModel") throw CannotBeCut();
  head_ = ahead_.substr(0, root->tag_end);
  ahead_.erase(0, root->tag_end);
  at_ahead_ += root->tag_end;
}

void SegmentCutter::read_up_to(std::size_t bytes) {
  if (ahead_.size() >= bytes) return;
  const std::size_t known = ahead_.size();
  ahead_.resize(bytes);
  stream_->read(ahead_.data() + known, static_cast<std::streamsize>(bytes - known));
  ahead_.resize(known + static_cast<std::size_t>(stream_->gcount()));
}

std::optional<FileSegment> SegmentCutter::next() {
  if (is_done_) return std::nullopt;
  for (std::size_t bytes = std::min(sizes_.least, sizes_.most);; bytes = std::min(2 * bytes, sizes_.most)) {
    read_up_to(bytes);
    is_done_ = !*stream_ && ahead_.size() <= bytes;
    if (is_done_) return FileSegment{std::move(ahead_), true, at_ahead_};
    if (const std::size_t end = end_of_last_member(std::string_view(ahead_).substr(0, bytes)); end > 0) {
      FileSegment segment{ahead_.substr(0, end), false, at_ahead_};
      ahead_.erase(0, end);
      at_ahead_ += end;
      return segment;
    }
    if (bytes == sizes_.most) throw CannotBeCut();
  }
}

}  // namespace farlod::ingest
