// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farlod::scenes {

/// A file of binary glTF with one mesh, read by what it says of itself.
struct Glb {
  nlohmann::json json;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint16_t, 4>> colours;

  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number<std::uint32_t>(bytes, 4), 2U);
    EXPECT_EQ(number<std::uint32_t>(bytes, 8), bytes.size());
    const std::size_t json_length = number<std::uint32_t>(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json_length % 4, 0U);
    json = nlohmann::json::parse(bytes.substr(20, json_length));
    if (!json.contains("accessors")) return;
    const std::size_t binary = 20 + json_length;
    EXPECT_EQ(number<std::uint32_t>(bytes, binary), json.at("buffers").at(0).at("byteLength"));
    EXPECT_EQ(bytes.substr(binary + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(binary + 8 + number<std::uint32_t>(bytes, binary), bytes.size());
    const nlohmann::json attributes = json.at("meshes").at(0).at("primitives").at(0).at("attributes");
    positions = elements<float, 3>(bytes, binary + 8, attributes.at("POSITION"), 5126);
    colours = elements<std::uint16_t, 4>(bytes, binary + 8, attributes.at("COLOR_0"), 5123);
  }
  [[nodiscard]] const nlohmann::json& extras() const { return json.at("asset").at("extras"); }

 private:
  template <class Number>
  static Number number(const std::string& bytes, std::size_t place) {
    Number result{};
    EXPECT_LE(place + sizeof(result), bytes.size());
    std::memcpy(&result, bytes.data() + place, sizeof(result));
    return result;
  }
  template <class Number, std::size_t components>
  [[nodiscard]] std::vector<std::array<Number, components>> elements(const std::string& bytes, std::size_t binary,
                                                                     std::size_t accessor, int type) const {
    const nlohmann::json& a = json.at("accessors").at(accessor);
    const nlohmann::json& view = json.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    EXPECT_EQ(a.at("componentType"), type);
    EXPECT_EQ(a.at("type"), "VEC" + std::to_string(components));
    std::vector<std::array<Number, components>> result(a.at("count").get<std::size_t>());
    for (std::size_t n = 0; n < result.size(); ++n)
      for (std::size_t k = 0; k < components; ++k)
        result[n][k] = number<Number>(bytes, binary + a.value("byteOffset", std::size_t{0}) +
                                                 n * view.at("byteStride").get<std::size_t>() + k * sizeof(Number));
    return result;
  }
};

}  // namespace farlod::scenes
