// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
import { embeddedAnswer, hasEmbeddedFiles } from "./embedded_files.ts";
import type { CellIndex, Triple } from "./view_info.ts";

/** Nothing answers at the address of the page. */
export class ServerSilent extends Error {
  constructor() {
    super("The server does not answer; start farlod-view again.");
  }
}

/** The server says what is wrong, in a sentence. */
export class ServerRefused extends Error {
  readonly status: number;
  constructor(status: number, sentence: string) {
    super(sentence);
    this.status = status;
  }
}

export interface PointAnswer {
  /** null where there is no data, as inside of a building. */
  svf: number | null;
  /** The value with the digits that farlod-svf writes. */
  text: string | null;
  low: number | null;
  high: number | null;
  x_m: number;
  y_m: number;
  z_m: number;
  cell: CellIndex | null;
  seconds: number;
}

/** What a point sees above the horizontal, in parts of a quarter of a degree. */
export interface Hemisphere {
  /** By azimuth, clockwise from true north; each from the horizontal upwards. */
  parts: Uint8Array;
  /** Of each azimuth, the tangent of the elevation above which all is sky. */
  slopes: Float32Array;
}
export const azimuthsOfHemisphere = 1440;
export const elevationsOfHemisphere = 360;

/** From one local point to another. */
export type FarEdge = [number, number, number, number, number, number];

export interface FarView {
  eye_m: Triple;
  first_azimuth_deg: number;
  low: number[];
  estimate: number[];
  high: number[];
  edges: FarEdge[];
}

export interface CellFacts {
  cell: CellIndex;
  corners_m: [number, number][];
  triangles: number;
  vertices: number;
  buildings: number;
  grounded_edges: number;
  overhang_edges: number;
  tile_bytes: number;
  far_map_bytes: number;
  explicit_edges: number;
  neighborhood: { i_begin: number; j_begin: number; i_end: number; j_end: number };
  near_cells: { cell: CellIndex; triangles: number }[];
  low_m: number | null;
  high_m: number | null;
  far: FarView | null;
}

/** A receiver in projected metres. Without a height it stands above the ground, as those of a map do. */
export interface Receiver {
  x_m: number;
  y_m: number;
  z_m?: number;
  azimuth_deg?: number;
  tilt_deg?: number;
}

/** Fetches, and tells the two things that go wrong apart. */
export async function fetchOfServer(url: string, options: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = hasEmbeddedFiles ? await embeddedAnswer(url) : await fetch(url, options);
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new ServerSilent();
  }
  if (!response.ok) throw new ServerRefused(response.status, await sentenceOf(response));
  return response;
}

async function sentenceOf(response: Response): Promise<string> {
  try {
    const answer = (await response.json()) as { error?: unknown };
    if (typeof answer.error === "string") return answer.error;
  } catch {
    // Not an answer of farlod-view; its status has to do
  }
  return `${new URL(response.url).pathname} gave the status ${response.status}.`;
}

export async function fetchJson<T>(path: string): Promise<T> {
  const response = await fetchOfServer(path);
  return (await response.json()) as T;
}

function queryOf(receiver: Receiver): string {
  const query = new URLSearchParams({ x: receiver.x_m.toFixed(4), y: receiver.y_m.toFixed(4) });
  if (receiver.z_m !== undefined) query.set("z", receiver.z_m.toFixed(4));
  return query.toString();
}

export function askAt(receiver: Receiver): Promise<PointAnswer> {
  let query = queryOf(receiver);
  if (receiver.azimuth_deg !== undefined && receiver.tilt_deg !== undefined)
    query += `&azimuth=${receiver.azimuth_deg.toFixed(4)}&tilt=${receiver.tilt_deg.toFixed(4)}`;
  return fetchJson<PointAnswer>(`at?${query}`);
}

/** null where a point has no answer. */
export async function askHemisphere(receiver: Receiver): Promise<Hemisphere | null> {
  const response = await fetchOfServer(`hemisphere?${queryOf(receiver)}`);
  if (response.status === 204) return null;
  const bytes = await response.arrayBuffer(), split = azimuthsOfHemisphere * elevationsOfHemisphere;
  if (bytes.byteLength !== split + 4 * azimuthsOfHemisphere)
    throw new Error(`A hemisphere of ${bytes.byteLength} bytes is not what this page knows.`);
  return { parts: new Uint8Array(bytes, 0, split), slopes: new Float32Array(bytes, split) };
}

export const askCell = (cell: CellIndex): Promise<CellFacts> => fetchJson<CellFacts>(`cell?i=${cell[0]}&j=${cell[1]}`);
