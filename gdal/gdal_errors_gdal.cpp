// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "gdal/gdal_errors.hpp"

#include <cpl_error.h>

#include <utility>

namespace farlod {
namespace {

void CPL_STDCALL keep_failure(CPLErr level, CPLErrorNum, const char* message) {
  if (level >= CE_Failure) static_cast<std::vector<std::string>*>(CPLGetErrorHandlerUserData())->emplace_back(message);
}

}  // namespace

GdalErrors::GdalErrors() {
  CPLPushErrorHandlerEx(&keep_failure, &messages_);
  CPLErrorReset();
}

GdalErrors::~GdalErrors() { CPLPopErrorHandler(); }

std::string GdalErrors::last() const { return messages_.empty() ? "GDAL gives no reason" : messages_.back(); }

std::vector<std::string> GdalErrors::take() { return std::exchange(messages_, {}); }

}  // namespace farlod
