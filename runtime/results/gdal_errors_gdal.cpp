// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cpl_error.h>

#include "results/gdal_errors.hpp"

namespace farlod {

GdalErrors::GdalErrors() {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

GdalErrors::~GdalErrors() { CPLPopErrorHandler(); }

bool GdalErrors::any() const { return CPLGetLastErrorType() >= CE_Failure; }

std::string GdalErrors::last() const {
  const std::string message = CPLGetLastErrorMsg();
  return message.empty() ? "GDAL gives no reason" : message;
}

}  // namespace farlod
