// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/building_origin.hpp"

/// The bytes of `sources.bin`: where in the city files of a package its surfaces come from. docs/package_format.md tells the same
/// in words.
namespace farlod::package {

/// The versions of `sources.bin`, which change on their own: 2 where surfaces have ids.
inline constexpr std::uint32_t sources_version = 1, sources_version_with_ids = 2;
inline constexpr std::array<char, 8> sources_magic{'F', 'A', 'R', 'L', 'O', 'D', 'S', '\n'};
inline constexpr const char* sources_file = "sources.bin";  ///< in the folder of the package

struct SourcesHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t file_count;      ///< city files that have places
  std::uint64_t building_count;  ///< that of the manifest
  std::uint64_t file_bytes;
  std::array<std::uint8_t, 32> reserved;  ///< zero
};
static_assert(sizeof(SourcesHeader) == 64);

// What the bytes say, as users of the library see it
using farlod::AttributeForm;
using farlod::AttributePlace;
using farlod::BuildingOrigin;
using farlod::CityFileFormat;
using farlod::SurfaceIds;
using farlod::SurfaceOrigin;

/// A whole number in bytes of seven bits, the lowest first; all but the last have bit 7 set.
inline void append_number(std::vector<std::uint8_t>& bytes, std::uint64_t number) {
  for (; number >= 0x80U; number >>= 7U) bytes.push_back(static_cast<std::uint8_t>(number | 0x80U));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

/// 0, −1, 1, −2 ... become 0, 1, 2, 3 ...; what is beyond 64 bits wraps, and comes back.
[[nodiscard]] constexpr std::uint64_t unsigned_of(std::uint64_t difference) {
  return (difference << 1U) ^ (0U - (difference >> 63U));
}
[[nodiscard]] constexpr std::uint64_t difference_of(std::uint64_t number) { return (number >> 1U) ^ (0U - (number & 1U)); }

/// Reads numbers and texts one after the other. Beyond the end, and for a number of more than 64 bits, it gives 0 and has failed.
class SourcesCursor {
 public:
  explicit SourcesCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t number() {
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < 64 && !bytes_.empty(); shift += 7) {
      const std::uint8_t byte = bytes_.front();
      bytes_ = bytes_.subspan(1);
      if (shift == 63 && byte > 1) break;
      number |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80U) return number;
    }
    return fail();
  }
  [[nodiscard]] std::uint32_t number32() {
    const std::uint64_t wide = number();
    return static_cast<std::uint32_t>(wide <= std::numeric_limits<std::uint32_t>::max() ? wide : fail());
  }
  /// A number of elements that have at least a byte each.
  [[nodiscard]] std::size_t count() {
    const std::uint64_t count = number();
    return count <= bytes_.size() ? static_cast<std::size_t>(count) : static_cast<std::size_t>(fail());
  }
  [[nodiscard]] std::span<const std::uint8_t> take(std::size_t size) {
    if (size > bytes_.size()) return (void)fail(), std::span<const std::uint8_t>();
    const auto taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  [[nodiscard]] std::string text() {
    const auto taken = take(count());
    return {taken.begin(), taken.end()};
  }
  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  std::uint64_t fail() {
    failed_ = true;
    bytes_ = {};
    return 0;
  }

  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
};

namespace origin_coding {

inline void append_places(std::vector<std::uint8_t>& bytes, const std::vector<AttributePlace>& places, AttributePlace& before) {
  for (const AttributePlace& place : places) {
    const bool is_new_form = place.form != before.form;
    append_number(bytes, 2 * unsigned_of(place.at - before.at) + (is_new_form ? 1 : 0));
    if (is_new_form) append_number(bytes, place.form);
    before = place;
  }
}

inline void read_places(SourcesCursor& cursor, std::vector<AttributePlace>& places, AttributePlace& before) {
  for (AttributePlace& place : places) {
    const std::uint64_t code = cursor.number();
    place.at = before.at + difference_of(code >> 1U);
    place.form = (code & 1U) != 0 ? cursor.number32() : before.form;
    before = place;
  }
}

/// 0 is none.
[[nodiscard]] inline std::uint64_t row_of(const SurfaceOrigin& surface) {
  return surface.semantics ? std::uint64_t{*surface.semantics} + 1 : 0;
}

/// Before the first surface: the next has the number 0.
inline constexpr std::pair<std::uint64_t, SurfaceOrigin> first_expected{0, {}};

}  // namespace origin_coding

/// The longest id of a surface that is kept.
inline constexpr std::size_t most_id_bytes = 256;

/// Appends the ids of a building's surfaces, at least one, behind all else of its origin.
void append_ids(std::vector<std::uint8_t>& bytes, const std::vector<SurfaceIds>& ids);
/// Reads what append_ids has written; false where the bytes are not such.
[[nodiscard]] bool read_ids(SourcesCursor& cursor, std::vector<SurfaceIds>& ids);

/// Appends the bytes of a building's origin. What follows from what comes before takes no byte: most surfaces take one, and most
/// places two.
inline void append_origin(std::vector<std::uint8_t>& bytes, const BuildingOrigin& origin) {
  append_number(bytes, origin.objects.size());
  append_number(bytes, origin.semantics.size());
  append_number(bytes, origin.surfaces.size());
  AttributePlace place;
  origin_coding::append_places(bytes, origin.objects, place);
  origin_coding::append_places(bytes, origin.semantics, place);
  auto [expected, before] = origin_coding::first_expected;
  for (const SurfaceOrigin& surface : origin.surfaces) {
    const bool is_unexpected = surface.surface != expected || surface.object != before.object;
    const std::uint64_t rows = unsigned_of(origin_coding::row_of(surface) - origin_coding::row_of(before));
    append_number(bytes, 2 * rows + (is_unexpected ? 1 : 0));
    if (is_unexpected) {
      append_number(bytes, unsigned_of(surface.surface - expected));
      append_number(bytes, surface.object);
    }
    before = surface;
    expected = std::uint64_t{surface.surface} + 1;
  }
  if (!origin.ids.empty()) append_ids(bytes, origin.ids);
}

namespace origin_coding {

/// Whether the bytes are surfaces of what is there.
[[nodiscard]] inline bool read_surfaces(SourcesCursor& cursor, BuildingOrigin& origin) {
  auto [expected, before] = first_expected;
  for (SurfaceOrigin& surface : origin.surfaces) {
    const std::uint64_t code = cursor.number(), row = row_of(before) + difference_of(code >> 1U);
    const bool is_unexpected = (code & 1U) != 0;
    const std::uint64_t number = expected + (is_unexpected ? difference_of(cursor.number()) : 0);
    surface.object = is_unexpected ? cursor.number32() : before.object;
    if (cursor.failed() || number > std::numeric_limits<std::uint32_t>::max() || number + 1 < expected ||
        surface.object >= origin.objects.size() || row > origin.semantics.size())
      return false;
    surface.surface = static_cast<std::uint32_t>(number);
    if (row > 0) surface.semantics = static_cast<std::uint32_t>(row - 1);
    before = surface;
    expected = number + 1;
  }
  return true;
}

}  // namespace origin_coding

/// The inverse of append_origin; nothing where the bytes are not such, or name an object or a semantic surface that is not there.
[[nodiscard]] inline std::optional<BuildingOrigin> origin_from(std::span<const std::uint8_t> bytes) {
  SourcesCursor cursor(bytes);
  BuildingOrigin origin;
  const std::size_t objects = cursor.count(), semantics = cursor.count(), surfaces = cursor.count();
  if (cursor.failed() || objects == 0 || objects + semantics + surfaces > bytes.size()) return std::nullopt;
  origin.objects.resize(objects);
  origin.semantics.resize(semantics);
  origin.surfaces.resize(surfaces);
  AttributePlace place;
  origin_coding::read_places(cursor, origin.objects, place);
  origin_coding::read_places(cursor, origin.semantics, place);
  if (!origin_coding::read_surfaces(cursor, origin)) return std::nullopt;
  if (!cursor.failed() && !cursor.at_end() && !read_ids(cursor, origin.ids)) return std::nullopt;
  return cursor.failed() || !cursor.at_end() ? std::nullopt : std::optional(std::move(origin));
}

}  // namespace farlod::package
