// @ts-check
// Secret that the server requires in requests for frames.

/** The secret of this page's server, from the page's own address; empty in a file. */
const SECRET = new URLSearchParams(globalThis.location?.search ?? "").get("token") ?? "";

/**
 * Address on the server with the secret.
 * @param {string} address
 */
export function secured(address) {
  return `${address}${address.includes("?") ? "&" : "?"}token=${encodeURIComponent(SECRET)}`;
}
