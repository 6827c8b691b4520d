// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks what a shared library shows; all else stays hidden in it.
#if defined(_WIN32)
#define FARLOD_EXPORT
#else
#define FARLOD_EXPORT __attribute__((visibility("default")))
#endif
