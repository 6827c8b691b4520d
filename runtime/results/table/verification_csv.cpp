// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/verification_csv.hpp"

#include <ostream>

#include "results/atomic_file.hpp"
#include "results/table/csv_text.hpp"

namespace farlod {

void write_verification_csv(std::span<const VerifiedReceiver> receivers, const std::string& quantity,
                            const std::filesystem::path& path) {
  CsvText text;
  text.fields({"x_m", "y_m", "z_m", quantity, quantity + "_exact"}).end_row();
  for (const VerifiedReceiver& r : receivers) {
    text.millimetres(r.p_projected.x).millimetres(r.p_projected.y).millimetres(r.p_projected.z);
    text.svf(r.svf).svf(r.exact).end_row();
  }
  write_atomically(path, [&text](std::ostream& file) { file << text.bytes(); });
}

}  // namespace farlod
