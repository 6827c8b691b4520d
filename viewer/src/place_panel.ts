// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { cssOf, lineColours, partColours, partNames } from "./drawing.ts";
import { Fisheye, sharesOf } from "./fisheye.ts";
import type { Frames } from "./frames.ts";
import { element, part, showFacts } from "./page_parts.ts";
import type { Selection } from "./selection.ts";
import type { Hemisphere, PointAnswer } from "./server.ts";
import type { SkyProjection } from "./sky_projection.ts";
import type { SurfaceKind } from "./surface_kinds.ts";
import type { ViewInfo } from "./view_info.ts";

const kindWords: Record<SurfaceKind, string> =
  { ground: "ground", roof: "roof", wall: "façade", floor: "underside", unknown: "unknown" };
const partWords: Record<(typeof partNames)[number], string> =
  { sky: "sky", near: "near geometry", far: "far geometry", crown: "crowns of trees" };
const captionOfFisheye =
  "As seen from below: true north is up, and east is on the left. Shares are those of the view of a level surface.";

const noAnswer = "This place has no answer: it lies inside a building, below the ground, or where there is no ground.";
const noAnswerFromAfar = "This place has no answer. From so far, the city is drawn in a simplified form: come nearer, and ask again.";

/** What is told of the selected place. */
export class PlacePanel {
  private readonly fisheye = new Fisheye(part("fisheye", HTMLCanvasElement));
  private readonly value = part("value");
  private hemisphere: Hemisphere | null = null;

  constructor(private readonly view: ViewInfo, private readonly frames: Frames) {
    part("fisheye-caption").textContent = captionOfFisheye;
    for (const id of ["sky", "ask-cell"]) part(id).hidden = !view.can_answer;
  }

  /** What the tiles know; the server's answer follows. */
  showFacet({ facet, receiver }: Selection): void {
    part("place-title").textContent = facet.building === "" ? "Ground" : facet.building;
    const [x_m, y_m, z_m] = this.frames.projectedOf(facet.p_local), { azimuth_deg = 0, tilt_deg = 0 } = receiver;
    const looks = tilt_deg < 0.05 ? "straight up" : `azimuth ${azimuth_deg.toFixed(1)}°, tilt ${tilt_deg.toFixed(1)}°`;
    showFacts(part("place-facts"), [
      ["Kind", kindWords[facet.kind]],
      ["Surface", facet.building === "" ? null : String(facet.surface)],
      ["East, north", `${x_m.toFixed(2)}, ${y_m.toFixed(2)}`],
      ["Height", `${z_m.toFixed(2).replace(/^-(0\.0*)$/, "$1")} m above sea level`],
      ["Facet as drawn", facet.svf === null ? "no data" : facet.svf.toFixed(3)],
      ["Looks", looks],
    ]);
    this.value.classList.add("stale");
    if (!this.view.can_answer) this.showFacetAlone(facet.svf);
    else if (this.value.textContent === "–" && facet.svf !== null) this.showValue(facet.svf, facet.svf.toFixed(3));
  }

  showAnswer(answer: PointAnswer, { facet }: Selection): void {
    this.value.classList.remove("stale");
    this.showValue(answer.svf, answer.text ?? "no data");
    const isBounded = answer.svf !== null && answer.low !== null && answer.high !== null;
    part("bounds").textContent = isBounded ? boundsText(answer) : "";
    const place = facet.kind === "ground" ? `${this.view.receiver_height_m} m above the ground` : "at this point of the surface";
    part("value-note").textContent = answer.svf === null ? (facet.isSimplified ? noAnswerFromAfar : noAnswer)
      : `Sky view factor ${place}${isBounded ? ", with certain bounds" : ""}. Computed in ${(1000 * answer.seconds).toFixed(1)} ms.`;
  }

  /** What went wrong stands where the value would. */
  showFailure(sentence: string): void {
    this.value.textContent = "–";
    part("bounds").textContent = "";
    part("value-note").textContent = sentence;
  }

  showHemisphere(hemisphere: Hemisphere | null, projection: SkyProjection): void {
    this.hemisphere = hemisphere;
    const shares = hemisphere ? sharesOf(hemisphere) : null;
    const rows = partNames.filter((name) => shares !== null && shares[name] > 0);
    const texts = rows.map((name) => `${partWords[name]} ${percent(shares?.[name] ?? 0)}`);
    const keys = rows.map((name, n) => keyRow("swatch", cssOf(partColours[name]), texts[n] ?? ""));
    if (shares) keys.push(keyRow("line-swatch", lineColours.horizon, "horizon"));
    part("sky-parts").replaceChildren(...keys);
    part("fisheye").setAttribute("aria-label", `Fisheye: ${shares ? texts.join(", ") : "no data"}`);
    this.redraw(projection);
  }

  redraw(projection: SkyProjection): void {
    if (this.hemisphere) this.fisheye.draw(this.hemisphere, projection);
    else this.fisheye.clear();
  }

  private showFacetAlone(svf: number | null): void {
    this.value.classList.remove("stale");
    this.showValue(svf, svf === null ? "no data" : svf.toFixed(3));
    part("value-note").textContent = "The value of the facet. These are exported files, without the program that would compute a point.";
  }

  private showValue(svf: number | null, text: string): void {
    this.value.textContent = text;
    part("value-mark").hidden = svf === null;
    if (svf !== null) part("value-mark").style.left = `${(100 * Math.min(1, Math.max(0, svf))).toFixed(2)}%`;
  }
}

/** With as many digits as the value. Between bounds that are rounded away from each other, the true value lies, too. */
function boundsText({ text, low, high }: PointAnswer): string {
  const digits = text?.split(".")[1]?.length ?? 4, unit = 10 ** -digits, least = low ?? 0, most = high ?? 1;
  if (least.toFixed(digits) === most.toFixed(digits)) return "certain to the last digit";
  return `between ${(unit * Math.floor(least / unit)).toFixed(digits)} and ${(unit * Math.ceil(most / unit)).toFixed(digits)}`;
}

const percent = (share: number): string => `${(100 * share).toFixed(1)} %`;

function keyRow(kind: string, colour: string, words: string): HTMLElement {
  const row = element("li"), swatch = element("span", kind);
  swatch.style.background = colour;
  row.append(swatch, words);
  return row;
}
