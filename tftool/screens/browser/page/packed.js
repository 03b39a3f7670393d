// @ts-check
// Data of a saved page; ../packing.py documents the layout.

/**
 * @typedef {[number, number]} Section offset and length, in bytes
 * @typedef {{ value: number } | { bits: Section } | { whole: Section, order: number, step: number }} Column
 * @typedef {{ name: string, authority: string | null, count?: number, static?: boolean,
 *   parents?: Column, poses?: Column[], stamps?: Column }} PackedFrame
 * @typedef {{ name: string, epoch: string, now: number, begin: number | null, view: string,
 *   rounded: boolean, total: number, frames: PackedFrame[], robot: any, marks: any, tracks?: import("./tracks.js").PackedTrack[], script: Section,
 *   files: { address: string, kind: string, content: Section }[] }} Header
 */

const MAGIC = 0x54465331; // "TFS1"

/**
 * Header of an inflated block, and the bytes of its sections.
 * @param {ArrayBuffer} block
 */
export function open(block) {
  const head = new DataView(block);
  if (!isBlock(block)) throw new Error("these are no packed frames");
  const length = head.getUint32(4, true);
  /** @type {Header} */
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(block, 8, length)));
  return { header, bytes: new Uint8Array(block, 8 + length) };
}

/**
 * Whether bytes are a block, not deflated.
 * @param {ArrayBuffer} block
 */
export const isBlock = (block) => block.byteLength >= 8 && new DataView(block).getUint32(0) === MAGIC;

/**
 * Inflate a block.
 * @param {Blob} blob
 */
export async function inflated(blob) {
  const stream = blob.stream().pipeThrough(new DecompressionStream("deflate"));
  return open(await new Response(stream).arrayBuffer());
}

export class Packed {
  /**
   * @param {Header} header
   * @param {Uint8Array} bytes
   */
  constructor(header, bytes) {
    this.header = header;
    this.bytes = bytes;
    /** @type {Map<string, Float64Array>} */
    this.known = new Map(); // columns that several links share
  }

  /** @param {Section} section */
  section([offset, length]) {
    return this.bytes.subarray(offset, offset + length);
  }

  /**
   * Numbers of a column that is read once.
   * @param {Column} column
   * @param {number} count
   */
  fresh(column, count) {
    if ("value" in column) return new Float64Array(count).fill(column.value);
    if ("bits" in column) return doubles(ordered(this.section(column.bits), count));
    return wholes(ordered(this.section(column.whole), count), column.order, column.step);
  }

  /**
   * Numbers of a column that several links may share.
   * @param {Column} column
   * @param {number} count
   * @returns {Float64Array}
   */
  column(column, count) {
    if ("value" in column) return this.fresh(column, count);
    const key = String(("bits" in column ? column.bits : column.whole)[0]);
    let numbers = this.known.get(key);
    if (!numbers) {
      numbers = this.fresh(column, count);
      this.known.set(key, numbers);
    }
    return numbers;
  }
}

/** Words of 64 bits, low half first, with bytes separated: all first bytes, all second bytes… */
function ordered(bytes, count) {
  const words = new Uint32Array(2 * count);
  for (let plane = 0; plane < 8; plane++) {
    const start = plane * count;
    const shift = 8 * (plane % 4);
    for (let at = 0, word = plane >> 2; at < count; at++, word += 2) words[word] |= bytes[start + at] << shift;
  }
  return words;
}

function doubles(words) {
  for (let at = 2; at < words.length; at++) words[at] ^= words[at - 2];
  return new Float64Array(words.buffer);
}

function wholes(words, order, step) {
  const numbers = new Float64Array(words.length / 2);
  for (let at = 0; at < numbers.length; at++) {
    const zigzag = words[2 * at + 1] * 2 ** 32 + words[2 * at];
    numbers[at] = words[2 * at] & 1 ? -(zigzag + 1) / 2 : zigzag / 2;
  }
  for (let time = 0; time < order; time++) {
    for (let at = 1; at < numbers.length; at++) numbers[at] += numbers[at - 1];
  }
  if (step !== 1) for (let at = 0; at < numbers.length; at++) numbers[at] *= step;
  return numbers;
}
