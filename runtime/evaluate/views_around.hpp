// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "farlod/point.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

class SkyEvaluator;

/// What is seen around a place, whatever the normal of its receiver: Quantities::view_cube and ::view_sphere, which are the view
/// factors of receivers that look elsewhere. A cube's are those of its six normals, a sphere's the mean of both its halves by
/// solid angle. Thread-safe.
class ViewsAround {
 public:
  /// For what an evaluator is asked for, and with what it shares.
  explicit ViewsAround(const SkyEvaluator& evaluator);
  ~ViewsAround();
  /// Stores the columns of the receivers of a cell.
  void store(const CellReceivers& cell, const FurtherQuantities& quantities, const SkyAnswers& answers) const;

 private:
  std::unique_ptr<const SkyEvaluator> faces_, halves_;  ///< null where nobody asks for them
  std::vector<Point3f> normals_;                        ///< of faces_of_cube, grid frame
};

}  // namespace farlod
