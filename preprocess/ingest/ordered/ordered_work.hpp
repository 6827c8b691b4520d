// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace farlod::ingest {

/// Work in pieces, each of which has a place until it ends. The number of places bounds what is in memory.
struct OrderedWork {
  std::function<bool(std::size_t place)> begin;  ///< puts the next piece there; false: none is left. In order, one at a time
  std::function<void(std::size_t place)> work;   ///< on all threads
  std::function<void(std::size_t place)> end;    ///< takes the piece out. In order, one at a time
};

/// Works on all threads of the task arena that it is called in, on as many pieces at a time as there are places. What one of the
/// three throws ends all work and is thrown on. The caller's data must outlive the call, and no piece is at two places.
void run_in_order(std::size_t places, const OrderedWork& work);

/// The number of threads of the task arena that it is called in.
[[nodiscard]] std::size_t threads_here();

/// As many places as keep the threads of the task arena at work that it is called in. Of more than 16 threads, the others would
/// wait: to end a piece takes a twentieth of the time that it takes to work on it (CityGML), or more.
[[nodiscard]] std::size_t places_for_threads();

}  // namespace farlod::ingest
