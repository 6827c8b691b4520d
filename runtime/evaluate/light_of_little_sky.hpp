// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "evaluate/quantity_table.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/sky_method.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// The light of receivers that see little sky. It comes past a few edges, and the sun passes these between two azimuths: what is
/// left of the error of a single azimuth is a large part of so little. Such receivers are asked again at more azimuths.
class LightOfLittleSky {
 public:
  /// Sky view factors below this are little.
  static constexpr float little_svf = 0.05F;
  /// The azimuths at which they are asked again.
  static constexpr std::size_t azimuths = 960;

  /// Those of an evaluation, which must outlive it. Null where no light is asked for, or at no fewer azimuths.
  [[nodiscard]] static std::unique_ptr<const LightOfLittleSky> of(const Evaluation& evaluation);
  explicit LightOfLittleSky(const Evaluation& evaluation);

  /// Answers some receivers of a cell, from 0 on by their numbers, as an evaluation at more azimuths asks.
  using Answer = std::function<void(const Evaluation& finer, const CellReceivers& some, const SkyAnswers& answers)>;
  /// Puts the light of those that see little sky in the place of what horizons answered. Thread-safe.
  void improve(const CellReceivers& cell, const SkyAnswers& answers, const Answer& answer) const;

 private:
  /// Where a quantity is among the columns that were asked for, and among those of `finer_`.
  struct Columns {
    ColumnRange asked, finer;
  };
  const Evaluation& evaluation_;
  Quantities light_;
  std::vector<Columns> columns_;
  // Made on demand: a table of light at so many azimuths takes some tenths of a second
  mutable std::once_flag once_;
  mutable std::unique_ptr<const Evaluation> finer_;
};

}  // namespace farlod
