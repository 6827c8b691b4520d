# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the four algorithms share: parameters with help, calling a program, and what QGIS is told when something is wrong."""
from __future__ import annotations

import os
from typing import Any

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterEnum,
    QgsProcessingParameterNumber,
)

from .program_folder import FOLDER_SETTING, ProgramMissing, find_program
from .program_run import Cancelled, ProgramFailed, run_program
from .staging import OutputRefused

Values = dict[str, Any]


class FarlodAlgorithm(QgsProcessingAlgorithm):
    """Calls programs of Far-LoD. A subclass says what it is in TITLE, NAME and HELP, and does it in `compute`."""

    NAME = TITLE = HELP = ""

    def createInstance(self) -> FarlodAlgorithm:
        return type(self)()

    def name(self) -> str:
        return self.NAME

    def displayName(self) -> str:
        return self.TITLE

    def group(self) -> str:
        return "Sky view factor"

    def groupId(self) -> str:
        return "skyviewfactor"

    def shortDescription(self) -> str:
        return self.HELP.split("\n", maxsplit=1)[0]

    def shortHelpString(self) -> str:
        return self.HELP

    def processAlgorithm(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        try:
            return self.compute(parameters, context, feedback)
        except (ProgramMissing, ProgramFailed, OutputRefused) as reason:
            raise QgsProcessingException(str(reason)) from reason
        except Cancelled as reason:
            raise QgsProcessingException("The run was cancelled. Nothing was written.") from reason

    def compute(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        raise NotImplementedError

    def call(self, program: str, arguments: list[str], feedback: QgsProcessingFeedback) -> list[str]:
        """The lines that the program says on its standard output."""
        path = find_program(program, ProcessingConfig.getSetting(FOLDER_SETTING) or "", os.environ)
        feedback.pushCommandInfo(" ".join([program, *arguments]))
        return run_program([path, *arguments], feedback)

    # Parameters

    def add(self, parameter: QgsProcessingParameterDefinition, help_text: str, advanced: bool = False) -> None:
        parameter.setHelp(help_text)
        if advanced:
            parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
        self.addParameter(parameter)

    def add_optional_number(
        self, name: str, title: str, help_text: str, least: float, most: float, whole: bool = False, advanced: bool = False
    ) -> None:
        kind = QgsProcessingParameterNumber.Integer if whole else QgsProcessingParameterNumber.Double
        number = QgsProcessingParameterNumber(name, title, kind, None, True, least, most)
        self.add(number, help_text, advanced)

    def add_choice(self, name: str, title: str, help_text: str, words: list[str], advanced: bool = False) -> None:
        """One of the words that the program knows; the first one is the default."""
        choice = QgsProcessingParameterEnum(name, title, words, False, words[0], False, usesStaticStrings=True)
        self.add(choice, help_text, advanced)

    # Their values, as arguments of a program

    def is_given(self, parameters: Values, name: str) -> bool:
        return parameters.get(name) not in (None, "", [])

    def number_argument(self, parameters: Values, name: str, option: str, context: QgsProcessingContext) -> list[str]:
        """Nothing for an optional number that was not given."""
        definition = self.parameterDefinition(name)
        if not self.is_given(parameters, name) and definition.defaultValue() is None:
            return []
        if definition.dataType() == QgsProcessingParameterNumber.Integer:
            return [f"{option}={self.parameterAsInt(parameters, name, context)}"]
        return [f"{option}={self.parameterAsDouble(parameters, name, context)!r}"]

    def text_argument(self, parameters: Values, name: str, option: str, context: QgsProcessingContext) -> list[str]:
        text = self.parameterAsString(parameters, name, context).strip()
        return [f"{option}={text}"] if text else []

    def choice_argument(self, parameters: Values, name: str, option: str, context: QgsProcessingContext) -> list[str]:
        return [f"{option}={self.parameterAsEnumString(parameters, name, context)}"]

    def flag_argument(self, parameters: Values, name: str, option: str, context: QgsProcessingContext) -> list[str]:
        return [option] if self.parameterAsBoolean(parameters, name, context) else []
