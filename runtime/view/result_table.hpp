// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inputs/attributes.hpp"
#include "view/result_layer.hpp"

namespace farlod {

/// What the user named: a file, and what of it.
struct ResultRequest {
  std::filesystem::path file;
  std::string quantity;  ///< perhaps empty
};

/// The number of the column with this name, if there is one.
[[nodiscard]] std::optional<std::size_t> column_of(const std::vector<std::string>& names, std::string_view name);

/// The column of the values: that which the request names, else `usual`. Throws InputError, with the columns that are there.
[[nodiscard]] std::size_t column_of_values(const Attributes& table, const ResultRequest& request, std::string_view usual);

/// NaN of what is no number.
[[nodiscard]] float number_or_nan(std::string_view text);

/// The values of a table that has a row for each surface of a building, which the columns `building` and `surface` name. None
/// where the file is no such table. Throws InputError.
[[nodiscard]] std::optional<ResultLayer> layer_of_surfaces(const ResultRequest& request);

}  // namespace farlod
