# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Which names of a Python package get a page, and what is on it."""
import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "site"))
sys.dont_write_bytecode = True
import python_pages  # noqa: E402, the folder is known only now

SOURCE = """
import typing
class Base:
    def close(self): pass
class City(Base):
    def __init__(self): pass
    def svf(self): pass
    def _hidden(self): pass
    @property
    def crs(self): pass
class Answer(typing.NamedTuple):
    svf: float
class Error(ValueError): pass
def open(path): pass
def not_public(): pass
LIMIT = 3
__all__ = ["City", "Answer", "Error", "open", "LIMIT"]
"""


def planted_package():
    package = types.ModuleType("planted")
    exec(SOURCE, vars(package))
    package.errors = types.ModuleType("planted.errors")
    package._inner = types.ModuleType("planted._inner")
    return package


class PythonPages(unittest.TestCase):
    def test_each_public_name_is_of_one_kind(self):
        self.assertEqual(python_pages.names_by_kind(planted_package()),
                         {"Functions": ["open"], "Classes": ["City"], "Results": ["Answer"], "Values": ["LIMIT"],
                          "Exceptions": ["Error"], "Modules": ["errors"]})

    def test_a_class_shows_its_own_public_methods_and_those_of_our_bases(self):
        package = planted_package()
        self.assertEqual(python_pages.methods_of(package.City, package), ["close", "svf"])
        self.assertEqual(python_pages.properties_of(package.City, package), ["crs"])

    def test_what_a_tuple_or_an_exception_inherits_is_no_news(self):
        package = planted_package()
        self.assertEqual(python_pages.methods_of(package.Answer, package), [])
        self.assertEqual(python_pages.methods_of(package.Error, package), [])

    def test_each_method_has_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            python_pages.write_page(pathlib.Path(folder), planted_package(), "City", "autoclass")
            self.assertEqual(sorted(path.name for path in pathlib.Path(folder).iterdir()),
                             ["planted.City.close.rst", "planted.City.rst", "planted.City.svf.rst"])
            self.assertIn(".. autoproperty:: City.crs", (pathlib.Path(folder) / "planted.City.rst").read_text())


if __name__ == "__main__":
    unittest.main()
