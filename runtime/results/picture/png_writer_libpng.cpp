// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <limits>

#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/picture/png_writer.hpp"

namespace farlod {

void write_png(const Picture& picture, const std::filesystem::path& path) {
  constexpr std::size_t largest = std::numeric_limits<int>::max();
  if (picture.size().width > largest || picture.size().height > largest)
    throw OutputError(path, "the picture is too large for PNG");
  AtomicFile file(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.size().width);
  image.height = static_cast<png_uint_32>(picture.size().height);
  image.format = PNG_FORMAT_RGB;
  // A row stride of 0 means that the rows follow each other without a gap
  if (png_image_write_to_file(&image, file.temporary().c_str(), 0, picture.pixels().data(), 0, nullptr) == 0)
    throw OutputError(path, image.message);
  file.commit();
}

}  // namespace farlod
