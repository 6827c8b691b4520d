// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "results/picture/drawing.hpp"
#include "results/picture/picture.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {

/// The pixels of a PNG, as a reader that is not ours has them.
[[nodiscard]] inline Picture decoded_png(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0) << image.message;
  Picture picture({image.width, image.height}, {});
  for (std::size_t n = 0; 3 * n < bytes.size(); ++n)
    picture.set({n % image.width, n / image.width}, {bytes[3 * n], bytes[3 * n + 1], bytes[3 * n + 2]});
  return picture;
}

/// The pixels of a drawing that is written as a PNG.
[[nodiscard]] inline Picture drawn(const Drawing& drawing) {
  const scenes::TemporaryFolder folder;
  write_drawing(drawing, folder.file("a.png"));
  return decoded_png(folder.file("a.png"));
}

/// A channel of sRGB by the light that it stands for (IEC 61966-2-1).
[[nodiscard]] inline double linear_channel(std::uint8_t channel) {
  const double v = channel / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace farlod
