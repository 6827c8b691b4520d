// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <span>
#include <vector>

#include "package/layout.hpp"
#include "tests/fuzz/tiles_mutator.hpp"

// Changes a `tiles.bin` element by element, and keeps what a reader checks first: libFuzzer's own changes, which move all bytes
// that follow, would seldom get beyond the table of sections.

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace farlod {
namespace {

using package::Header;
using package::Section;
using Random = std::mt19937;

/// What numbers of 32 bits are at their ends, as whole numbers and as floats.
constexpr std::array<std::uint32_t, 18> extremes{0U,          1U,          2U,          0x7FU,       0xFFU,       0xFFFFU,
                                                 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, 0xFFFFFFFEU, 0x3F800000U, 0xBF800000U,
                                                 0x7F800000U, 0xFF800000U, 0x7FC00000U, 0x4B465D40U, 0xCB465D40U, 0x00000001U};

std::size_t below(Random& random, std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); }

/// The sections of a file whose elements lie in it.
std::vector<Section> sections_of(std::span<const std::uint8_t> file) {
  std::vector<Section> sections;
  Header header{};
  if (file.size() < sizeof header) return sections;
  std::memcpy(&header, file.data(), sizeof header);
  const std::size_t most = (file.size() - sizeof header) / sizeof(Section);
  for (std::size_t n = 0; n < std::min<std::size_t>(header.section_count, most); ++n) {
    Section s{};
    std::memcpy(&s, file.data() + sizeof header + n * sizeof s, sizeof s);
    const bool fits =
        s.element_bytes > 0 && s.count > 0 && s.offset < file.size() && s.count <= (file.size() - s.offset) / s.element_bytes;
    if (fits) sections.push_back(s);
  }
  return sections;
}

void change_number(std::span<std::uint8_t> element, Random& random) {
  const std::size_t at = 4 * below(random, element.size() / 4);
  const std::uint32_t number = extremes[below(random, extremes.size())];
  std::memcpy(element.data() + at, &number, sizeof number);
}

void change_element(std::span<std::uint8_t> section, std::size_t element_bytes, Random& random) {
  const std::size_t elements = section.size() / element_bytes;
  const auto element = section.subspan(below(random, elements) * element_bytes, element_bytes);
  const auto other = section.subspan(below(random, elements) * element_bytes, element_bytes);
  switch (below(random, element_bytes < 4 ? 2 : 4)) {
    case 0:
      LLVMFuzzerMutate(element.data(), element.size(), element.size());
      break;
    case 1:
      std::copy(other.begin(), other.end(), element.begin());
      break;
    default:
      change_number(element, random);
      break;
  }
}

}  // namespace

std::size_t mutate_tiles(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  Random random(seed);
  const std::vector<Section> sections = sections_of({data, size});
  if (sections.empty() || below(random, 16) == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) {
    const Section& s = sections[below(random, sections.size())];
    change_element({data + s.offset, s.count * s.element_bytes}, s.element_bytes, random);
  }
  return size;
}

}  // namespace farlod
