// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/matrix_npz.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/expects.hpp"
#include "results/atomic_file.hpp"
#include "results/raster/npz_file.hpp"

namespace farlod {
namespace {

static_assert(std::endian::native == std::endian::little, "NumPy's types below say so");

std::string shape_of(std::size_t count) { return "(" + std::to_string(count) + ",)"; }

/// Items of so many bytes each, which lie one after the other.
NpzArray array_of_bytes(std::string name, std::span<const std::byte> bytes, std::size_t item_bytes, std::string type,
                        std::string shape) {
  FARLOD_EXPECTS(item_bytes > 0 && bytes.size() % item_bytes == 0);
  return {std::move(name),
          bytes.size() / item_bytes,
          1,
          item_bytes,
          [](std::size_t, std::size_t) {},
          [bytes, item_bytes](std::size_t row, std::span<std::uint8_t> values) {
            std::memcpy(values.data(), bytes.data() + row * item_bytes, item_bytes);
          },
          std::move(type),
          std::move(shape)};
}

template <class Number>
NpzArray array_of(std::string name, const std::vector<Number>& numbers, std::string type) {
  return array_of_bytes(std::move(name), std::as_bytes(std::span(numbers)), sizeof(Number), std::move(type),
                        shape_of(numbers.size()));
}

/// Texts of the same length: shorter ones end with zeros, as NumPy has it.
struct Texts {
  std::size_t length = 1;
  std::string all;
};

Texts padded(const std::vector<std::string>& texts) {
  Texts result;
  for (const std::string& text : texts) result.length = std::max(result.length, text.size());
  for (const std::string& text : texts) result.all.append(text).append(result.length - text.size(), '\0');
  return result;
}

void add_texts(NpzFile& file, const std::string& name, const std::vector<std::string>& texts) {
  const Texts padded_texts = padded(texts);
  file.add(array_of_bytes(name, std::as_bytes(std::span(padded_texts.all)), padded_texts.length,
                          "|S" + std::to_string(padded_texts.length), shape_of(texts.size())));
}

void add_csr(NpzFile& file, const ViewFactorMatrix& matrix) {
  std::vector<std::int64_t> begins{0};
  for (const std::uint64_t end : matrix.row_end) begins.push_back(static_cast<std::int64_t>(end));
  const std::vector<std::int64_t> shape{static_cast<std::int64_t>(matrix.surfaces),
                                        static_cast<std::int64_t>(matrix.column_count())};
  const std::string format = "csr";
  file.add(array_of("indices", matrix.columns, "<i4"));
  file.add(array_of("indptr", begins, "<i8"));
  file.add(array_of_bytes("format", std::as_bytes(std::span(format)), format.size(), "|S3", "()"));
  file.add(array_of("shape", shape, "<i8"));
  file.add(array_of("data", matrix.values, "<f4"));
}

/// What rows and columns are.
void add_names(NpzFile& file, const ViewFactorMatrix& matrix, std::span<const SurfaceMean> surfaces) {
  std::vector<std::string> buildings;
  std::vector<std::uint32_t> numbers;
  for (const SurfaceMean& surface : surfaces) {
    buildings.push_back(surface.building);
    numbers.push_back(surface.surface);
  }
  std::vector<double> centres;
  for (const GroundColumn& ground : matrix.ground) {
    centres.push_back(ground.centre_projected.x);
    centres.push_back(ground.centre_projected.y);
  }
  add_texts(file, "building", buildings);
  file.add(array_of("surface", numbers, "<u4"));
  file.add(array_of("area_m2", matrix.area_m2, "<f8"));
  add_texts(file, "columns_after_surfaces", names_after_surfaces(matrix));
  file.add(array_of_bytes("ground_centres_m", std::as_bytes(std::span(centres)), 2 * sizeof(double), "<f8",
                          "(" + std::to_string(matrix.ground.size()) + ", 2)"));
}

}  // namespace

std::vector<std::string> names_after_surfaces(const ViewFactorMatrix& matrix) {
  std::vector<std::string> names;
  for (const GroundColumn& ground : matrix.ground)
    names.push_back("ground_" + std::to_string(ground.cell.i) + "_" + std::to_string(ground.cell.j));
  for (const auto& rest : matrix_rest_words) names.emplace_back(rest.text);
  return names;
}

void write_matrix_npz(const ViewFactorMatrix& matrix, std::span<const SurfaceMean> surfaces, const std::filesystem::path& path,
                      std::size_t threads) {
  FARLOD_EXPECTS(surfaces.size() == matrix.surfaces);
  AtomicFile whole(path);
  NpzFile file(whole.temporary(), path, threads);
  add_csr(file, matrix);
  add_names(file, matrix, surfaces);
  file.close();
  whole.commit();
}

}  // namespace farlod
