// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"

namespace farlod::tiles {

/// Objects that one thread cuts in one batch, and batches that may wait to be placed. This bounds the memory of what waits.
inline constexpr std::size_t batch_size = 256, batches_at_once = 16;

/// Something that is made, and then placed.
class MadeBatch {
 public:
  MadeBatch() = default;
  MadeBatch(const MadeBatch&) = delete;
  MadeBatch& operator=(const MadeBatch&) = delete;
  virtual ~MadeBatch() = default;
  virtual void make() = 0;
  virtual void place() = 0;
};

/// Makes and places the batches that `next` hands out, until it hands out none. They are made in parallel, and placed in order,
/// one at a time.
void make_and_place_batches(const std::function<std::unique_ptr<MadeBatch>()>& next);

/// Calls place(item, make(item)) for each item that `next` hands out: some at a time, none at the end. The calls of `make` run in
/// parallel; those of `place` run in order, one at a time.
template <class Next, class Make, class Place>
void make_and_place(const Next& next, const std::stop_token& stop, const Make& make, const Place& place) {
  using Items = decltype(next());
  struct Batch final : MadeBatch {
    Batch(Items these, const std::stop_token& ends, const Make& by, const Place& in)
        : items(std::move(these)), stop_asked(ends), make_one(by), place_one(in) {}
    void make() override {
      for (const auto& item : items) {
        throw_if_cancelled(stop_asked);
        made.push_back(make_one(item));
      }
    }
    void place() override {
      for (std::size_t k = 0; k < made.size(); ++k) place_one(items[k], made[k]);
    }

    Items items;
    std::vector<std::invoke_result_t<const Make&, typename Items::const_reference>> made;
    const std::stop_token& stop_asked;
    const Make& make_one;
    const Place& place_one;
  };
  make_and_place_batches([&]() -> std::unique_ptr<MadeBatch> {
    Items items = next();
    return items.empty() ? nullptr : std::make_unique<Batch>(std::move(items), stop, make, place);
  });
}

/// Hands out the numbers from `begin` to before `end`.
class Numbers {
 public:
  Numbers(std::size_t begin, std::size_t end) : end_(end), next_(begin) {}
  std::vector<std::size_t> next(std::size_t most) {
    std::vector<std::size_t> numbers;
    for (; numbers.size() < most && next_ < end_; ++next_) numbers.push_back(next_);
    return numbers;
  }

 private:
  std::size_t end_, next_;
};

}  // namespace farlod::tiles
