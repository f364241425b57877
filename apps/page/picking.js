// ---- Which polygon a ray meets

/// The first that is shown, or, where a painter paints, the last painted. Returns {polygon, place}, or null.
function pick(ray) {
  const p = triangles.places, [ox, oy, oz] = ray.from, [dx, dy, dz] = ray.along, last = drawing.painter && camera.atEye;
  let best = last ? -1 : Infinity, found = -1, at = 0;
  const end = triangles.first[Math.min(drawing.to, polygons.count)];
  for (let t = triangles.first[drawing.from]; t < end; ++t) {
    const i = 9 * t, ax = p[i], ay = p[i + 1], az = p[i + 2];
    const ux = p[i + 3] - ax, uy = p[i + 4] - ay, uz = p[i + 5] - az, vx = p[i + 6] - ax, vy = p[i + 7] - ay, vz = p[i + 8] - az;
    const hx = dy * vz - dz * vy, hy = dz * vx - dx * vz, hz = dx * vy - dy * vx, d = ux * hx + uy * hy + uz * hz;
    if (d === 0 || (!drawing.backs && d < 0)) continue;
    const sx = ox - ax, sy = oy - ay, sz = oz - az, a = (sx * hx + sy * hy + sz * hz) / d;
    if (a < -1e-7 || a > 1 + 1e-7) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux, b = (dx * qx + dy * qy + dz * qz) / d;
    if (b < -1e-7 || a + b > 1 + 1e-7) continue;
    const s = (vx * qx + vy * qy + vz * qz) / d, k = triangles.of[t];
    if (s <= 1e-7 || looks[4 * k + 3] === 0) continue;
    // What lies beneath gives way to what covers it.
    const far = last ? t : k < drawing.base ? s * (1 + 1e-5) + 1e-6 : s;
    if (last ? far < best : far >= best) continue;
    best = far, found = k, at = s;
  }
  return found < 0 ? null : {polygon: found, place: add(ray.from, times(at, ray.along))};
}

/// The ends of a line on the canvas, of what is before the one who looks; or null.
function endsOnCanvas(line, frame) {
  const near = 1.001 * frame.near, [a, b] = [line.from, line.to].map(p => dot(minus(p, frame.place), frame.ahead));
  if (a < near && b < near) return null;
  const end = (p, q, d, e) => onCanvas(d < near ? add(p, times((near - d) / (e - d), minus(q, p))) : p, frame);
  const ends = [end(line.from, line.to, a, b), end(line.to, line.from, b, a)];
  return ends[0] && ends[1] ? ends : null;
}
/// The line of a list within so many pixels of a place on the canvas, or -1.
function pickLine(list, x, y, within) {
  const frame = cameraFrame();
  let best = within, found = -1;
  list.forEach((line, i) => {
    const ends = endsOnCanvas(line, frame);
    if (!ends) return;
    const [a, b] = ends, dx = b[0] - a[0], dy = b[1] - a[1], l = dx * dx + dy * dy;
    const t = l > 0 ? Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / l)) : 0;
    const d = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y) + (line.dash ? 0.5 : 0);
    if (d < best) best = d, found = i;
  });
  return found;
}
