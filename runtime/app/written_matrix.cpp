// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/written_run.hpp"
#include "results/table/matrix_npz.hpp"

namespace farlod {

WrittenMatrix write_matrix(const Package& package, const SvfOptions& options, const SurfaceMeans& means, const RunSettings& run) {
  WrittenMatrix written;
  written.threshold = options.matrix.threshold;
  written.seconds = seconds_of([&] {
    const ViewFactorMatrix matrix =
        view_factor_matrix(package, options.surfaces, means.surfaces, options.matrix, options.evaluation, run);
    write_matrix_npz(matrix, means.surfaces, options.matrix_file, run.threads);
    written.surfaces = matrix.surfaces;
    written.columns = matrix.column_count();
    written.entries = matrix.values.size();
    written.figures = matrix.figures;
  });
  return written;
}

}  // namespace farlod
