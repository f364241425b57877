// ---- The page

/// What a command adds: each may be left out.
///   colourOf(k)        the colour of a polygon
///   begin(sections)    makes its sections
///   nameOf(k)          what hovering says after the face
///   select(k)          of a polygon that is clicked: what its section holds
///   clickAt(x, y)      a click that may be on something else than a polygon: whether it was
const command = (commands[data.command] || (() => ({})))();
const hiddenGroups = new Set();
let selected = -1;

/// Nothing where each face has a colour of its own.
function colourOfGroup(i) {
  const role = data.groups[i] ? data.groups[i].role : 'one a face';
  if (role === 'one a solid') return cycleColours[(i >> 1) % 6].map(c => c + (245 - c) * (i & 1 ? 0.55 : 0.2));
  return role === 'one a face' ? null : palette[role] || palette.face;
}
function colourOf(k) {
  if (command.colourOf) return command.colourOf(k);
  return colourOfGroup(polygons.groups[k]) || colourOfFace(polygons.faces[k]);
}
/// All polygons in their colours, lighter towards the light; `isShown` may leave some out.
function paint() {
  for (let k = 0; k < polygons.count; ++k) {
    const c = colourOf(k), s = 0.86 + 0.16 * triangles.shade[k];
    looks[4 * k] = Math.min(255, c[0] * s), looks[4 * k + 1] = Math.min(255, c[1] * s), looks[4 * k + 2] = Math.min(255, c[2] * s);
    looks[4 * k + 3] = hiddenGroups.has(polygons.groups[k]) || (command.isShown && !command.isShown(k)) ? 0 : 255;
  }
  looksChanged = true;
  redraw();
  if (command.sphereChanged) command.sphereChanged();
}

function faceName(k) {
  const face = polygons.faces[k], group = data.groups[polygons.groups[k]];
  if (face === noFace) return group ? group.name : 'no face';
  return `face ${face}`;
}
function fullName(k) {
  const group = data.groups[polygons.groups[k]], more = command.nameOf ? command.nameOf(k) : '';
  return faceName(k) + (group && data.groups.length > 1 && !command.groupsChange && polygons.faces[k] !== noFace ? `: ${group.name}` : '') + (more ? `, ${more}` : '');
}

// ---- Hovering and clicking

const hover = document.getElementById('hover');
let hovering = null;
function hoverAt(x, y) {
  const first = hovering === null;
  hovering = [x, y];
  if (!first) return;
  requestAnimationFrame(() => {
    const [hx, hy] = hovering;
    hovering = null;
    const hit = hx < 0 ? null : pick(rayAt(hx, hy));
    hover.textContent = hit ? fullName(hit.polygon) : '';
  });
}
function rayAt(x, y) { return rayThrough(2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight); }
function clickAt(x, y) {
  canvas.focus({preventScroll: true});
  if (command.clickAt && command.clickAt(x, y)) return;
  const hit = pick(rayAt(x, y));
  select(hit ? hit.polygon : -1, hit ? hit.place : null);
}

const selection = element('section', {id: 'selection', tabIndex: -1});
/// The outlines of polygons, before all else.
function outlinesOf(list, colour, width = 2.5) {
  const lines = [];
  for (const k of list.slice(0, 2000)) {
    const corners = cornersOf(k);
    corners.forEach((p, i) => lines.push({from: p, to: corners[(i + 1) % corners.length], colour: [...colour, 255], width}));
  }
  return lines;
}
/// Dark within light, to be seen on whatever colour.
function cased(list, width = 2.5) { return [...outlinesOf(list, [255, 255, 255], width + 2.5), ...outlinesOf(list, ink, width)]; }
function exactCorners(k) {
  const list = element('ul', {className: 'exact'}), begin = polygons.first[k], end = polygons.first[k + 1], most = 200;
  for (let i = begin; i < Math.min(end, begin + most); ++i)
    list.append(element('li', {}, polygons.exact ? polygons.exact.texts[polygons.exact.corners[i]] : rounded(cornerOf(i))));
  if (end - begin > most) list.append(element('li', {className: 'faint'}, `and ${end - begin - most} more`));
  return list;
}
function select(k, place = null) {
  selected = k;
  const isWithin = selection.contains(document.activeElement);  // on a button that goes now: keys go on from here
  selection.replaceChildren();
  if (isWithin) selection.focus({preventScroll: true});
  setLines('selection', []);
  if (k >= 0) {
    setLines('selection', cased([k]), true);
    selection.append(element('h2', {}, 'Selected'), element('p', {id: 'selected-name'}, fullName(k)));
    if (command.select) selection.append(...[command.select(k)].flat().filter(Boolean));
    selection.append(element('p', {className: 'faint'}, polygons.exact ? 'Corners, exactly:' : 'Corners, rounded:'), exactCorners(k));
    if (place) selection.append(element('p', {className: 'faint'}, `clicked near ${rounded(place)}`));
  } else if (command.select) command.select(-1);
  if (command.repaints) paint();
  redraw();
}

// ---- The view

function home() {
  if (eyePlace && command.beginsAtEye) goToEye();
  else goRound();
}
function makeTools() {
  const tools = document.getElementById('tools'), toggles = [];
  const toggle = (text, title, get, set, key) => {
    const act = () => { set(!get()); refresh(); redraw(); };
    const made = button(text, act, {title: `${title} (${key})`});
    toggles.push(() => made.setAttribute('aria-pressed', get()));
    keys[key] = act;
    tools.append(made);
  };
  const refresh = () => toggles.forEach(one => one());
  if (eyePlace) toggle('From the eye', 'look from the eye, or from outside', () => camera.atEye, on => on ? goToEye() : goRound(), 'e');
  tools.append(button('Home', () => { home(); refresh(); redraw(); }, {title: 'where the page began (Home)'}));
  keys.Home = () => { home(); refresh(); redraw(); };
  toggle('Edges', 'outlines of polygons', () => drawing.outlines, on => { drawing.outlines = on; }, 'o');
  toggle('Backs', 'sides from which corners run clockwise', () => drawing.backs, on => { drawing.backs = on; }, 'b');
  refresh();
}
function legend() {
  const counts = new Array(data.groups.length).fill(0);
  for (let k = 0; k < polygons.count; ++k) ++counts[polygons.groups[k]];
  return element('div', {className: 'legend'}, ...data.groups.map((group, i) => {
    const box = element('input', {type: 'checkbox', checked: true, onchange: () => { box.checked ? hiddenGroups.delete(i) : hiddenGroups.add(i); paint(); }});
    const swatch = element('span', {className: 'swatch'});
    const colour = colourOfGroup(i);
    swatch.style.background = colour ? css(colour) : 'conic-gradient(#e69f00,#56b4e9,#009e73,#cc79a7,#e69f00)';
    return command.groupsChange ? element('label', {}, swatch, group.name)
      : element('label', {}, box, swatch, group.name, element('span', {className: 'count'}, `${counts[i]}`));
  }));
}
function help() {
  const row = (key, what) => element('tr', {}, element('th', {}, ...key.split(' ').map(k => element('kbd', {}, k))), element('td', {}, what));
  return element('details', {}, element('summary', {}, 'Hands and keys'), element('table', {},
    row('drag', 'turn; from the eye: look around'), row('shift+drag', 'move aside; or with two fingers'), row('wheel', 'closer; or pinch'), row('click', 'select'),
    row('← → ↑ ↓', 'turn'), row('+ -', 'closer, farther'), row('Home', 'where the page began'), row('space', 'play'), row('[ ]', 'a step back, a step on'),
    row('e', 'from the eye'), row('o', 'edges'), row('b', 'backs')));
}

function begin() {
  const title = data.command + (data.scene ? `: ${data.scene.split('/').pop()}` : '');
  document.title = title;
  panel.append(element('h1', {}, title), table(data.facts));
  for (const note of data.notes) panel.append(element('p', {className: 'note'}, note));
  if (data.groups.length > 1) section('What is what', legend());
  if (command.begin) command.begin();
  panel.append(selection);
  selection.append(element('p', {className: 'faint'}, polygons.count > 0 ? 'Click a face.' : 'There is no face to draw.'));
  panel.append(help());
  if (!gl) {
    const trouble = document.getElementById('trouble');
    trouble.hidden = false;
    trouble.textContent = 'This browser has no WebGL 2, or it is turned off: the scene cannot be drawn. What was found stands beside.';
  } else {
    prepare();
    canvas.addEventListener('webglcontextlost', e => e.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => { prepare(); paint(); });
  }
  home();
  makeTools();
  listenToHands();
  listenToKeys();
  paint();
  new ResizeObserver(() => { if (camera.atEye && command.beginsAtEye && frames < 2 && !camera.isMoved) goToEye(); redraw(); }).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { if (command.sphereChanged) command.sphereChanged(); redraw(); });
}
begin();

/// For tests and measurements.
window.sightline = {
  camera, drawing, select, redraw, draw, looks, triangles: triangles.count,
  get frames() { return frames; },
  get selected() { return selected; },
  /// Milliseconds of so many frames, the camera turning, each waited for: the mean, and the least.
  measure(count) {
    const pixel = new Uint8Array(4), begun = performance.now();
    let least = Infinity;
    for (let i = 0; i < count; ++i) {
      const before = performance.now();
      camera.yaw += 0.02;
      draw();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      least = Math.min(least, performance.now() - before);
    }
    return [(performance.now() - begun) / count, least];
  },
  /// Where the middle of a polygon is on the canvas.
  middleOf(k) { const list = cornersOf(k); return onCanvas(times(1 / list.length, list.reduce(add)), cameraFrame()); },
  onCanvas: place => onCanvas(place, cameraFrame()),
  lines: name => lineLayers.has(name) ? lineLayers.get(name).list.length : 0,
  linesOf: name => lineLayers.has(name) ? lineLayers.get(name).list : [],
  pickAt(x, y) { const hit = pick(rayAt(x, y)); return hit ? hit.polygon : -1; },
};
document.documentElement.dataset.ready = 'yes';
