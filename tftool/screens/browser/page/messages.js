// @ts-check
// Written by `python -m tftool.screens.browser.page_messages` from its tables: change those.

/**
 * @typedef {{ type: "show", at: number | null }} ShowRequest
 * @typedef {{ type: "pair", target: string | null, source: string | null }} PairRequest
 * @typedef {{ type: "got", sequence: number }} GotRequest
 * @typedef {{ type: "move", joint: string, position: number }} MoveRequest
 * @typedef {{ type: "key", key: "up" | "down" | "left" | "right" }} KeyRequest
 * @typedef {{ type: "past" }} PastRequest
 * @typedef {{ type: "series", target: string, source: string, from: number, to: number, count: number }} SeriesRequest
 * @typedef {{ type: "trails", fixed: string, frames: string[], from: number, to: number, count: number }} TrailsRequest
 * @typedef {{ type: "marks" }} MarksRequest
 * @typedef {ShowRequest | PairRequest | GotRequest | MoveRequest | KeyRequest | PastRequest | SeriesRequest | TrailsRequest | MarksRequest} Request
 * @typedef {{ type: "frames", epoch: string, revision: number, names: string[], parents: number[], statics: number[], authorities: string[], total: number, rate: number, begin?: number }} FramesAnswer
 * @typedef {{ type: "pair", target: string, source: string, found: boolean, why?: string, stamp?: string, moment?: number | null, translation?: (number | null)[], rotation?: (number | null)[], rpy?: (number | null)[], chain?: string[] }} PairAnswer
 * @typedef {{ type: "robot", name: string, links: import("./robot.js").Link[], joints: { name: string, frame: string, axis: number[], slides: boolean }[], sliders: { name: string, unit: string, range: number[], position: number }[], motion: import("./kinematics.js").Joint[], missing: string[] }} RobotAnswer
 * @typedef {{ type: "range", now: number, oldest: number, newest: number }} RangeAnswer
 * @typedef {{ type: "series", target: string, source: string, times: number[], x: (number | null)[], y: (number | null)[], z: (number | null)[], roll: (number | null)[], pitch: (number | null)[], yaw: (number | null)[] }} SeriesAnswer
 * @typedef {{ type: "trails", fixed: string, from: number, to: number, places: Record<string, (number[] | null)[]> }} TrailsAnswer
 * @typedef {{ type: "marks", gaps: [string, number, number][], findings: { id: string, severity: string, message: string, since: number, until: number }[] }} MarksAnswer
 * @typedef {{ type: "tracks" }} TracksAnswer
 * @typedef {FramesAnswer | PairAnswer | RobotAnswer | RangeAnswer | SeriesAnswer | TrailsAnswer | MarksAnswer | TracksAnswer} Answer
 */

export const MAGIC = 0x54465031;
export const HEADER = 48; // bytes
export const FIELDS = 11; // numbers of a frame
export const FIELD = { x: 0, y: 1, z: 2, qx: 3, qy: 4, qz: 5, qw: 6, newest: 7, oldest: 8, rate: 9, samples: 10 };

/**
 * Head of a binary message with poses.
 * @param {DataView} view
 */
export const head = (view) => ({
  sequence: view.getUint32(4, true),
  revision: view.getUint32(8, true),
  count: view.getUint32(12, true),
  now: view.getFloat64(16, true),
  at: view.getFloat64(24, true),
  oldest: view.getFloat64(32, true),
  newest: view.getFloat64(40, true),
});
