// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/** The colours of farlod-svf's pictures of the sky: three steps of lightness that print keeps apart, and crowns between them. */
export const partColours = { sky: [205, 229, 248], near: [66, 66, 76], far: [230, 159, 0], crown: [0, 140, 100] } as const;
export const partNames = ["sky", "near", "far", "crown"] as const;
/** The horizon, and of the residual city what is hidden for certain, what is undecided, and the explicit edges. */
export const lineColours = { horizon: "#005493", hidden: "#e69f00", undecided: "#fadea0", edge: "#663e00" } as const;

export const cssOf = ([r, g, b]: readonly [number, number, number]): string => `rgb(${r} ${g} ${b})`;

export interface Paper {
  context: CanvasRenderingContext2D;
  /** In CSS pixels. */
  width: number;
  height: number;
  /** Pixels of the screen a CSS pixel. */
  ratio: number;
  ink: string;
  muted: string;
}

/** An empty sheet of the canvas' own size and of the theme's inks, with enough pixels for the screen. */
export function paperOf(canvas: HTMLCanvasElement, width: number, height: number): Paper {
  const ratio = Math.max(1, Math.min(3, window.devicePixelRatio)), style = getComputedStyle(document.documentElement);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  if (!context) throw new Error("This browser draws no pictures.");
  context.scale(ratio, ratio);
  const ofTheme = (name: string): string => style.getPropertyValue(name).trim();
  return { context, width, height, ratio, ink: ofTheme("--ink"), muted: ofTheme("--muted") };
}

export function drawText(paper: Paper, text: string, x: number, y: number, align: CanvasTextAlign, px: number,
                         colour = paper.ink, halo: string | null = null): void {
  paper.context.font = `${px}px system-ui, "Noto Sans", "DejaVu Sans", sans-serif`;
  paper.context.textAlign = align;
  paper.context.textBaseline = "middle";
  if (halo !== null) {
    paper.context.strokeStyle = halo;
    paper.context.lineWidth = 3;
    paper.context.lineJoin = "round";
    paper.context.strokeText(text, x, y);
  }
  paper.context.fillStyle = colour;
  paper.context.fillText(text, x, y);
}
