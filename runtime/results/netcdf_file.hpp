// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "results/atomic_file.hpp"
#include "results/provenance.hpp"

namespace farlod {

enum class NetcdfType : std::uint8_t { text, whole, single_real, real, nothing };

/// A netCDF-4 file after the CF conventions, version 1.8, which is being written: first dimensions, variables and attributes are
/// defined, then values are put. The only wrapper of netCDF. All functions throw OutputError, which names the result.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::filesystem::path& path);
  /// Without commit() there is no file.
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  /// Attributes of the file; `title` says what is in it.
  void describe(const std::string& title, const Provenance& provenance);
  static constexpr std::size_t unlimited = 0;  ///< as long as what is put
  [[nodiscard]] int dimension(const std::string& name, std::size_t length);
  [[nodiscard]] int variable(const std::string& name, NetcdfType type, std::span<const int> dimensions);
  /// A number that is missing, or not put, is NaN, and a whole number `no_whole`.
  void declare_missing(int variable);
  static constexpr std::int64_t no_whole = INT64_MIN;
  /// Chunks that come once and as a whole need no cache but for one of them.
  void compress(int variable, std::span<const std::size_t> chunk);
  static constexpr int whole_file = -1;  ///< instead of a variable
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, std::span<const double> numbers);
  /// A variable `crs` with the CRS as WKT and in the words of the conventions, where they have some.
  [[nodiscard]] int crs(const std::string& wkt, std::optional<int> epsg);
  void end_definitions();

  /// From these places on, so many along each dimension.
  using Extent = std::span<const std::size_t>;
  void put(int variable, Extent first, Extent size, std::span<const float> values);
  void put(int variable, Extent first, Extent size, std::span<const double> values);
  void put(int variable, Extent first, Extent size, std::span<const std::int64_t> values);
  void put(int variable, Extent first, Extent size, std::span<const char> values);

  /// The file appears now. A full disk may show only now.
  void commit();

  /// What the library keeps of a file besides chunks, such as their index.
  static constexpr std::uint64_t library_bytes = 1 << 20;

 private:
  void must(int status) const;

  AtomicFile file_;
  int id_ = 0;
  bool is_open_ = false;
};

}  // namespace farlod
