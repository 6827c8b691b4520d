// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace farlod {

/// The shortest decimal number, without an exponent, that reads back as `value` (which is finite).
[[nodiscard]] std::string shortest_decimal(double value);
[[nodiscard]] std::string shortest_decimal(float value);
/// A view factor, with six digits after the point.
[[nodiscard]] std::string svf_decimal(double value);

// Appended to a text, since tables have many numbers:

/// Rounded to the millimetre, without trailing zeros: coordinates and areas have no more certain digits.
void append_millimetres(std::string& text, double value);
/// With eight digits after the point: of longitude and latitude, a millimetre.
void append_degrees(std::string& text, double value);
/// As svf_decimal.
void append_svf(std::string& text, double value);
void append_whole(std::string& text, std::uint64_t number);

/// Appends a text in quotes, as RFC 8259 says; bytes beyond ASCII stay as they are.
void append_json_text(std::string& json, std::string_view text);

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
/// Appends a number as binary files have it.
template <class Number>
void append_bytes(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

}  // namespace farlod
