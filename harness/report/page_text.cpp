#include <sightline/harness/report/page_text.h>

namespace sightline::report {

const char* const page_style = R"css(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1d2328; --soft: #5d6872; --line: #d9dee2; --panel: #f5f7f8; --zero: #eef3ec; --accent: #0b63a5; --bad: 213,94,0;
  --exact: #0072b2; --epeck: #3f9fd6; --gmpq: #008a63; --epick: #b55a92; --double: #c98500; --float: #c94f00; --program: #1d2328 }
@media (prefers-color-scheme: dark) { :root { --paper: #14181b; --ink: #e4e8ea; --soft: #9aa5ad; --line: #333b41; --panel: #1c2226; --zero: #1b2a20; --accent: #6cb8f0; --bad: 240,120,30;
  --exact: #4ba6e8; --epeck: #8fd0f7; --gmpq: #2fc296; --epick: #e08fc0; --double: #f0b23c; --float: #ff7d33; --program: #e4e8ea } }
* { box-sizing: border-box }
body { font: 14px/1.45 system-ui, sans-serif; margin: 0 auto; padding: 20px 24px 60px; max-width: 1360px; color: var(--ink); background: var(--paper) }
h1 { font-size: 23px; margin: 0 0 4px } h2 { font-size: 19px; margin: 38px 0 2px } h3 { font-size: 15px; margin: 22px 0 6px }
p { margin: 4px 0 8px } .soft { color: var(--soft) } code { font: 12px/1.4 ui-monospace, monospace; overflow-wrap: anywhere }
.bar { position: sticky; top: 0; z-index: 3; background: var(--paper); border-bottom: 1px solid var(--line); padding: 8px 0; display: flex; flex-wrap: wrap; gap: 6px 18px; align-items: center }
.bar nav { display: flex; flex-wrap: wrap; gap: 0 12px } a { color: var(--accent) }
select, button { font: inherit; color: var(--ink); background: var(--panel); border: 1px solid var(--line); border-radius: 5px; padding: 2px 8px }
button { cursor: pointer } :focus-visible { outline: 2px solid var(--accent); outline-offset: 1px }
.plot { display: grid; grid-template-columns: minmax(0, 1fr) 292px; gap: 14px; align-items: start }
@media (max-width: 900px) { .plot { grid-template-columns: minmax(0, 1fr) } }
.plot > svg { width: 100%; height: auto; background: var(--panel); border-radius: 6px; touch-action: manipulation }
.plot text { fill: var(--ink); font: 12px system-ui, sans-serif } .plot text.soft { fill: var(--soft) }
.grid { stroke: var(--line); stroke-width: 1 } .zero { fill: var(--zero) }
.series path.mark { stroke: var(--paper); stroke-width: .7; cursor: pointer } .series polyline { fill: none; stroke-width: 1.6; opacity: .55 }
.series circle { opacity: .4; pointer-events: none }
svg.focused .series { opacity: .16 } svg.focused .series.focus { opacity: 1 } .focus polyline { opacity: 1; stroke-width: 2.6 }
.legend { max-height: 470px; overflow: auto; padding-right: 4px } .legend .all { display: flex; gap: 6px; margin-bottom: 6px }
.legend button.entry { display: flex; gap: 7px; align-items: center; width: 100%; border: 0; background: none; padding: 1px 4px; text-align: left }
.legend button.entry:hover { background: var(--panel) } .legend button[aria-pressed=false] { opacity: .38; text-decoration: line-through }
.legend svg { flex: none } .legend .kernel { color: var(--soft); margin-left: auto; padding-left: 6px }
#tip { position: fixed; z-index: 9; pointer-events: none; max-width: 340px; background: var(--paper); border: 1px solid var(--soft); border-radius: 6px; padding: 7px 10px; box-shadow: 0 3px 14px #0004; display: none; font-size: 13px }
#tip b { display: block } #tip td { padding: 0 10px 0 0; border: 0; text-align: left } #tip td + td { text-align: right; padding: 0; font-variant-numeric: tabular-nums }
.scroll { overflow-x: auto } table { border-collapse: collapse; font-variant-numeric: tabular-nums }
td, th { padding: 2px 8px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap } th { font-weight: 600; cursor: pointer; user-select: none }
td.name, th.name { text-align: left } .swatch { display: inline-block; width: 10px; height: 10px; border-radius: 2px; margin-right: 6px }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); gap: 14px }
.card { border: 1px solid var(--line); border-radius: 7px; padding: 10px 12px; background: var(--panel); min-width: 0 }
.card img { display: block; width: 100%; height: auto; border-radius: 4px; margin: 6px 0 } .card .row { display: flex; gap: 8px; margin-top: 6px }
.card code { display: block; background: var(--paper); padding: 5px 7px; border-radius: 4px }
)css";

const char* const page_frame = R"html(
<h1>Speed against error</h1>
<p id="about"></p>
<div class="bar"><nav id="questions" aria-label="questions"></nav>
<label>distance from degeneracy <select id="distance"></select></label>
<label>family <select id="family"></select></label></div>
<main id="main"></main>
<div id="tip" role="status"></div>
)html";

const char* const page_script = R"js(
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const ns = 'http://www.w3.org/2000/svg', byId = id => document.getElementById(id);
const element = (name, attributes = {}, ...children) => {
  const e = document.createElement(name);
  for (const [k, v] of Object.entries(attributes)) k === 'onclick' ? (e.onclick = v) : e.setAttribute(k, v);
  e.append(...children);
  return e;
};
const drawn = (name, attributes, parent) => {
  const e = document.createElementNS(ns, name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (parent) parent.append(e);
  return e;
};
// ---- Rows: [contender, family, distance, size, seed, cases, wrong, abstained, crashed, stopped, faces, seconds or null, worst, bytes, error, worst error]
const rows = data.rows.map(r => ({ who: r[0], family: r[1], distance: r[2], size: r[3], seed: r[4], cases: r[5], wrong: r[6], abstained: r[7], crashed: r[8], stopped: r[9],
  faces: r[10], seconds: r[11], worst: r[12], bytes: r[13], error: r[14], worstError: r[15] }));
const colour = kernel => `var(--${['exact', 'epeck', 'gmpq', 'epick', 'double', 'float'].includes(kernel) ? kernel : 'program'})`;
const percent = (part, all) => part === 0 ? '–' : (100 * part / all).toFixed(part === all ? 0 : 1) + ' %';
const number = x => x === 0 ? '0' : x < 1e-3 || x >= 1e5 ? x.toExponential(1) : String(Number(x.toPrecision(3)));
const time = s => s === null ? '–' : s < 1e-3 ? (s * 1e6).toPrecision(3) + ' µs' : s < 1 ? (s * 1e3).toPrecision(3) + ' ms' : s.toPrecision(3) + ' s';
const median = list => list.length ? list.sort((a, b) => a - b)[list.length >> 1] : null;
const sum = (list, f) => list.reduce((s, x) => s + f(x), 0);
/// Several rows as one.
const together = list => {
  const ended = sum(list, r => r.cases - r.crashed - r.stopped);
  return { cases: sum(list, r => r.cases), wrong: sum(list, r => r.wrong), abstained: sum(list, r => r.abstained), crashed: sum(list, r => r.crashed), stopped: sum(list, r => r.stopped),
    faces: sum(list, r => r.faces * r.cases) / sum(list, r => r.cases), seconds: median(list.filter(r => r.seconds !== null).map(r => r.seconds)), worst: Math.max(...list.map(r => r.worst)),
    bytes: Math.max(...list.map(r => r.bytes)), error: ended ? sum(list, r => r.error * (r.cases - r.crashed - r.stopped)) / ended : 0, worstError: Math.max(...list.map(r => r.worstError)), rows: list.length };
};
// ---- Marks: a shape for each method
const star = (n, inner, turn = 0) => Array.from({ length: 2 * n }, (_, k) => { const a = Math.PI * (k / n + turn) - Math.PI / 2, r = k % 2 ? inner : 1; return [r * Math.cos(a), r * Math.sin(a)]; });
const ring = (n, turn = 0) => Array.from({ length: n }, (_, k) => { const a = 2 * Math.PI * (k + turn) / n - Math.PI / 2; return [Math.cos(a), Math.sin(a)]; });
const cross = [[-1, -.35], [-.35, -.35], [-.35, -1], [.35, -1], [.35, -.35], [1, -.35], [1, .35], [.35, .35], [.35, 1], [-.35, 1], [-.35, .35], [-1, .35]];
const shapes = [ring(20), ring(4, .5), ring(3), ring(4), cross, ring(3, .5), star(5, .45), ring(5), cross.map(([x, y]) => [(x - y) * .75, (x + y) * .75]), ring(6), star(4, .4), star(3, .35), star(6, .5),
  [[-1, -.5], [1, -.5], [1, .5], [-1, .5]], [[-.5, -1], [.5, -1], [.5, 1], [-.5, 1]], star(3, .35, 1 / 3), star(8, .6), ring(4, .25), ring(7), ring(8)];
const path = (shape, x, y, r) => 'M' + shapes[shape % shapes.length].map(([a, b]) => (x + r * a).toFixed(1) + ' ' + (y + r * b).toFixed(1)).join('L') + 'Z';
// ---- The tip
const tip = byId('tip');
const show = (event, title, pairs) => {
  tip.replaceChildren(element('b', {}, title), element('table', {}, ...pairs.map(([k, v]) => element('tr', {}, element('td', {}, k), element('td', {}, v)))));
  tip.style.display = 'block';
  const box = event.target.getBoundingClientRect(), x = event.clientX || box.right, y = event.clientY || box.bottom;
  tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - tip.offsetWidth - 8)) + 'px';
  tip.style.top = Math.max(4, y + 16 + tip.offsetHeight > innerHeight ? y - tip.offsetHeight - 12 : y + 16) + 'px';
};
const hide = () => { tip.style.display = 'none'; };
const pairsOf = r => [['faces, mean', number(r.faces)], ['seconds, median', time(r.seconds)], ['seconds, worst', time(r.worst)], ['memory, peak', (r.bytes / 1e6).toFixed(1) + ' MB'], ['error, mean', number(r.error)], ['error, worst', number(r.worstError)],
  ['cases', String(r.cases)], ['wrong', percent(r.wrong, r.cases)], ['abstained', percent(r.abstained, r.cases)], ['crashed', percent(r.crashed, r.cases)], ['stopped by a limit', percent(r.stopped, r.cases)]];
// ---- Choices
const chosen = { distance: -1, family: -1 };
const hidden = new Set();
const fill = (select, names, key) => {
  select.append(element('option', { value: -1 }, 'all'), ...names.map((n, k) => element('option', { value: k }, n)));
  select.onchange = () => { chosen[key] = Number(select.value); sections.forEach(s => s()); };
};
const is = r => (chosen.distance < 0 || r.distance === chosen.distance) && (chosen.family < 0 || r.family === chosen.family);
// ---- A question
const nameOf = c => data.contenders[c].method + ' (' + data.contenders[c].kernel + ')';
const table = (heads, lines) => {
  const body = element('tbody'), sorted = { column: -1, down: true };
  const build = () => body.replaceChildren(...lines.map(line => element('tr', {}, ...line.map((cell, k) => { const td = element('td', k < 2 && typeof cell.sort === 'string' ? { class: 'name' } : {}, cell.node || cell.text); if (cell.shade) td.style.background = `rgba(var(--bad),${cell.shade})`; return td; }))));
  const head = element('tr', {}, ...heads.map((h, k) => element('th', { scope: 'col', class: lines.length && typeof lines[0][k].sort === 'string' ? 'name' : '', title: 'sort', onclick: () => {
    sorted.down = sorted.column === k ? !sorted.down : typeof (lines[0] || [])[k]?.sort !== 'string'; sorted.column = k;
    lines.sort((a, b) => (a[k].sort < b[k].sort ? -1 : a[k].sort > b[k].sort ? 1 : 0) * (sorted.down ? -1 : 1)); build(); } }, h)));
  build();
  return element('div', { class: 'scroll' }, element('table', {}, element('thead', {}, head), body));
};
const who = c => { const s = element('span'), k = element('span', { class: 'swatch' }); k.style.background = colour(data.contenders[c].kernel); s.append(k, data.contenders[c].method); return { node: s, sort: data.contenders[c].method }; };
const kernelOf = c => ({ text: data.contenders[c].kernel, sort: data.contenders[c].kernel });

const section = q => {
  const mine = data.contenders.map((c, k) => k).filter(k => data.contenders[k].question === q);
  const methods = [...new Set(mine.map(k => data.contenders[k].method))], shapeOf = c => methods.indexOf(data.contenders[c].method);
  const svg = drawn('svg', { viewBox: '0 0 900 480', role: 'img', 'aria-label': data.questions[q].question + ': seconds against error' });
  const legend = element('div', { class: 'legend' }), tables = element('div');
  const focus = c => { svg.classList.toggle('focused', c !== null); svg.querySelectorAll('.series').forEach(g => g.classList.toggle('focus', c !== null && Number(g.dataset.who) === c)); };
  const draw = () => {
    svg.replaceChildren();
    // 1. A point for each size.
    const points = [];
    for (const c of mine) {
      const of = rows.filter(r => r.who === c && is(r));
      const sizes = [...new Set(of.map(r => r.size))].sort((a, b) => a - b);
      for (const size of sizes) { const all = together(of.filter(r => r.size === size)); if (all.seconds !== null) points.push({ c, size, ...all }); }
    }
    const seen = points.filter(p => !hidden.has(p.c));
    const left = 66, right = 872, top = 16, low = 372, zeroTop = 384, zeroLow = 428;
    const log = Math.log10, times = points.map(p => p.seconds).filter(s => s > 0), errors = points.map(p => p.error).filter(e => e > 0);
    if (!times.length) { drawn('text', { x: 450, y: 220, 'text-anchor': 'middle' }, svg).textContent = 'no rows for this choice'; return; }
    const x0 = Math.floor(log(Math.min(...times)) * 2) / 2, x1 = Math.max(x0 + .5, Math.ceil(log(Math.max(...times)) * 2) / 2), y0 = errors.length ? Math.floor(log(Math.min(...errors))) : -3, y1 = Math.max(y0 + 1, errors.length ? Math.ceil(log(Math.max(...errors))) : 0);
    const X = s => left + (log(Math.max(s, 1e-9)) - x0) / (x1 - x0) * (right - left);
    const place = new Map(mine.map((c, k) => [c, (k + .5) / mine.length]));
    const Y = p => p.error > 0 ? low - (log(p.error) - y0) / (y1 - y0) * (low - top) : zeroTop + 6 + place.get(p.c) * (zeroLow - zeroTop - 12);
    // 2. Axes.
    drawn('rect', { class: 'zero', x: left, y: zeroTop, width: right - left, height: zeroLow - zeroTop }, svg);
    const text = (x, y, words, anchor, soft) => { const t = drawn('text', { x, y, 'text-anchor': anchor }, svg); if (soft) t.setAttribute('class', 'soft'); t.textContent = words; return t; };
    for (let e = Math.ceil(x0); e <= x1; ++e) { drawn('line', { class: 'grid', x1: X(10 ** e), x2: X(10 ** e), y1: top, y2: zeroLow }, svg); text(X(10 ** e), 446, e < -3 ? 10 ** (e + 6) + ' µs' : e < 0 ? 10 ** (e + 3) + ' ms' : 10 ** e + ' s', 'middle'); }
    const step = Math.ceil((y1 - y0) / 8);
    for (let e = y1; e >= y0; e -= step) { const y = low - (e - y0) / (y1 - y0) * (low - top); drawn('line', { class: 'grid', x1: left, x2: right, y1: y, y2: y }, svg); text(left - 7, y + 4, e >= -2 ? String(Number((10 ** e).toPrecision(1))) : '1e' + e, 'end'); }
    text(left - 7, (zeroTop + zeroLow) / 2 + 4, 'no error', 'end');
    text((left + right) / 2, 470, 'seconds of a case, median (one thread)', 'middle', true);
    const side = text(0, 0, 'error, mean', 'middle', true); side.setAttribute('transform', `translate(13 ${(top + low) / 2}) rotate(-90)`);
    // 3. Series: a line along sizes, and a mark for each.
    const sizes = [...new Set(points.map(p => p.size))].sort((a, b) => a - b);
    for (const c of mine) {
      const of = seen.filter(p => p.c === c);
      if (!of.length) continue;
      const g = drawn('g', { class: 'series', 'data-who': c }, svg), ink = colour(data.contenders[c].kernel);
      drawn('polyline', { points: of.map(p => X(p.seconds).toFixed(1) + ',' + Y(p).toFixed(1)).join(' '), stroke: ink }, g);
      for (const p of of) {
        const mark = drawn('path', { class: 'mark', d: path(shapeOf(c), X(p.seconds), Y(p), 5 + 1.7 * sizes.indexOf(p.size)), fill: ink, tabindex: 0, role: 'img', 'aria-label': `${nameOf(c)}: ${time(p.seconds)}, error ${number(p.error)}` }, g);
        const over = event => { focus(c); dots(g, c, p.size, X, Y); show(event, nameOf(c), [['scenes', p.size === 0 ? 'small' : 'about ' + p.size + ' faces'], ...pairsOf(p)]); };
        mark.onmouseenter = mark.onfocus = over; mark.onclick = over;
        mark.onmouseleave = mark.onblur = () => { focus(null); hide(); g.querySelectorAll('circle').forEach(d => d.remove()); };
      }
    }
  };
  /// Each row of a mark.
  const dots = (g, c, size, X, Y) => {
    g.querySelectorAll('circle').forEach(d => d.remove());
    for (const r of rows) if (r.who === c && r.size === size && is(r) && r.seconds !== null) drawn('circle', { cx: X(r.seconds), cy: Y({ c, error: r.error }), r: 2.6, fill: colour(data.contenders[c].kernel) }, g);
  };
  const toggle = () => legend.querySelectorAll('.entry').forEach(b => b.setAttribute('aria-pressed', !hidden.has(Number(b.dataset.who))));
  legend.append(element('div', { class: 'all' }, ...[['all', () => mine.forEach(c => hidden.delete(c))], ['none', () => mine.forEach(c => hidden.add(c))], ['exact only', () => mine.forEach(c => ['exact', 'epeck', 'gmpq'].includes(data.contenders[c].kernel) ? hidden.delete(c) : hidden.add(c))]]
    .map(([words, act]) => element('button', { type: 'button', onclick: () => { act(); toggle(); draw(); } }, words))));
  for (const c of mine) {
    const key = drawn('svg', { width: 16, height: 16, 'aria-hidden': true });
    drawn('path', { d: path(shapeOf(c), 8, 8, 6), fill: colour(data.contenders[c].kernel) }, key);
    const entry = element('button', { type: 'button', class: 'entry', 'data-who': c, 'aria-pressed': true, title: 'show or hide; twice: this one alone' }, key, data.contenders[c].method, element('span', { class: 'kernel' }, data.contenders[c].kernel));
    entry.onclick = () => { hidden.has(c) ? hidden.delete(c) : hidden.add(c); toggle(); draw(); };
    entry.ondblclick = () => { mine.forEach(o => o === c ? hidden.delete(o) : hidden.add(o)); toggle(); draw(); };
    entry.onmouseenter = () => focus(c); entry.onmouseleave = () => focus(null);
    legend.append(entry);
  }
  const retable = () => {
    const cell = (text, sort, shade) => ({ text, sort, shade }), share = (part, all) => cell(percent(part, all), part / all, part ? .12 + .5 * part / all : 0);
    const lines = [], across = [];
    for (const c of mine) {
      const of = rows.filter(r => r.who === c && is(r));
      if (!of.length) continue;
      const s = chosen.distance < 0 && chosen.family < 0 ? { ...data.summaries[c] } : together(of);
      lines.push([who(c), kernelOf(c), cell(String(s.cases), s.cases), cell(time(s.seconds), s.seconds ?? 1e9), cell(time(s.worst), s.worst), cell((s.bytes / 1e6).toFixed(1), s.bytes), cell(number(s.error), s.error), cell(number(s.worstError), s.worstError),
        share(s.wrong, s.cases), share(s.abstained, s.cases), share(s.crashed, s.cases), share(s.stopped, s.cases)]);
      const all = rows.filter(r => r.who === c && (chosen.family < 0 || r.family === chosen.family));
      across.push([who(c), kernelOf(c), ...data.distances.map((d, k) => { const at = all.filter(r => r.distance === k); return at.length ? share(sum(at, r => r.wrong), sum(at, r => r.cases)) : cell('', -1); })]);
    }
    tables.replaceChildren(element('h3', {}, 'Medians and worst'), table(['method', 'kernel', 'cases', 'median', 'worst', 'peak MB', 'mean error', 'worst error', 'wrong', 'abstained', 'crashed', 'stopped'], lines));
    if (data.distances.length > 1) tables.append(element('h3', {}, 'Wrong answers by distance from degeneracy'), table(['method', 'kernel', ...data.distances], across));
  };
  const examples = data.examples.filter(e => e.question === data.questions[q].question);
  const cards = element('div', { class: 'cards' });
  for (const e of examples) {
    const alone = e.picture.replace('<svg ', '<svg xmlns="http://www.w3.org/2000/svg" ');
    const bytes = [...new TextEncoder().encode(alone)].map(b => String.fromCharCode(b)).join('');
    const picture = element('img', { alt: '', src: 'data:image/svg+xml;base64,' + btoa(bytes) });  // runs no script
    const save = (name, text) => element('a', { href: URL.createObjectURL(new Blob([text], { type: 'text/plain' })), download: name }, name);
    const copy = element('button', { type: 'button', onclick: () => { navigator.clipboard?.writeText(e.again); copy.textContent = 'copied'; } }, 'copy');
    const links = element('div', { class: 'row' }, copy, save(e.file, e.scene));
    if (e.query) links.append(save(e.file.replace(/[.]off$/, '.json'), e.query));
    cards.append(element('div', { class: 'card' }, element('b', {}, `${e.method} (${e.kernel})`), element('div', { class: 'soft' }, `${e.faces} ${e.faces === 1 ? 'face' : 'faces'}, made of ${e.faces_before} of ${e.family}, ${e.distance}, seed ${e.seed}; error ${number(e.error)}`), picture, ...(e.view === null ? [] : [element('button', { type: 'button', 'data-view': e.view, 'aria-expanded': false }, 'turn it around')]), ...(e.why ? [element('p', {}, e.why)] : []), element('code', {}, e.again), links));
  }
  byId('main').append(element('section', { id: 'q' + q }, element('h2', {}, data.questions[q].question), element('p', { class: 'soft' }, 'Error: ' + data.questions[q].error + '. A mark is a method and kernel at one size, larger for larger scenes; a line joins its sizes.'), element('div', { class: 'plot' }, svg, legend), tables));
  if (examples.length) byId('q' + q).append(element('h3', {}, 'The smallest scene that shows each error'), cards);
  return () => { draw(); retable(); };
};
byId('about').append(data.about);
data.questions.forEach((q, k) => byId('questions').append(element('a', { href: '#q' + k }, q.question)));
fill(byId('distance'), data.distances, 'distance');
fill(byId('family'), data.families, 'family');
const sections = data.questions.map((q, k) => section(k));
sections.forEach(s => s());
)js";

}  // namespace sightline::report
