// Lines and places of features, metres, y north. Nothing is changed in place.

export const round = (metres) => Math.round(metres * 1000) / 1000 + 0;
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
export const moved = ([x, y, ...rest], by) => [round(x + by[0]), round(y + by[1]), ...rest];
const isPosition = (p) => Array.isArray(p) && Number.isFinite(p[0]) && Number.isFinite(p[1]);

// Return a feature's lines of positions, rings without their last one; none where it is broken.
export function linesOf(feature) {
  const { type, coordinates } = feature?.geometry ?? {};
  const lines = { Polygon: coordinates, LineString: [coordinates], Point: [[coordinates]] }[type];
  const isSound = (line) => Array.isArray(line) && line.length > 0 && line.every(isPosition);
  if (!Array.isArray(lines) || !lines.every(isSound)) return [];
  const isClosed = (ring) => ring.length > 1 && distance(ring[0], ring.at(-1)) === 0;
  return lines.map((line) => (type === "Polygon" && isClosed(line) ? line.slice(0, -1) : line));
}

// Return a feature with other lines, and with the properties that follow from them.
export function withLines(feature, lines) {
  const type = feature.geometry.type;
  const closed = () => lines.map((ring) => [...ring, ring[0]]);
  const coordinates = type === "Polygon" ? closed() : type === "Point" ? lines[0][0] : lines[0];
  const changed = { ...feature, geometry: { ...feature.geometry, coordinates } };
  if (typeof feature.properties?.length_m === "number" && type === "LineString") {
    changed.properties = { ...feature.properties, length_m: round(lengthOf(lines[0])) };
  }
  return changed;
}

export const lengthOf = (line) =>
  line.slice(1).reduce((sum, place, n) => sum + distance(line[n], place), 0);

export const sidesOf = (feature) => {
  const isClosed = feature?.geometry?.type === "Polygon";
  return linesOf(feature).flatMap((line) =>
    line.slice(isClosed ? 0 : 1).map((place, n) => [line.at(n - (isClosed ? 1 : 0)), place]));
};

// Return the middle of a feature's box.
export function middleOf(feature) {
  const places = linesOf(feature).flat();
  if (!places.length) return null;
  const [x, y] = [0, 1].map((axis) => places.map((place) => place[axis]));
  return [(Math.min(...x) + Math.max(...x)) / 2, (Math.min(...y) + Math.max(...y)) / 2];
}

export function nearestOn(place, [start, end]) {
  const along = [end[0] - start[0], end[1] - start[1]];
  const squared = along[0] ** 2 + along[1] ** 2 || 1;
  const part = ((place[0] - start[0]) * along[0] + (place[1] - start[1]) * along[1]) / squared;
  const within = Math.min(1, Math.max(0, part));
  return [start[0] + within * along[0], start[1] + within * along[1]];
}

export function corridorAlong(start, end, width) {
  const half = width / 2 / (distance(start, end) || 1);
  const left = [(start[1] - end[1]) * half, (end[0] - start[0]) * half];
  const right = [-left[0], -left[1]];
  return [moved(start, right), moved(end, right), moved(end, left), moved(start, left)];
}

// Return the middle line of four corners, between their two short ends, and the width.
export function middleLine([a, b, c, d]) {
  const half = (one, other) => [(one[0] + other[0]) / 2, (one[1] + other[1]) / 2];
  const isShort = distance(a, b) + distance(c, d) <= distance(b, c) + distance(d, a);
  const [start, end] = isShort ? [half(a, b), half(c, d)] : [half(b, c), half(d, a)];
  const cross = (p, q) => p[0] * q[1] - q[0] * p[1];
  const area = Math.abs(cross(a, b) + cross(b, c) + cross(c, d) + cross(d, a)) / 2;
  return { start, end, width: round(area / (distance(start, end) || 1)) };
}

export const rectangle = ([a, b], [c, d]) => {
  const [west, east, south, north] = [Math.min(a, c), Math.max(a, c), Math.min(b, d), Math.max(b, d)];
  return [[west, south], [east, south], [east, north], [west, north]];
};

// Return the corners of a thing's footprint: its length lies across the way its front faces.
export function footprint(place, [length, depth], degrees) {
  const turn = (degrees * Math.PI) / 180;
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  return [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([front, side]) => {
    const [u, v] = [(front * depth) / 2, (side * length) / 2];
    return [place[0] + u * cos - v * sin, place[1] + u * sin + v * cos];
  });
}

// Return a place moved onto a corner near it, else onto the axes of the places that it
// follows and onto a side; else onto a tenth of a metre.
export function snapped(place, { corners, sides, follows, reach }) {
  const near = (other) => distance(place, other) <= reach;
  const nearest = (found) => found.sort((a, b) => distance(place, a) - distance(place, b))[0];
  const corner = nearest(corners.filter(near));
  if (corner) return corner.slice(0, 2);
  const axis = [0, 1].map((n) => follows.map((each) => each[n])
    .find((value) => Math.abs(value - place[n]) <= reach));
  const crossings = sides.flatMap(([start, end]) => {
    const fixed = axis.findIndex((value) => value !== undefined);
    if (fixed < 0) return [nearestOn(place, [start, end])];
    const part = (axis[fixed] - start[fixed]) / (end[fixed] - start[fixed]);
    const other = start[1 - fixed] + part * (end[1 - fixed] - start[1 - fixed]);
    return part >= 0 && part <= 1 ? [fixed ? [other, axis[1]] : [axis[0], other]] : [];
  });
  const side = nearest(crossings.filter(near));
  return (side ?? place.map((value, n) => axis[n] ?? Math.round(value * 10) / 10)).map(round);
}
