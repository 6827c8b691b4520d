// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/binding/exceptions.hpp"

#include <pybind11/pybind11.h>

#include <exception>

#include "farlod/error.hpp"

namespace py = pybind11;

namespace farlod {
namespace {

/// The library's advice names options of the programs.
py::object in_words_of_python(const Error& error) {
  return py::module_::import("farlod._program_words").attr("words_of_python")(error.what());
}

void raise(const char* class_name, const Error& error) {
  PyErr_SetObject(py::module_::import("farlod.errors").attr(class_name).ptr(), in_words_of_python(error).ptr());
}

void raise(const InvalidPoint& error) {
  const py::object type = py::module_::import("farlod.errors").attr("InvalidPoint");
  const py::object raised = type(in_words_of_python(error), error.index());
  PyErr_SetObject(type.ptr(), raised.ptr());
}

/// What derives from another class stands before it.
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InvalidPoint& error) {
    raise(error);
  } catch (const InvalidArgument& error) {
    raise("InvalidArgument", error);
  } catch (const Cancelled& error) {
    raise("Cancelled", error);
  } catch (const ProblemsRefused& error) {
    raise("ProblemsRefused", error);
  } catch (const InputError& error) {
    raise("InputError", error);
  } catch (const OutputError& error) {
    raise("OutputError", error);
  } catch (const PackageUnusable& error) {
    raise("PackageUnusable", error);
  } catch (const PackageDamaged& error) {
    raise("PackageDamaged", error);
  } catch (const LimitReached& error) {
    raise("LimitReached", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

void translate_exceptions() { py::register_local_exception_translator(&translate); }

}  // namespace farlod
