// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace farlod {

/// The page of the bundle with its script, its style, its licences and all the files that it asks for, as one text of HTML. A
/// browser shows it without a server: viewer/src/embedded_files.ts takes the files from elements
/// `<script type="text/plain" data-file="NAME">`, which hold them compressed by gzip, in base64.
///   (1) the text asks no server for anything, and tells the browser to refuse it
///   (2) no byte of a file ends its element
class OnePage {
 public:
  /// Writes what stands before the files. The stream must outlive this.
  explicit OnePage(std::ostream& stream);

  void add(const std::string& name, std::string_view bytes);
  /// Writes what stands behind the files.
  void finish();
  /// That were written until now.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void write(std::string_view text);

  std::ostream& stream_;
  std::string rest_;
  std::uint64_t bytes_ = 0;
};

}  // namespace farlod
