// ---- Colours, and what stands beside the scene

/// Colours that are told apart with any kind of sight: Okabe and Ito's.
const palette = {
  seen: [230, 159, 0], hidden: [150, 151, 156], open: [204, 121, 167], source: [0, 114, 178], new: [0, 158, 115], other: [86, 180, 233], front: [213, 94, 0],
  face: [178, 190, 200],
};
const cycleColours = [[213, 94, 0], [0, 114, 178], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233]];
/// A colour for each face, of the same palette, lighter and darker.
function colourOfFace(face) {
  const hue = cycleColours[Math.imul(face, 5) % 6 < 0 ? 0 : Math.imul(face, 5) % 6], light = 0.42 + 0.16 * (Math.floor(face / 6) % 3);
  return hue.map(c => c + (245 - c) * light);
}
/// From dark blue to yellow: a share from 0 to 1.
function scaleColour(share) {
  const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const at = Math.max(0, Math.min(3.999, 4 * share)), i = Math.floor(at);
  return stops[i].map((c, k) => c + (at - i) * (stops[i + 1][k] - c));
}
const css = c => `rgb(${c.slice(0, 3).map(Math.round).join(',')})`;
const ink = [25, 25, 25];  // on faces, which are light on a dark page too

function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else if (key in made && key !== 'list') made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children.filter(child => child !== null && child !== undefined));
  return made;
}
function swatchOf(colour) {
  const swatch = element('span', {className: 'swatch'});
  swatch.style.background = css(colour);
  return swatch;
}
const panel = document.getElementById('panel');
function section(title, ...children) {
  const made = element('section', {}, title ? element('h2', {}, title) : null, ...children);
  panel.append(made);
  return made;
}
function button(text, act, properties = {}) { return element('button', {type: 'button', onclick: act, ...properties}, text); }
function table(rows) {
  return element('table', {}, ...rows.map(([name, value]) => element('tr', {}, element('th', {scope: 'row'}, name), element('td', {}, value))));
}
/// Buttons, of many the first ones.
function listOf(items, textOf, act, most = 400) {
  const list = element('ul', {className: 'list'});
  items.slice(0, most).forEach((item, i) => list.append(element('li', {}, button(textOf(item, i), () => act(item, i)))));
  if (items.length > most) list.append(element('li', {className: 'faint'}, `and ${items.length - most} more`));
  return list;
}
/// A slider with a button that plays it; `act` is given each value. Space plays, the keys [ and ] go a step.
function player(label, least, most, value, act, seconds = 12) {
  const slider = element('input', {type: 'range', min: least, max: most, step: 1, id: 'slider', 'aria-label': label});
  const number = element('span', {className: 'faint', id: 'slider-value'});
  const play = button('Play', () => playing ? stop() : start(), {id: 'play'});
  let playing = 0;
  const set = v => {
    slider.value = v;
    number.textContent = `${slider.value} of ${most}`;
    act(Number(slider.value));
  };
  const stop = () => { cancelAnimationFrame(playing), playing = 0, play.textContent = 'Play'; };
  const start = () => {
    const from = Number(slider.value) >= most ? least : Number(slider.value), begun = performance.now();
    const each = Math.max(1 / 60, Math.min(0.5, seconds / Math.max(1, most - least)));
    const rate = Math.max(1 / each, (most - least) / seconds);
    play.textContent = 'Pause';
    const step = now => {  // a first frame may be stamped before it began
      const v = Math.max(from, Math.min(most, from + Math.floor((now - begun) / 1000 * rate)));
      if (v !== Number(slider.value)) set(v);
      if (v >= most) return stop();
      playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  };
  slider.addEventListener('input', () => { stop(); set(slider.value); });
  const back = () => { stop(); set(Number(slider.value) - 1); }, on = () => { stop(); set(Number(slider.value) + 1); };
  keys[' '] = () => play.click(), keys['['] = back, keys[']'] = on;
  set(value);
  return element('div', {}, slider, element('div', {className: 'row'}, play, button('‹', back, {ariaLabel: 'a step back'}), button('›', on, {ariaLabel: 'a step on'}), number));
}
