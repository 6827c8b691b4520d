// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <vector>

#include "results/picture/picture.hpp"

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

}  // namespace farlod
