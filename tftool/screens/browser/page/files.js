// @ts-check
// Meshes and textures, from our server or from the saved page.
import { DefaultLoadingManager } from "three";
import { secured } from "./secret.js";

/** @type {Map<string, Blob> | null} */
let kept = null;

// The loaders of three.js also load the textures and buffers that a mesh refers to.
DefaultLoadingManager.setURLModifier((address) =>
  /^(data|blob):/.test(address) ? address : secured(address),
);

/**
 * From now on, take all files from the saved page, and load nothing else.
 * @param {import("./packed.js").Packed} packed
 */
export function keepFiles(packed) {
  kept = new Map(
    packed.header.files.map(({ address, kind, content }) => [
      address,
      new Blob([/** @type {Uint8Array<ArrayBuffer>} */ (packed.section(content))], { type: kind }),
    ]),
  );
  DefaultLoadingManager.setURLModifier((address) => {
    if (/^(data|blob):/.test(address)) return address;
    const found = kept?.get(new URL(address, "http://page/").pathname);
    return found ? URL.createObjectURL(found) : "data:,";
  });
}

/** @param {string} address */
export async function fetchFile(address) {
  if (!kept) return fetch(secured(address));
  const found = kept.get(address);
  return found ? new Response(found) : new Response("it is not in this file", { status: 404 });
}
