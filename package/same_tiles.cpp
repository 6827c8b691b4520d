// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/same_tiles.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "package/layout.hpp"

namespace farlod {
namespace {

using namespace package;

using Bytes = std::span<const std::byte>;

template <class T>
T element(Bytes bytes, std::size_t n) {
  T value;
  std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
  return value;
}

/// The sections of a file; nothing where it is none, or is cut off.
std::optional<std::vector<Section>> sections_of(Bytes file) {
  if (file.size() < sizeof(Header)) return std::nullopt;
  const auto header = element<Header>(file, 0);
  const Bytes rest = file.subspan(sizeof(Header));
  if (header.magic != magic || header.section_count > rest.size() / sizeof(Section)) return std::nullopt;
  std::vector<Section> sections;
  for (std::size_t n = 0; n < header.section_count; ++n) {
    sections.push_back(element<Section>(rest, n));
    const Section& s = sections.back();
    const bool fits = s.offset <= file.size() && s.element_bytes > 0 && s.count <= (file.size() - s.offset) / s.element_bytes;
    if (!fits) return std::nullopt;
  }
  return sections;
}

Bytes bytes_of(Bytes file, const Section& s) { return file.subspan(s.offset, s.count * s.element_bytes); }

bool is_of_far_maps(SectionKind kind) {
  return kind == SectionKind::far_cells || kind == SectionKind::far_edges || kind == SectionKind::explicit_edges;
}

CellRecord without_map(CellRecord cell) {
  cell.capture_x_m = cell.capture_y_m = cell.capture_z_m = cell.far_map_top = 0.0F;
  return cell;
}

/// Both have as many bytes.
bool same_cells(Bytes a, Bytes b) {
  for (std::size_t n = 0; n < a.size() / sizeof(CellRecord); ++n) {
    const CellRecord in_a = without_map(element<CellRecord>(a, n)), in_b = without_map(element<CellRecord>(b, n));
    // Bits are to be the same, of floats too. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c)
    if (std::memcmp(&in_a, &in_b, sizeof(CellRecord)) != 0) return false;
  }
  return true;
}

bool same_section(Bytes a, Bytes b, SectionKind kind) {
  if (a.size() != b.size()) return false;
  return kind == SectionKind::cells ? same_cells(a, b) : std::ranges::equal(a, b);
}

}  // namespace

bool same_tiles(Bytes file, Bytes file_without_maps) {
  const auto sections = sections_of(file), expected = sections_of(file_without_maps);
  if (!sections || !expected || sections->size() != expected->size()) return false;
  if (element<Header>(file, 0).version != element<Header>(file_without_maps, 0).version) return false;
  for (std::size_t n = 0; n < sections->size(); ++n) {
    const Section &a = (*sections)[n], &b = (*expected)[n];
    if (a.kind != b.kind || a.element_bytes != b.element_bytes) return false;
    if (is_of_far_maps(a.kind)) continue;
    if (!same_section(bytes_of(file, a), bytes_of(file_without_maps, b), a.kind)) return false;
  }
  return true;
}

}  // namespace farlod
