// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace farlod::package {

/// The end of a manifest that has a checksum of itself: the key `xxh3`, the last one of the manifest, in exactly these bytes. It
/// is the same in each version of the format that has one, so that damage is told from another version.
struct ManifestSeal {
  static constexpr std::string_view before_digits = "\"xxh3\": \"", after_digits = "\"\n}\n";
  static constexpr std::size_t digits = 16;
  static constexpr std::size_t bytes = before_digits.size() + digits + after_digits.size();

  std::string_view sealed;     ///< all bytes of the manifest before the seal
  std::uint64_t checksum = 0;  ///< their XXH3-64 with seed 0

  /// The seal of a manifest; none where its last bytes are not one. Digits are lower case, so that no bit can change unnoticed.
  [[nodiscard]] static std::optional<ManifestSeal> of(std::string_view manifest) {
    if (manifest.size() < bytes) return std::nullopt;
    const std::string_view end = manifest.substr(manifest.size() - bytes);
    const std::string_view number = end.substr(before_digits.size(), digits);
    const bool is_seal = end.starts_with(before_digits) && end.ends_with(after_digits) &&
                         number.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (!is_seal) return std::nullopt;
    ManifestSeal seal{manifest.substr(0, manifest.size() - bytes), 0};
    std::from_chars(number.data(), number.data() + number.size(), seal.checksum, 16);
    return seal;
  }

  /// The bytes that end a manifest whose other bytes have this checksum.
  [[nodiscard]] static std::string text_of(std::uint64_t checksum) {
    std::string number(digits, '0');
    for (std::size_t n = digits; n > 0; --n, checksum >>= 4U) number[n - 1] = "0123456789abcdef"[checksum & 15U];
    return std::string(before_digits) + number + std::string(after_digits);
  }
};

}  // namespace farlod::package
