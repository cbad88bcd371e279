// Rectangles side by side in two dimensions, as `pack` in packing.py.
/** @import {Point} from "./data.js" */

const WIDTHS = [0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.35, 1.5, 1.8];
const NO_MORE = 0.1;

/**
 * The upper left corner of each rectangle, and the extent of all, such that it is shown as large as possible in a window
 * that is `aspect` times as wide as high.
 * @param {Point[]} sizes
 * @param {number} aspect
 * @param {number} gap
 * @returns {{corners: Point[], width: number, height: number}}
 */
export function pack(sizes, aspect, gap) {
  const order = sizes.map((_, i) => i).sort((a, b) => sizes[b][1] - sizes[a][1] || a - b);
  const widest = Math.max(0, ...sizes.map(([width]) => width));
  const room = sizes.reduce((sum, [width, height]) => sum + (width + gap) * (height + gap), 0);
  const ideal = Math.sqrt(room * aspect);
  let best = { corners: /** @type {Point[]} */ ([]), width: 0, height: 0, needed: Number.POSITIVE_INFINITY };
  for (const limit of [widest, ...WIDTHS.map((share) => Math.max(widest, ideal * share))]) {
    const corners = within(sizes, order, limit, gap);
    const width = Math.max(0, ...corners.map(([x], i) => x + sizes[i][0]));
    const height = Math.max(0, ...corners.map(([, y], i) => y + sizes[i][1]));
    const needed = Math.max(width / aspect, height);
    if (needed < best.needed - NO_MORE) {
      best = { corners, width, height, needed };
    }
  }
  return best;
}

/** @type {(sizes: Point[], order: number[], limit: number, gap: number) => Point[]} */
function within(sizes, order, limit, gap) {
  /** @type {[start: number, end: number, top: number][]} From where to where, and below what: what is taken so far. */
  let skyline = [[0, limit, 0]];
  /** @type {Point[]} */
  const corners = [];
  for (const i of order) {
    const [width, height] = sizes[i];
    /** @type {Point | undefined} */
    let best;
    for (const [x] of skyline) {
      if (best !== undefined && x + width > limit) {
        break;
      }
      const below = skyline.filter(([start, end]) => start < x + width + gap && end > x);
      const y = Math.max(...below.map(([, , top]) => top));
      if (best === undefined || y < best[1] - NO_MORE) {
        best = [x, y];
      }
    }
    const [x, y] = /** @type {Point} */ (best);
    corners[i] = [x, y];
    const right = Math.min(limit, x + width + gap);
    skyline = skyline.flatMap(([start, end, top]) =>
      /** @type {typeof skyline} */ ([
        [start, Math.min(end, x), top],
        [Math.max(start, right), end, top],
      ]).filter(([from, to]) => from < to),
    );
    skyline.push([x, right, y + height + gap]);
    skyline.sort((a, b) => a[0] - b[0]);
  }
  return corners;
}
