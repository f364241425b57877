// ---- The page's data, as arrays

const data = JSON.parse(document.getElementById('data').textContent);
const noFace = 0xffffffff;

/// Numbers that were packed in few bytes.
function unpacked(from) {
  const bytes = Uint8Array.from(atob(from.base64), c => c.charCodeAt(0));
  const types = {u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array};
  return new types[from.type](bytes.buffer);
}
function bit(bytes, i) { return bytes[i >> 3] >> (i & 7) & 1; }

/// Convex polygons: corners of the k-th are first[k] up to first[k + 1]; number[k] is its place among all that the command has.
function readPolygons() {
  const from = data.polygons, sizes = unpacked(from.sizes), count = from.count;
  const first = new Uint32Array(count + 1);
  for (let k = 0; k < count; ++k) first[k + 1] = first[k] + sizes[k];
  const faces = unpacked(from.faces);
  let corners = unpacked(from.corners);
  if (from.step) {
    const steps = corners, others = from.others ? unpacked(from.others) : null;
    corners = new Float32Array(3 * first[count]);
    let s = 0, o = 0;
    for (let k = 0; k < count; ++k)
      for (let i = 3 * first[k]; i < 3 * first[k + 1]; ++i) corners[i] = others && faces[k] === noFace ? others[o++] : from.from[i % 3] + from.step[i % 3] * steps[s++];
  }
  const number = from.numbers ? unpacked(from.numbers) : null;
  const placeOf = number ? new Map(Array.from(number, (n, k) => [n, k])) : null;
  return {
    count, of: from.of, first, corners, faces,
    groups: from.groups ? unpacked(from.groups) : new Uint8Array(count),
    exact: from.exact ? {texts: from.exact.texts, corners: unpacked(from.exact.corners)} : null,
    /// The place among all of the k-th here; and back: undefined where it is not drawn.
    number: k => number ? number[k] : k,
    place: n => placeOf ? placeOf.get(n) : n < count ? n : undefined,
  };
}
const polygons = readPolygons();

/// Coordinates of the file, rounded as the page's places are: seven digits of the scene's size, before them those of where it is.
function rounded(place) {
  const {middle, size} = data.frame;
  const digits = k => 7 + Math.max(0, Math.ceil(Math.log10(Math.abs(middle[k]) / size)) || 0);
  return place.map((x, k) => Number((middle[k] + size * x).toPrecision(Math.min(17, digits(k))))).join(', ');
}
