// The geometry of the picture: what is left of it, drawn together, and lines.
/** @import {Point, Rectangle} from "./data.js" */

const CORNER = 6;
const ARROW = 7;
const AIR = { box: 10, line: 5 };

/**
 * Takes the room out of the picture that nothing shown stands in, without changing any order.
 * @param {Rectangle[]} boxes
 * @param {Point[]} points of lines
 * @returns {{x: (value: number) => number, y: (value: number) => number, width: number, height: number}}
 */
export function drawnTogether(boxes, points) {
  /** @type {{x: Point[], y: Point[]}} */
  const taken = { x: [], y: [] };
  for (const box of boxes) {
    taken.x.push([box.x - AIR.box, box.x + box.width + AIR.box]);
    taken.y.push([box.y - AIR.box, box.y + box.height + AIR.box]);
  }
  for (const [x, y] of points) {
    taken.x.push([x - AIR.line, x + AIR.line]);
    taken.y.push([y - AIR.line, y + AIR.line]);
  }
  const [x, width] = closedUp(taken.x);
  const [y, height] = closedUp(taken.y);
  return { x, y, width, height };
}

/**
 * @param {Point[]} intervals
 * @returns {[place: (value: number) => number, length: number]}
 */
function closedUp(intervals) {
  /** @type {{from: number, to: number, at: number}[]} */
  const merged = [];
  for (const [from, to] of intervals.sort((a, b) => a[0] - b[0])) {
    const last = merged.at(-1);
    if (last && from <= last.to) {
      last.to = Math.max(last.to, to);
    } else {
      merged.push({ from, to, at: 0 });
    }
  }
  let end = 0;
  for (const each of merged) {
    each.at = end;
    end += each.to - each.from;
  }
  return [
    (value) => {
      const inside = merged.find((each) => value <= each.to);
      return inside === undefined ? end : Math.round((inside.at + Math.max(0, value - inside.from)) * 10) / 10;
    },
    end,
  ];
}

/**
 * The paths of a line with rounded corners and of its arrow, as `outline` in svg.py.
 * @param {Point[]} points at least two
 * @returns {[line: string, arrow: string]}
 */
export function outline(points) {
  const tip = points[points.length - 1];
  const [x, y] = points[points.length - 2];
  const length = Math.hypot(tip[0] - x, tip[1] - y) || 1;
  const [dx, dy] = [(tip[0] - x) / length, (tip[1] - y) / length];
  /** @type {Point} */
  const neck = [tip[0] - dx * Math.min(ARROW, length), tip[1] - dy * Math.min(ARROW, length)];
  /** @type {(from: Point, to: Point) => Point} */
  const towards = ([fromX, fromY], [toX, toY]) => {
    const far = Math.hypot(toX - fromX, toY - fromY) || 1;
    const part = Math.min(CORNER, far / 2) / far;
    return [fromX + (toX - fromX) * part, fromY + (toY - fromY) * part];
  };
  /** @type {(point: Point) => string} */
  const at = ([pointX, pointY]) => `${Math.round(pointX * 10) / 10} ${Math.round(pointY * 10) / 10}`;
  let line = `M${at(points[0])}`;
  for (let i = 1; i < points.length - 1; i += 1) {
    const after = i + 2 < points.length ? points[i + 1] : neck;
    line += `L${at(towards(points[i], points[i - 1]))}Q${at(points[i])} ${at(towards(points[i], after))}`;
  }
  const half = ARROW / 2;
  /** @type {[Point, Point]} */
  const sides = [
    [neck[0] - dy * half, neck[1] + dx * half],
    [neck[0] + dy * half, neck[1] - dx * half],
  ];
  return [`${line}L${at(neck)}`, `M${at(tip)}L${at(sides[0])}L${at(sides[1])}z`];
}
