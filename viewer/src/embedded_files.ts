// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

/**
 * The files that a page of `--export NAME.html` carries, each in an element `<script type="text/plain" data-file="NAME">`,
 * compressed by gzip and in base64: a browser fetches nothing from a disk. Any other page has none.
 */
export const hasEmbeddedFiles = document.querySelector("script[data-file]") !== null;

/** Answers as a server with these files would. */
export async function embeddedAnswer(url: string): Promise<Response> {
  const name = nameOf(url), element = document.querySelector(`script[data-file="${CSS.escape(name)}"]`);
  if (!element) return Response.json({ error: `This page has no ${name}; export it again.` }, { status: 404 });
  const packed = new Blob([bytesOf(element.textContent ?? "")]);
  return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip")));
}

/** Relative to the folder in which the page lies, and without a query. */
function nameOf(url: string): string {
  const folder = new URL(".", document.baseURI).pathname, { pathname } = new URL(url, document.baseURI);
  return pathname.startsWith(folder) ? pathname.slice(folder.length) : pathname;
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const binary = atob(base64), bytes = new Uint8Array(binary.length);
  for (let n = 0; n < bytes.length; ++n) bytes[n] = binary.charCodeAt(n);
  return bytes;
}
