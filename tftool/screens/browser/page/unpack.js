// @ts-check
// Starts a saved page: inflates its data, then runs the page's script.
import { inflated } from "./packed.js";

async function begin() {
  const text = atob(document.getElementById("packed")?.textContent ?? "");
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
  return inflated(new Blob([bytes]));
}

begin().then(
  (packed) => {
    Object.assign(globalThis, { tftoolPacked: packed });
    const [offset, length] = packed.header.script;
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(packed.bytes.subarray(offset, offset + length));
    document.body.append(script);
  },
  (error) => {
    const empty = document.getElementById("empty");
    if (!empty) return;
    empty.hidden = false;
    empty.textContent = `This browser cannot unpack the frames in this file: ${error.message}`;
  },
);
