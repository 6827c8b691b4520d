// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace farlod {

/// A file that an option names; an empty path where it was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// An output, and what may be in its place.
struct NamedOutput : NamedFile {
  bool may_be_folder = false;  ///< such as a Zarr, which replaces an older one
};

/// What a run reads.
struct NamedInputs {
  std::span<const NamedFile> files;
  std::filesystem::path package = {};  ///< whose folder is to hold nothing else
};

/// Asked before the work, which may take hours: whether what it makes can be written. Throws OutputError, which names the output,
/// where
///   (1) its folder is not there, or nothing can be written in it; or there is a folder of its name;
///   (2) it is an input, or lies in the package;
///   (3) another output has the same name.
/// Devices and pipes, such as /dev/stdout, are never refused. Leaves nothing behind.
void require_writable(std::span<const NamedOutput> outputs, const NamedInputs& inputs);

}  // namespace farlod
