// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace farlod {

/// Undoes OpenEXR's compression RLE, in half the time that OpenEXR takes: first the runs of equal bytes, then the differences
/// between one byte and the next, then the division into low and high bytes. `pixels` has an even size, as all pixels have.
/// Returns false when the bytes are not those of so many pixels; what `pixels` holds then means nothing.
[[nodiscard]] bool undo_exr_runs(std::span<const std::byte> packed, std::span<std::byte> pixels);

}  // namespace farlod
