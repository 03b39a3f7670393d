// @ts-check
// The secret that the page's server wants for everything that tells of frames.

/** The secret of this page's server, from the page's own address; empty in a file. */
const SECRET = new URLSearchParams(globalThis.location?.search ?? "").get("token") ?? "";

/**
 * An address of the server with the secret, which it wants for all that tells of frames.
 * @param {string} address
 */
export function secured(address) {
  return `${address}${address.includes("?") ? "&" : "?"}token=${encodeURIComponent(SECRET)}`;
}
