// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "package/sources_layout.hpp"

namespace farlod::package {
namespace {

/// What stands behind the beginning that an id shares with the one before it.
enum class IdRest : std::uint8_t { text, lower_uuid, upper_uuid, uuid_and_text };

// A UUID as text: 8-4-4-4-12 digits. It has 16 bytes, and no compression finds fewer
constexpr std::size_t uuid_text = 36, uuid_bytes = 16;
constexpr std::string_view lower_digits = "0123456789abcdef", upper_digits = "0123456789ABCDEF";

constexpr bool is_dash_place(std::size_t n) { return n == 8 || n == 13 || n == 18 || n == 23; }

/// The bytes of a UUID of such digits, if the text begins with one.
std::optional<std::array<std::uint8_t, uuid_bytes>> uuid_from(std::string_view text, std::string_view digits) {
  if (text.size() < uuid_text) return std::nullopt;
  std::array<std::uint8_t, uuid_bytes> bytes{};
  std::size_t digit = 0;
  for (std::size_t n = 0; n < uuid_text; ++n) {
    if (is_dash_place(n)) {
      if (text[n] != '-') return std::nullopt;
      continue;
    }
    const std::size_t value = digits.find(text[n]);
    if (value == digits.npos) return std::nullopt;
    bytes[digit / 2] = static_cast<std::uint8_t>((bytes[digit / 2] << 4U) | value);
    ++digit;
  }
  return bytes;
}

std::string text_of(std::span<const std::uint8_t> uuid, std::string_view digits) {
  std::string text;
  for (const std::uint8_t byte : uuid) {
    if (is_dash_place(text.size())) text += '-';
    text += digits[byte >> 4U];
    text += digits[byte & 0xFU];
  }
  return text;
}

/// An id cut at its first UUID.
struct CutId {
  std::string_view before, behind;
  std::array<std::uint8_t, uuid_bytes> uuid{};
  bool has_uuid = false, is_upper = false;
};

CutId cut(std::string_view id) {
  CutId parts{id, {}, {}};
  for (std::size_t at = 0; at + uuid_text <= id.size(); ++at)
    for (const bool is_upper : {false, true})
      if (const auto uuid = uuid_from(id.substr(at), is_upper ? upper_digits : lower_digits))
        return {id.substr(0, at), id.substr(at + uuid_text), *uuid, true, is_upper};
  return parts;
}

IdRest rest_of(const CutId& id) {
  if (!id.has_uuid) return IdRest::text;
  if (!id.behind.empty()) return IdRest::uuid_and_text;
  return id.is_upper ? IdRest::upper_uuid : IdRest::lower_uuid;
}

template <class Bytes>
void append(std::vector<std::uint8_t>& bytes, const Bytes& added) {
  bytes.insert(bytes.end(), added.begin(), added.end());
}

void append_text(std::vector<std::uint8_t>& bytes, std::string_view text) {
  append_number(bytes, text.size());
  append(bytes, text);
}

/// A byte 0 stands for the id of the building.
std::string with_mark(const SurfaceIds& surfaces) {
  return surfaces.behind_building_id ? std::string(1, '\0') + surfaces.id : surfaces.id;
}
SurfaceIds without_mark(std::uint32_t begin, std::uint32_t end, const std::string& marked) {
  const bool is_marked = marked.front() == '\0';
  return {begin, end, marked.substr(is_marked ? 1 : 0), is_marked};
}

// The flags of an id, in the lowest bits of its code
constexpr std::uint64_t is_behind_a_gap = 1, is_of_several = 2;
constexpr unsigned flag_bits = 2, rest_bits = 2;

/// The text of an id whose code has been read. Beyond the end, the cursor has failed.
std::string id_from(SourcesCursor& cursor, std::string_view before, std::uint64_t code) {
  const std::uint64_t shared = code >> rest_bits;
  if (shared > before.size()) return {};
  const auto rest = static_cast<IdRest>(code & 3U);
  std::string id(before.substr(0, static_cast<std::size_t>(shared)));
  id += cursor.text();
  if (rest == IdRest::text) return id;
  const bool is_upper = rest == IdRest::upper_uuid || (rest == IdRest::uuid_and_text && cursor.number() == 1);
  id += text_of(cursor.take(uuid_bytes), is_upper ? upper_digits : lower_digits);
  return rest == IdRest::uuid_and_text ? id + cursor.text() : id;
}

}  // namespace

void append_ids(std::vector<std::uint8_t>& bytes, const std::vector<SurfaceIds>& ids) {
  append_number(bytes, ids.size());
  std::string before;
  std::uint32_t expected = 0;
  for (const SurfaceIds& surfaces : ids) {
    std::string marked = with_mark(surfaces);
    const CutId id = cut(marked);
    const auto shared = static_cast<std::size_t>(
        std::mismatch(id.before.begin(), id.before.end(), before.begin(), before.end()).first - id.before.begin());
    const bool has_gap = surfaces.begin != expected, are_several = surfaces.end - surfaces.begin > 1;
    const IdRest rest = rest_of(id);
    append_number(bytes, ((std::uint64_t{shared} << rest_bits | static_cast<std::uint64_t>(rest)) << flag_bits) |
                             (has_gap ? is_behind_a_gap : 0U) | (are_several ? is_of_several : 0U));
    if (has_gap) append_number(bytes, surfaces.begin - expected);
    if (are_several) append_number(bytes, surfaces.end - surfaces.begin);
    append_text(bytes, id.before.substr(shared));
    if (rest == IdRest::uuid_and_text) append_number(bytes, id.is_upper ? 1U : 0U);
    if (id.has_uuid) append(bytes, id.uuid);
    if (rest == IdRest::uuid_and_text) append_text(bytes, id.behind);
    before = std::move(marked);
    expected = surfaces.end;
  }
}

bool read_ids(SourcesCursor& cursor, std::vector<SurfaceIds>& ids) {
  const std::size_t count = cursor.count();
  std::string before;
  std::uint64_t expected = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint64_t code = cursor.number();
    const std::uint64_t begin = expected + ((code & is_behind_a_gap) != 0 ? cursor.number32() : 0);
    const std::uint64_t end = begin + ((code & is_of_several) != 0 ? cursor.number32() : 1);
    std::string id = id_from(cursor, before, code >> flag_bits);
    if (cursor.failed() || end <= begin || end > std::numeric_limits<std::uint32_t>::max() || id.empty() ||
        id.size() > most_id_bytes)
      return false;
    ids.push_back(without_mark(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), id));
    before = std::move(id);
    expected = end;
  }
  return count > 0;
}

}  // namespace farlod::package
