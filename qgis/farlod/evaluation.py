# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the three algorithms that call farlod-svf share: the package, which receivers are asked for, how the sky is seen."""
from __future__ import annotations

import json
import pathlib

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingOutputNumber,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterFile,
    QgsProcessingParameterNumber,
    QgsProcessingParameterString,
)

from .algorithm import FarlodAlgorithm, Values
from .layer_files import save_source
from .staging import Staging

QUANTITIES = ["svf_solid", "directional", "hidden", "horizon", "horizon_distance", "sky_patches", "sunlit", "sunlit_total", "shadow_patches",
              "irradiation", "irradiance", "illuminance", "shade", "sky_component", "view_factors", "view_factors_below",
              "view_cube", "view_sphere", "view_eye", "view_building",
              "svf_total", "svfaveg", "directional_vegetation", "shares"]
QUANTITIES_HELP = (
    "Besides svf. svf_solid: share of the solid angle; directional: svfN, svfE, svfS, svfW as UMEP has them; hidden: shares that "
    "near and far geometry hide; horizon: its elevations; horizon_distance: and how far away it is; sky_patches: share seen of "
    "each patch of the sky; sunlit: hours of sunshine, which need a day or a year; shadow_patches: what hides each of the 153 of "
    "UMEP, as bits; irradiation, in kWh/m², irradiance, in W/m², illuminance, in lx, and shade: those of a period; "
    "sky_component: light of an overcast sky; view_factors: what is seen of sky, ground, roofs, walls by the azimuth that they "
    "face, and crowns; view_factors_below: what of it lies below the horizontal; view_cube: the same of the six faces "
    "of a cube; view_sphere: of all directions around; view_eye: of a field at eye level, such as the green view; view_building: what one building fills of the "
    "view, and whether it is seen; with the trees of a package svf_total (and "
    "svfveg), svfaveg, directional_vegetation: both of the halves of the sky as UMEP has them; and the shares of sky, "
    "vegetation and building."
)
COUNTS = {"RECEIVERS": "Receivers with data", "NODATA": "Receivers without data"}
STATISTICS = {"SVF_MIN": "Smallest value", "SVF_MEAN": "Mean", "SVF_MAX": "Largest value"}


class EvaluationAlgorithm(FarlodAlgorithm):
    """Calls farlod-svf."""

    def add_package(self) -> None:
        package = QgsProcessingParameterFile("PACKAGE", "Package", QgsProcessingParameterFile.Folder)
        self.add(package, "The folder that “Pack a city” has written.")

    def add_placing(self) -> None:
        double = QgsProcessingParameterNumber.Double
        height = QgsProcessingParameterNumber("HEIGHT", "Height (m)", double, 1.5, False, 0.0, 10000.0)
        self.add(height, "Of the receivers above the ground.")
        on_surface = QgsProcessingParameterBoolean("ON_SURFACE", "Count the height from roofs, too", False)
        self.add(on_surface, "From whatever is highest, ground or roof. Otherwise receivers inside of buildings have no data.")

    def add_region(self) -> None:
        extent = QgsProcessingParameterExtent("EXTENT", "Extent", None, True)
        self.add(extent, "Receivers in it alone; in another CRS, in the rectangle around it in that of the package.")
        mask = QgsProcessingParameterFeatureSource("MASK", "Mask", [QgsProcessing.TypeVectorPolygon], None, True)
        self.add(mask, "Receivers in the polygons of this layer alone.")

    def add_sky(self) -> None:
        quantities = QgsProcessingParameterEnum(
            "QUANTITIES", "Further quantities", QUANTITIES, True, None, True, usesStaticStrings=True
        )
        self.add(quantities, QUANTITIES_HELP)
        sun = QgsProcessingParameterString("SUN", "Day or year of the sunshine", None, False, True)
        self.add(sun, "2026-06-21, or 2026. Adds the hours of sunshine, were the sky clear.")
        weather = QgsProcessingParameterFile("WEATHER", "Weather (EPW, TMY or CSV)", optional=True)
        self.add(weather, "For irradiation, irradiance, illuminance and shade. Without it, the sky is clear in the period.")
        period = QgsProcessingParameterString("PERIOD", "Period", None, False, True)
        self.add(period, "2026-06, 2026-06-21T10:00/16:00, or of any year, 06-21. Default: all of the weather.")
        by_month = QgsProcessingParameterBoolean("BY_MONTH", "Irradiation of each month, too", False)
        self.add(by_month, "A band or column for each.")
        self.add_optional_number("HORIZONS", "Azimuths of horizon", "Default: 36.", 4, 3600, whole=True, advanced=True)
        patches = "145: Tregenza's; 577: Reinhart's. For sky_patches."
        self.add_choice("SKY_PATCHES", "Patches of the sky", patches, ["145", "577"], advanced=True)
        sectors = "8: north, north-east and so on. For view_factors and its like."
        self.add_choice("WALL_SECTORS", "Azimuths of walls", sectors, ["4", "8"], advanced=True)
        eye = "For view_eye: degrees above and below the horizontal. Default: 30."
        self.add_optional_number("EYE_FIELD", "Field of the eye (°)", eye, 1.0, 90.0, advanced=True)
        sees = QgsProcessingParameterString("SEES", "Building to look for", None, False, True)
        self.add(sees, "Its id, as tables of surfaces name it. For view_building.")
        sky = "cosine: svf; solid: svf_solid, which weighs all directions alike."
        self.add_choice("SKY", "Weight of the sky", sky, ["cosine", "solid"], advanced=True)

    def add_accuracy(self) -> None:
        error = "No value is farther from the true one: the whole city decides what is left open."
        self.add_optional_number("MAX_ERROR", "Largest error allowed", error, 0.0001, 1.0)
        bounds = QgsProcessingParameterBoolean("BOUNDS", "Lower and upper bounds, too", False)
        self.add(bounds, "An interval around each value: svf_low, svf_high; with svf_total also svf_total_low, svf_total_high.")
        verify = "So many random receivers are computed again, exactly; the log has the errors."
        self.add_optional_number("VERIFY", "Receivers to verify", verify, 0, 1000000000, whole=True, advanced=True)
        engines = ["auto", "horizon", "rays", "exact"]
        self.add_choice("ENGINE", "Engine", "exact traces rays against the whole city: the reference.", engines, advanced=True)
        self.add_optional_number("AZIMUTHS", "Azimuths", "Default: 320, or what the error needs.", 4, 1000000, True, True)
        self.add_optional_number("RAYS", "Rays", "Default: 1,000, or what the error needs.", 1, 10000000, True, True)
        memory = "The run does not begin when it needs more."
        self.add_optional_number("MEMORY_LIMIT", "Memory limit (MiB)", memory, 1, 2**30, True, True)

    def add_statistics(self) -> None:
        for name, title in {**COUNTS, **STATISTICS}.items():
            self.addOutput(QgsProcessingOutputNumber(name, title))

    # Running

    def package(self, parameters: Values, context: QgsProcessingContext) -> str:
        return self.parameterAsFile(parameters, "PACKAGE", context)

    def package_crs(
        self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> QgsCoordinateReferenceSystem:
        facts = json.loads("\n".join(self.call("farlod-info", [self.package(parameters, context), "--json"], feedback)))
        epsg = facts["crs"]["epsg"]
        if epsg is not None:
            return QgsCoordinateReferenceSystem(f"EPSG:{epsg}")
        return QgsCoordinateReferenceSystem.fromWkt(facts["crs"]["wkt"])

    def placing_arguments(self, parameters: Values, context: QgsProcessingContext) -> list[str]:
        on_surface = self.flag_argument(parameters, "ON_SURFACE", "--on-surface", context)
        return self.number_argument(parameters, "HEIGHT", "--height", context) + on_surface

    def region_arguments(
        self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback, folder: pathlib.Path
    ) -> list[str]:
        arguments = []
        if self.is_given(parameters, "EXTENT"):
            box = self.parameterAsExtent(parameters, "EXTENT", context, self.package_crs(parameters, context, feedback))
            if box.isEmpty():
                raise QgsProcessingException("The extent is empty, or cannot be brought to the CRS of the package.")
            arguments.append(f"--bbox={box.xMinimum()!r},{box.yMinimum()!r},{box.xMaximum()!r},{box.yMaximum()!r}")
        mask = self.parameterAsSource(parameters, "MASK", context)
        if mask is not None:
            arguments += ["--mask", save_source(mask, folder / "mask.gpkg")]
        return arguments

    def sky_arguments(self, parameters: Values, context: QgsProcessingContext) -> list[str]:
        quantities = [name for name in self.parameterAsEnumStrings(parameters, "QUANTITIES", context) if name]
        arguments = ["--quantity", ",".join(quantities)] if quantities else []
        arguments += self.text_argument(parameters, "SUN", "--sun", context)
        arguments += self.text_argument(parameters, "WEATHER", "--weather", context)
        arguments += self.text_argument(parameters, "PERIOD", "--period", context)
        if self.parameterAsBoolean(parameters, "BY_MONTH", context):
            arguments += ["--by", "month"]
        arguments += self.number_argument(parameters, "HORIZONS", "--horizons", context)
        if "sky_patches" in quantities:
            arguments += self.choice_argument(parameters, "SKY_PATCHES", "--sky-patches", context)
        if any(name.startswith("view_") and name != "view_building" for name in quantities):
            arguments += self.choice_argument(parameters, "WALL_SECTORS", "--wall-sectors", context)
        if "view_eye" in quantities:
            arguments += self.number_argument(parameters, "EYE_FIELD", "--eye-field", context)
        arguments += self.text_argument(parameters, "SEES", "--sees", context)
        arguments += self.choice_argument(parameters, "SKY", "--sky", context)
        arguments += self.choice_argument(parameters, "ENGINE", "--engine", context)
        arguments += self.flag_argument(parameters, "BOUNDS", "--bounds", context)
        for name in ("MAX_ERROR", "VERIFY", "AZIMUTHS", "RAYS", "MEMORY_LIMIT"):
            arguments += self.number_argument(parameters, name, "--" + name.lower().replace("_", "-"), context)
        return arguments

    def evaluate(
        self,
        arguments: list[str],
        parameters: Values,
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
        staging: Staging,
    ) -> Values:
        """Writes `staging.result`, and returns the numbers that every evaluation has."""
        summary = staging.folder / "summary.json"
        command = [self.package(parameters, context), "-o", str(staging.result), "--summary", str(summary), *arguments]
        said = self.call("farlod-svf", [*command, *self.sky_arguments(parameters, context)], feedback)
        for line in said:
            if not line.startswith(str(staging.results)):  # names of files that are about to be moved
                feedback.pushInfo(line)
        numbers = json.loads(summary.read_text(encoding="utf-8"))
        results = {name: numbers[name.lower()] for name in COUNTS}
        if numbers["svf"]["mean"] is None:
            feedback.pushWarning("No receiver has data: all of them lie inside of buildings or outside of the city.")
            return results
        return {**results, **{name: numbers["svf"][name.removeprefix("SVF_").lower()] for name in STATISTICS}}
