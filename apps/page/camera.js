// ---- Where one looks from

const usualAway = data.away || unit([-0.6, -1.1, 0.7]);  // as the program's own pictures
/// From the eye one turns the look; else one goes round a point. `isMoved`: by hand or by keys, since it was set.
const camera = {atEye: false, target: [0, 0, 0], distance: 1, yaw: 0, pitch: 0, field: 45, isMoved: false};

/// Far away a place is as good at a thousand times the scene's size.
function eyeFor(place) {
  const away = minus(place, bounds.middle), far = 1000 * bounds.radius;
  return lengthOf(away) > far ? add(bounds.middle, times(far, unit(away))) : place;
}
let eyePlace = data.eye && data.eye.place ? eyeFor(data.eye.place) : null;

/// The direction from the target, or from the eye: yaw about z, pitch upwards.
function direction() {
  const c = Math.cos(camera.pitch);
  return [c * Math.cos(camera.yaw), c * Math.sin(camera.yaw), Math.sin(camera.pitch)];
}
function setDirection(d) {
  const u = unit(d);
  camera.yaw = Math.atan2(u[1], u[0]);
  camera.pitch = Math.max(-1.5706, Math.min(1.5706, Math.asin(Math.max(-1, Math.min(1, u[2])))));
}
function goRound() {
  camera.isMoved = camera.atEye = false;
  camera.target = bounds.middle.slice();
  camera.field = 40;
  camera.distance = 1.05 * bounds.radius / Math.sin(camera.field * Math.PI / 360);
  setDirection(usualAway);
  for (let round = 0; round < 4; ++round) {  // until all corners fill the canvas
    const d = direction(), seen = extent(add(camera.target, times(camera.distance, d)), times(-1, d));
    if (!seen) return;
    camera.target = add(camera.target, add(times(seen.x * camera.distance, seen.right), times(seen.y * camera.distance, seen.up)));
    // No corner comes closer than by nine tenths: what is long and thin along the look would end behind it.
    camera.distance = Math.max(camera.distance - 0.9 * seen.depth, camera.distance * Math.max(0.3, 1.12 * seen.half / Math.tan(camera.field * Math.PI / 360)));
  }
}
/// The tangents that hold all corners as seen from a place: their middle, and half of what they span, in heights of the canvas; and how far the nearest corner is.
function extent(place, ahead) {
  const [right, up] = across(ahead), least = [Infinity, Infinity], most = [-Infinity, -Infinity], from = framed;
  let nearest = Infinity;
  for (let i = 0; i < from.length; i += 3) {
    const v = minus([from[i], from[i + 1], from[i + 2]], place), depth = dot(v, ahead);
    if (depth <= 0) return null;
    if (depth < nearest) nearest = depth;
    const x = dot(v, right) / depth, y = dot(v, up) / depth;
    if (x < least[0]) least[0] = x;
    if (x > most[0]) most[0] = x;
    if (y < least[1]) least[1] = y;
    if (y > most[1]) most[1] = y;
  }
  if (least[0] > most[0]) return null;
  return {right, up, depth: nearest, x: (least[0] + most[0]) / 2, y: (least[1] + most[1]) / 2, half: Math.max((most[1] - least[1]) / 2, (most[0] - least[0]) / 2 / aspect(), 1e-4)};
}
/// To the command's eye, with all of the scene in view where that is within 100 degrees.
function goToEye() {
  if (!eyePlace) return goRound();
  camera.isMoved = false;
  camera.atEye = true;
  const ahead = minus(bounds.middle, eyePlace), distance = lengthOf(ahead);
  if (distance > 0) setDirection(ahead);
  camera.yaw += 0.011, camera.pitch += camera.pitch > 0 ? -0.007 : 0.007;  // along no axis, and not over the top
  camera.field = 85;
  if (distance > 1.3 * bounds.radius) tighten();
}
/// Turns to the middle of what is seen, and takes the least field that holds all corners.
function tighten() {
  for (let round = 0; round < 3; ++round) {
    const ahead = direction(), seen = extent(eyePlace, ahead);
    if (!seen) return;
    setDirection(add(ahead, add(times(seen.x, seen.right), times(seen.y, seen.up))));
    camera.field = Math.min(110, 2 * Math.atan(1.08 * seen.half) * 180 / Math.PI);
  }
}
function aspect() { return Math.max(0.2, canvas.clientWidth / Math.max(1, canvas.clientHeight)); }
/// Unit vectors to the right and upwards of one who looks that way, which is never straight up or down.
function across(ahead) {
  const right = unit(cross(ahead, [0, 0, 1]));
  return [right, cross(right, ahead)];
}
function cameraFrame() {
  const d = direction(), ahead = camera.atEye ? d : times(-1, d);
  const place = camera.atEye ? eyePlace : add(camera.target, times(camera.distance, d));
  const [right, up] = across(ahead);
  const toMiddle = dot(minus(bounds.middle, place), ahead), beyond = bounds.reach + 1.2 * bounds.radius, far = toMiddle + beyond;
  const near = Math.max(toMiddle - beyond, 1e-4 * bounds.radius);
  const matrix = product(perspective(camera.field * Math.PI / 180, aspect(), near, Math.max(far, 2 * near)), lookMatrix(place, right, up, ahead));
  return {place, ahead, right, up, matrix, near};
}
/// The ray through a point of the canvas, from -1 to 1.
function rayThrough(x, y) {
  const frame = cameraFrame(), t = Math.tan(camera.field * Math.PI / 360);
  return {from: frame.place, along: unit(add(frame.ahead, add(times(x * t * aspect(), frame.right), times(y * t, frame.up))))};
}
/// A place on the canvas in pixels, or null behind the one who looks.
function onCanvas(p, frame) {
  const m = frame.matrix, w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
  if (w <= frame.near) return null;
  const x = (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12]) / w, y = (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13]) / w;
  return [(x + 1) / 2 * canvas.clientWidth, (1 - y) / 2 * canvas.clientHeight];
}

// ---- By hand and by keys

/// The scene goes with the hand: by so many radians to the right, and downwards; from the eye, where the field is 60 degrees.
function turn(right, down) {
  const s = camera.atEye ? camera.field / 60 : 1;
  camera.isMoved = true;
  camera.yaw += camera.atEye ? s * right : -right;
  camera.pitch = Math.max(-1.5706, Math.min(1.5706, camera.pitch + s * down));
  redraw();
}
function closer(factor) {
  camera.isMoved = true;
  if (camera.atEye) camera.field = Math.max(0.5, Math.min(120, camera.field / factor));
  else camera.distance = Math.max(1e-3 * bounds.radius, Math.min(60 * bounds.radius, camera.distance / factor));
  redraw();
}
function shift(right, down) {
  if (camera.atEye) return turn(right, down);
  camera.isMoved = true;
  const frame = cameraFrame(), s = camera.distance * Math.tan(camera.field * Math.PI / 360) * 2;
  camera.target = add(camera.target, add(times(-right * s * aspect(), frame.right), times(down * s, frame.up)));
  redraw();
}

function listenToHands() {
  const pointers = new Map();
  let moved = 0, pinch = 0;
  const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('pointerdown', e => {
    canvas.setPointerCapture(e.pointerId);
    pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
    if (pointers.size === 1) moved = 0;
    if (pointers.size === 2) pinch = spread();
    canvas.classList.add('turning');
  });
  canvas.addEventListener('pointermove', e => {
    const before = pointers.get(e.pointerId);
    if (!before) return hoverAt(e.offsetX, e.offsetY);
    const dx = e.offsetX - before[0], dy = e.offsetY - before[1];
    pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
    moved += Math.abs(dx) + Math.abs(dy);
    if (moved < 4) return;
    const w = canvas.clientWidth, h = canvas.clientHeight;
    if (pointers.size === 2) {
      const now = spread();
      if (pinch > 0 && now > 0) closer(now / pinch);
      pinch = now;
      shift(dx / w / 2, dy / h / 2);
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) shift(dx / w, dy / h);
    else {
      const s = camera.atEye ? Math.PI / 3 : 3.2;  // from the eye a field of view in a canvas
      turn(s * dx / h, s * dy / h);
    }
  });
  const up = e => {
    if (!pointers.delete(e.pointerId)) return;
    if (pointers.size === 0) canvas.classList.remove('turning');
    if (e.type === 'pointerup' && pointers.size === 0 && moved < 4 && e.button === 0) clickAt(e.offsetX, e.offsetY);
  };
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('pointerleave', () => hoverAt(-1, -1));
  canvas.addEventListener('contextmenu', e => e.preventDefault());
  canvas.addEventListener('wheel', e => { e.preventDefault(); closer(Math.exp(-0.0015 * e.deltaY)); }, {passive: false});
}

/// Keys of all pages, and those that a command adds.
const keys = {
  ArrowLeft: () => turn(0.08, 0), ArrowRight: () => turn(-0.08, 0), ArrowUp: () => turn(0, 0.06), ArrowDown: () => turn(0, -0.06),
  '+': () => closer(1.15), '=': () => closer(1.15), '-': () => closer(1 / 1.15),
  Home: () => { home(); redraw(); },
};
function listenToKeys() {
  document.addEventListener('keydown', e => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const isSlider = e.target.type === 'range';
    const isButton = e.target.tagName === 'BUTTON' || e.target.tagName === 'SUMMARY' || e.target.type === 'checkbox';
    if ((isSlider && /^(Arrow|Page|Home|End)/.test(e.key)) || (isButton && (e.key === ' ' || e.key === 'Enter'))) return;
    const act = keys[e.key];
    if (!act) return;
    e.preventDefault();
    act();
  });
}
