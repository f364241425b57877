// ---- Vectors, and triangles to draw

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const lengthOf = a => Math.sqrt(dot(a, a));
const unit = a => { const l = lengthOf(a); return l > 0 ? times(1 / l, a) : [0, 0, 1]; };

/// The product of 4 x 4 matrices in columns.
function product(a, b) {
  const c = new Float64Array(16);
  for (let i = 0; i < 4; ++i)
    for (let j = 0; j < 4; ++j)
      for (let k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
  return c;
}
function perspective(field, aspect, near, far) {
  const f = 1 / Math.tan(field / 2);
  return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
}
/// Looks along `ahead`; `right` and `up` are unit vectors across it.
function lookMatrix(eye, right, up, ahead) {
  return [right[0], up[0], -ahead[0], 0, right[1], up[1], -ahead[1], 0, right[2], up[2], -ahead[2], 0,
    -dot(right, eye), -dot(up, eye), dot(ahead, eye), 1];
}

function cornerOf(i) { return [polygons.corners[3 * i], polygons.corners[3 * i + 1], polygons.corners[3 * i + 2]]; }
function cornersOf(k) {
  const list = [];
  for (let i = polygons.first[k]; i < polygons.first[k + 1]; ++i) list.push(cornerOf(i));
  return list;
}

/// Fans of triangles. Of a corner three numbers say which of a triangle's sides are sides of its polygon, for outlines.
function trianglesOf() {
  let count = 0;
  for (let k = 0; k < polygons.count; ++k) count += polygons.first[k + 1] - polygons.first[k] - 2;
  const places = new Float32Array(9 * count), sides = new Uint8Array(12 * count);
  const of = new Uint32Array(count), first = new Uint32Array(polygons.count + 1), shade = new Float32Array(polygons.count);
  const light = unit([-0.45, -0.65, 0.8]), from = polygons.corners;
  let t = 0;
  for (let k = 0; k < polygons.count; ++k) {
    const begin = polygons.first[k], n = polygons.first[k + 1] - begin;
    first[k] = t;
    let nx = 0, ny = 0, nz = 0;
    for (let i = 1; i + 1 < n; ++i, ++t) {
      const corners = [begin, begin + i, begin + i + 1];
      for (let c = 0; c < 3; ++c) {
        for (let x = 0; x < 3; ++x) places[9 * t + 3 * c + x] = from[3 * corners[c] + x];
        sides[12 * t + 4 * c] = c === 0 ? 255 : 0;
        sides[12 * t + 4 * c + 1] = c === 1 || i + 1 < n - 1 ? 255 : 0;
        sides[12 * t + 4 * c + 2] = c === 2 || i > 1 ? 255 : 0;
      }
      of[t] = k;
      const p = 9 * t, ax = places[p + 3] - places[p], ay = places[p + 4] - places[p + 1], az = places[p + 5] - places[p + 2],
        bx = places[p + 6] - places[p], by = places[p + 7] - places[p + 1], bz = places[p + 8] - places[p + 2];
      nx += ay * bz - az * by, ny += az * bx - ax * bz, nz += ax * by - ay * bx;
    }
    const l = Math.sqrt(nx * nx + ny * ny + nz * nz);
    shade[k] = l > 0 ? (nx * light[0] + ny * light[1] + nz * light[2]) / l : 0;
  }
  first[polygons.count] = t;
  return {count, places, sides, of, first, shade};
}
const triangles = trianglesOf();

/// Corners of faces, which views are fitted to; sources may be far away. All corners where there is no face. And places that the page wants in view.
const framed = (function () {
  const list = [], all = corners => data.around ? Float32Array.from([...corners, ...unpacked(data.around)]) : corners;
  for (let k = 0; k < polygons.count; ++k) if (polygons.faces[k] === noFace) list.push(k);
  if (list.length === 0 || list.length === polygons.count) return all(polygons.corners);
  const kept = [];
  for (let k = 0; k < polygons.count; ++k)
    if (polygons.faces[k] !== noFace) for (let i = 3 * polygons.first[k]; i < 3 * polygons.first[k + 1]; ++i) kept.push(polygons.corners[i]);
  return all(Float32Array.from(kept));
}());

/// The box of these corners: its middle, half its diagonal; and how far from the middle there is anything, up to a hundred times that.
function boundsOf() {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < framed.length; ++i) {
    const k = i % 3;
    if (framed[i] < least[k]) least[k] = framed[i];
    if (framed[i] > most[k]) most[k] = framed[i];
  }
  if (framed.length === 0) return {middle: [0, 0, 0], radius: 0.5, reach: 0.5};
  const middle = times(0.5, add(least, most)), radius = Math.max(1e-3, 0.5 * lengthOf(minus(most, least)));
  let reach = radius;
  for (let i = 0; i < polygons.corners.length; i += 3) reach = Math.max(reach, Math.hypot(polygons.corners[i] - middle[0], polygons.corners[i + 1] - middle[1], polygons.corners[i + 2] - middle[2]));
  return {middle, radius, reach: Math.min(reach, 100 * radius)};
}
const bounds = boundsOf();
