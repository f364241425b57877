// ---- What each command adds to its page

const commands = {};

/// Painted back to front.
commands.order = () => {
  const pairs = wrongNumbers('pairs'), placeOfFace = new Map();
  polygons.faces.forEach((face, k) => { if (!placeOfFace.has(face)) placeOfFace.set(face, k); });
  const doubles = plainDoubles({
    who: 'An order in plain doubles', finds: 'nothing in the wrong place',
    missing: {set: new Set(pairs.filter((_, i) => i % 2 === 0).sort()), name: 'painted over', words: 'faces painted over though nearer'},
    extra: {set: new Set(pairs.filter((_, i) => i % 2 === 1).sort()), name: 'painted over nearer ones', words: 'faces painted over nearer ones'},
  });
  const goTo = face => { if (placeOfFace.has(face)) select(placeOfFace.get(face)); };
  return {
    beginsAtEye: true,
    colourOf: k => doubles.colourOf(k, false) || colourOfFace(polygons.faces[k]),
    nameOf: k => `polygon ${polygons.number(k) + 1} of ${polygons.of} from the back`,
    begin() {
      drawing.painter = true;
      const last = element('p', {id: 'painted'});
      const show = n => {
        drawing.to = n;
        last.textContent = n > 0 ? `painted last: face ${polygons.faces[n - 1]}` : 'nothing is painted yet';
        setLines('last', n > 0 && n < polygons.count ? cased([n - 1], 1.5) : [], true);
        redraw();
      };
      section('Back to front', player('how many polygons are painted', 0, polygons.count, polygons.count, show), last,
        element('p', {className: 'faint'}, 'From the eye each polygon is painted over those before it, without a depth buffer. From elsewhere the order is another one, and a depth buffer decides.'));
      doubles.begin();
    },
    select(k) {
      const over = [], under = [];
      if (k >= 0) for (let i = 0; i < pairs.length; i += 2) {
        if (pairs[i] === polygons.faces[k]) over.push(pairs[i + 1]);
        if (pairs[i + 1] === polygons.faces[k]) under.push(pairs[i]);
      }
      const name = face => `face ${face}`;
      return [wrongWith('over', 'plain doubles paint over it, though farther', over, name, goTo), wrongWith('under', 'plain doubles paint it over, though nearer', under, name, goTo)];
    },
  };
};

/// Components, cycles, arcs of a face.
commands.graph = () => {
  const component = unpacked(data.components), sizes = new Map();
  for (const c of component) sizes.set(c, (sizes.get(c) || 0) + 1);
  const cycles = [...sizes].filter(([, size]) => size > 1).map(([c]) => c).sort((a, b) => a - b);
  const cycleNumber = new Map(cycles.map((c, i) => [c, i]));
  let count = 1;
  for (const c of sizes.keys()) count = Math.max(count, c);
  const list = data.arcs ? unpacked(data.arcs) : null, matrix = data.arc_matrix ? unpacked(data.arc_matrix) : null;
  const nameOfPiece = n => polygons.place(n) === undefined ? 'one that is not drawn' : faceName(polygons.place(n));
  const wrong = {missing: wrongNumbers('missing'), extra: wrongNumbers('extra')}, allWrong = key => new Set(wrong[key].slice().sort((a, b) => a - b));
  const doubles = plainDoubles({
    who: 'A comparison in plain doubles', finds: 'the same arcs', idOf: k => polygons.number(k), nameOf: nameOfPiece,
    missing: {set: allWrong('missing'), count: wrong.missing.length / 2, name: 'faces of missing arcs', words: wrong.missing.length === 2 ? 'arc missing' : 'arcs missing'},
    extra: {set: allWrong('extra'), count: wrong.extra.length / 2, name: 'faces of arcs that are none', words: wrong.extra.length === 2 ? 'arc that is none' : 'arcs that are none'},
  });
  /// The pieces at the other ends of a piece's wrong arcs.
  const othersOf = (key, n) => {
    const others = new Set();
    for (let i = 0; i < wrong[key].length; i += 2) {
      if (wrong[key][i] === n) others.add(wrong[key][i + 1]);
      if (wrong[key][i + 1] === n) others.add(wrong[key][i]);
    }
    return others;
  };
  const goTo = n => { if (polygons.place(n) !== undefined) select(polygons.place(n)); };
  let inFront = new Set(), behind = new Set();  // pieces
  let mode = cycles.length > 0 ? 'cycles' : 'priority', chosen = -1;
  const findArcs = k => {
    inFront = new Set(), behind = new Set();
    const n = polygons.number(k);
    if (list) for (let i = 0; i < list.length; i += 2) {
      if (list[i + 1] === n) inFront.add(list[i]);
      if (list[i] === n) behind.add(list[i + 1]);
    }
    if (matrix) for (let i = 0; i < component.length; ++i) {
      if (bit(matrix, i * component.length + n)) inFront.add(i);
      if (bit(matrix, n * component.length + i)) behind.add(i);
    }
  };
  return {
    repaints: true,
    colourOf(k) {
      const n = polygons.number(k), c = component[n];
      if (doubles.isShown()) return k === selected ? [250, 250, 245] : doubles.colourOf(k, false);
      if (selected >= 0 && (list || matrix)) {
        if (k === selected) return [250, 250, 245];
        if (inFront.has(n) && behind.has(n)) return palette.open;
        return inFront.has(n) ? palette.front : behind.has(n) ? palette.source : palette.face;
      }
      if (c === undefined) return palette.face;
      if (mode === 'priority') return scaleColour(c / count);
      if (!cycleNumber.has(c)) return palette.face;
      return chosen >= 0 && c !== chosen ? palette.face : cycleColours[cycleNumber.get(c) % cycleColours.length];
    },
    nameOf: k => {
      const c = component[polygons.number(k)];
      return c === undefined ? '' : `component ${c + 1}` + (sizes.get(c) > 1 ? `, a cycle of ${sizes.get(c)}` : '');
    },
    begin() {
      const by = (text, value) => button(text, () => { mode = value, chosen = -1; refresh(); select(-1); });
      const modes = [['Cycles', 'cycles'], ['Priority', 'priority']].map(([text, value]) => [by(text, value), value]);
      const refresh = () => modes.forEach(([made, value]) => made.setAttribute('aria-pressed', mode === value));
      refresh();
      section('Colours', element('div', {className: 'row'}, ...modes.map(([made]) => made)),
        element('p', {className: 'faint'}, 'Priority: dark is first, what no other obscures; yellow last.'));
      section(`Cycles: ${cycles.length}`, cycles.length === 0 ? element('p', {className: 'faint'}, 'Each component is one face: one order serves all viewpoints.')
        : listOf(cycles, c => `component ${c + 1}: ${sizes.get(c)} faces`, c => {
          mode = 'cycles', chosen = chosen === c ? -1 : c;
          refresh();
          select(-1);
          const members = [];
          component.forEach((d, n) => { if (d === chosen && polygons.place(n) !== undefined) members.push(polygons.place(n)); });
          setLines('cycle', cased(members, 1.5), true);
        }));
      doubles.begin();
    },
    select(k) {
      setLines('cycle', []);
      const n = polygons.number(k), [missing, extra] = ['missing', 'extra'].map(key => k < 0 ? allWrong(key) : othersOf(key, n));
      doubles.change(missing, extra);
      if (k < 0) return null;
      if (!list && !matrix) return element('p', {className: 'faint'}, 'Arcs are not known: --arcs writes them out.');
      findArcs(k);
      const drawn = set => [...set].map(polygons.place).filter(i => i !== undefined);
      const part = (title, set, colour) => {
        return [element('p', {className: 'row'}, swatchOf(colour), `${title}: ${set.size}`), listOf(drawn(set), faceName, i => select(i), 100)];
      };
      return element('div', {id: 'arcs'}, ...part('may be in front of it', inFront, palette.front), ...part('may be behind it', behind, palette.source),
        ...[wrongWith('arcs-missing', 'with these plain doubles lack an arc', [...missing], nameOfPiece, goTo), wrongWith('arcs-extra', 'with these plain doubles have an arc that is none', [...extra], nameOfPiece, goTo)].filter(Boolean),
        doubles.errs && missing.size + extra.size === 0 ? element('p', {className: 'faint', id: 'arcs-right'}, 'plain doubles have all of its arcs right') : '');
    },
  };
};

/// What plain doubles make of the same question, where the page knows: a switch that marks what they miss and what they add, all else in grey; else why they were not asked.
///   who, finds         what is said where they are right
///   missing, extra     the two kinds of errors: `set` of what is marked, its `name` before the list of these, `words` for so many, `count` of them where they are not as many as the set
///   idOf, nameOf       of a polygon what the sets hold; of that a name
///   more               what stands beneath
function plainDoubles({who, finds, missing, extra, idOf = k => polygons.faces[k], nameOf = id => id, more = []}) {
  const kinds = [missing, extra], countOf = kind => kind.count === undefined ? kind.set.size : kind.count, same = kinds.every(kind => countOf(kind) === 0);
  const errors = element('p', {className: 'faint', id: 'errors'});
  let shown = false;
  const names = set => { const all = [...new Set([...set].map(nameOf))]; return all.slice(0, 30).join(', ') + (all.length > 30 ? ' …' : ''); };
  const tell = () => { errors.textContent = kinds.filter(kind => kind.set.size > 0).map(kind => `${kind.name}: ${names(kind.set)}.`).join(' '); };
  return {
    /// Null where the polygon has its own colour.
    colourOf(k, isBeneath) {
      const id = idOf(k), isMissing = missing.set.has(id), isExtra = extra.set.has(id);
      return !shown ? null : isMissing && isExtra ? palette.open : isMissing ? palette.front : isExtra ? palette.source : isBeneath ? palette.hidden : palette.face;
    },
    /// From now on these are wrong: at another place, or beside what is selected.
    change(nextMissing, nextExtra) { missing.set = nextMissing, extra.set = nextExtra, tell(); },
    isShown: () => shown,
    errs: !same,
    begin() {
      if (!data.doubles) return;
      const why = data.doubles.left_out;
      if (why || same) section('Plain doubles', element('p', {className: 'faint', id: 'not-marked'}, why ? `Not asked: ${why}.` : `${who} finds ${finds}.`));
      if (why || same) return;
      const box = element('input', {type: 'checkbox', id: 'doubles', onchange: () => { shown = box.checked; paint(); }});
      section('Plain doubles', element('label', {className: 'row'}, box, 'mark where they err'),
        ...[[missing, palette.front], [extra, palette.source]].filter(([kind]) => countOf(kind) > 0).map(([kind, colour]) => element('p', {className: 'row'}, swatchOf(colour), `${countOf(kind)} ${kind.words}`)),
        errors, ...more);
      tell();
    },
  };
}
/// Numbers of what doubles have wrong.
function wrongNumbers(key) { return data.doubles && data.doubles[key] ? unpacked(data.doubles[key]) : []; }
/// Faces that a search of what is visible has wrong.
function doublesOfVisible(who) {
  return plainDoubles({
    who, finds: 'the same faces', missing: {set: new Set(wrongNumbers('missing')), name: 'missing', words: 'visible faces missing'},
    extra: {set: new Set(wrongNumbers('extra')), name: 'shown', words: 'hidden ones shown'},
  });
}
/// Buttons of faces that a selected one is wrong with, under a title; nothing where there are none.
function wrongWith(id, title, list, nameOf, act) {
  return list.length === 0 ? null : element('div', {id}, element('p', {className: 'faint'}, `${title}: ${list.length}`), listOf(list, nameOf, act, 100));
}

/// Visible parts, lines, the sphere of directions.
commands.see = () => {
  let base = 0;
  while (base < polygons.count && polygons.number(base) < data.base) ++base;
  drawing.base = base;
  const from = data.lines, lines = [], width = 1024, height = 512;
  const doubles = doublesOfVisible('The same algorithm on plain doubles');
  let showHidden = true, sphere = null, plain = null, middle = 0;
  if (from) {
    const ends = unpacked(from.ends), edges = unpacked(from.edges), kinds = unpacked(from.kinds), hidden = unpacked(from.hidden_by);
    for (let i = 0; i < edges.length; ++i) {
      const kind = from.names[kinds[i]], strong = kind === 'boundary' || kind === 'silhouette';
      lines.push({
        from: [...ends.subarray(6 * i, 6 * i + 3)], to: [...ends.subarray(6 * i + 3, 6 * i + 6)], edge: edges[i], kind, hiddenBy: hidden[i], text: from.texts[i],
        width: hidden[i] ? 1.2 : kind === 'intersection' ? 2 : strong ? 2.2 : 1.4, dash: hidden[i] ? 7 : 0,
        colour: hidden[i] ? [...ink, 110] : kind === 'intersection' ? [...palette.front, 255] : [...ink, 255],
      });
    }
  }
  const shownLines = () => lines.filter(line => line.kind !== 'smooth' && (showHidden || !line.hiddenBy));
  const drawLines = () => {
    setLines('hidden', shownLines().filter(line => line.hiddenBy), true);
    setLines('visible', shownLines().filter(line => !line.hiddenBy));
  };
  const hiderOf = line => line.hiddenBy ? polygons.place(line.hiddenBy - 1) : undefined;
  const selectLine = i => {
    const one = shownLines()[i], parts = lines.filter(line => line.edge === one.edge), hiders = new Set(parts.map(hiderOf).filter(k => k !== undefined));
    select(-1);
    setLines('selection', [...outlinesOf([...hiders], palette.front, 3), ...parts.map(line => ({...line, colour: [...palette.source, 255], width: 4}))], true);
    selection.replaceChildren(element('h2', {}, 'Selected'), element('p', {id: 'selected-name'}, one.kind === 'intersection' ? 'a line where faces cross' : `an edge: ${one.kind}`),
      element('ul', {className: 'exact', id: 'edge-parts'}, ...parts.map(line => {
        const k = hiderOf(line);
        return element('li', {}, line.hiddenBy ? `hidden by ${k === undefined ? 'a face that is not drawn' : faceName(k)}` : 'visible', element('br'), line.text || `${rounded(line.from)} to ${rounded(line.to)}, rounded`);
      })));
  };
  const rayOf = (x, y) => {
    const a = middle - Math.PI * (2 * x - 1), b = Math.PI / 2 * (1 - 2 * y);
    return {from: eyePlace, along: [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)]};
  };
  const outlineOnSphere = () => {
    const pen = sphere.getContext('2d');
    pen.putImageData(plain, 0, 0);
    pen.fillStyle = isDark() ? '#ffffff28' : '#00000020';
    for (let i = 1; i < 12; ++i) pen.fillRect(i * width / 12, 0, 1, height);
    for (let i = 1; i < 6; ++i) pen.fillRect(0, i * height / 6, width, i === 3 ? 2 : 1);
    if (selected < 0) return;
    const corners = cornersOf(selected);
    for (const [colour, wide] of [['white', 7], [css(ink), 3]]) corners.forEach((p, i) => {
      const q = corners[(i + 1) % corners.length];
      let last = null;
      pen.strokeStyle = colour, pen.lineWidth = wide;
      pen.beginPath();
      for (let s = 0; s <= 48; ++s) {
        const away = minus(add(times(1 - s / 48, p), times(s / 48, q)), eyePlace);
        if (lengthOf(away) < 1e-6) continue;  // a corner in the eye is in no direction
        const d = unit(away);
        let turned = (middle - Math.atan2(d[1], d[0])) / (2 * Math.PI);
        turned -= Math.round(turned);
        const x = (turned + 0.5) * width, y = (0.5 - Math.asin(d[2]) / Math.PI) * height;
        last === null || Math.abs(x - last) > width / 2 ? pen.moveTo(x, y) : pen.lineTo(x, y);
        last = x;
      }
      pen.stroke();
    });
  };
  return {
    beginsAtEye: true,
    colourOf: k => doubles.colourOf(k, k < base) || colourOfGroup(polygons.groups[k]) || colourOfFace(polygons.faces[k]),
    begin() {
      drawing.outlines = lines.length === 0 && drawing.outlines;
      if (lines.length > 0) {
        const box = element('input', {type: 'checkbox', checked: true, onchange: () => { showHidden = box.checked; drawLines(); }});
        section('Lines', element('label', {className: 'row'}, box, 'hidden parts, dashed'),
          element('p', {className: 'faint'}, 'Click an edge: what hides it lights up.'));
        drawLines();
      }
      doubles.begin();
      if (!gl || !eyePlace || polygons.count === 0) return;
      sphere = element('canvas', {id: 'sphere', width, height, ariaLabel: 'All directions from the eye, unrolled'});
      sphere.addEventListener('pointermove', e => {
        const hit = pick(rayOf(e.offsetX / sphere.clientWidth, e.offsetY / sphere.clientHeight));
        hover.textContent = hit ? fullName(hit.polygon) : '';
      });
      sphere.addEventListener('pointerleave', () => { hover.textContent = ''; });
      sphere.addEventListener('click', e => {
        const hit = pick(rayOf(e.offsetX / sphere.clientWidth, e.offsetY / sphere.clientHeight));
        select(hit ? hit.polygon : -1, hit ? hit.place : null);
      });
      section('All directions, unrolled', sphere, element('p', {className: 'faint'}, 'The middle is the direction to the middle of the scene; up is up. To the right as one turns to the right.'));
    },
    /// Drawn again where colours change.
    sphereChanged() {
      if (!sphere || !faces || gl.isContextLost()) return;
      const ahead = minus(bounds.middle, eyePlace);
      middle = Math.atan2(ahead[1], ahead[0]);
      plain = new ImageData(unrolled(eyePlace, middle, width, height), width, height);
      outlineOnSphere();
    },
    clickAt(x, y) {
      if (lines.length === 0) return false;
      const found = pickLine(shownLines(), x, y, 5);
      if (found >= 0) selectLine(found);
      return found >= 0;
    },
    select() { if (plain) outlineOnSphere(); return null; },
  };
};

/// Visible, hidden, undecided; sightlines and proofs.
commands.weak = () => {
  let base = 0;
  while (base < polygons.count && polygons.number(base) < data.base) ++base;
  drawing.base = base, drawing.backs = false;
  const kindNames = ['line', 'cut of the source', 'cut of the face', 'blocked', 'empty', 'away', 'open'];
  const sight = {pieces: unpacked(data.sightlines.pieces), sources: unpacked(data.sightlines.sources), ends: unpacked(data.sightlines.ends), texts: data.sightlines.texts};
  const proofs = Object.fromEntries(Object.entries(data.proofs).map(([key, value]) => [key, unpacked(value)]));
  const sightOfFace = new Map(), proofsOfFace = new Map();
  const faceOf = piece => { const k = polygons.place(piece); return k === undefined ? undefined : polygons.faces[k]; };
  sight.pieces.forEach((piece, i) => sightOfFace.set(faceOf(piece), i));
  proofs.pieces.forEach((piece, i) => {
    const face = faceOf(piece);
    if (!proofsOfFace.has(face)) proofsOfFace.set(face, []);
    proofsOfFace.get(face).push(i);
  });
  const ends = i => [[...sight.ends.subarray(6 * i, 6 * i + 3)], [...sight.ends.subarray(6 * i + 3, 6 * i + 6)]];
  const sightline = i => { const [p, q] = ends(i); return [{from: p, to: q, colour: [...palette.front, 255], width: 3}, ...mark(p, palette.front), ...mark(q, palette.front)]; };
  const doubles = doublesOfVisible('A search in plain doubles');
  let blockers = new Set(), showAll = false;
  /// Where the part of a walk that begins at a step ends.
  const endOf = step => {
    let open = 1;
    for (; open > 0; ++step) open += proofs.kinds[step] < 3 ? 1 : -1;
    return step;
  };
  const showStep = step => {
    const k = polygons.place(proofs.of[step]);
    let lines = [];
    if (k !== undefined && proofs.kinds[step] === 3) lines = outlinesOf([k], palette.front, 4);
    if (k !== undefined && proofs.kinds[step] === 0) {
      const corners = cornersOf(k), c = proofs.corners[step];
      lines = [...outlinesOf([k], palette.other, 1.5), {from: corners[c], to: corners[(c + 1) % corners.length], colour: [...palette.front, 255], width: 5}];
    }
    setLines('step', lines, true);
  };
  const nodeOf = (step, way, depth) => {
    const kind = proofs.kinds[step], k = polygons.place(proofs.of[step]), name = k === undefined ? 'a face that is not drawn' : faceName(k);
    const what = kind === 0 ? `past an edge of ${name}` : kind === 3 ? `blocked by ${name}` : kind === 4 ? 'no line there' : kind === 5 ? 'they face away' : kind === 6 ? 'open' : `a ${kindNames[kind]}`;
    const parts = element('ul', {className: 'tree'});
    let grown = false;
    const grow = () => {
      if (kind > 2) return;
      grown = !grown;
      const first = step + 1, ways = kind === 0 ? ['on one side: ', 'on the other: '] : ['in front: ', 'behind: '];
      parts.replaceChildren(...(grown ? [nodeOf(first, ways[0], depth + 1), nodeOf(endOf(first), ways[1], depth + 1)] : []));
    };
    const item = element('li', {}, button(way + what + (kind < 3 ? ' …' : ''), () => { showStep(step); grow(); }), parts);
    if (depth < 2) grow();
    return item;
  };
  const proofOf = i => {
    const begin = proofs.begin[i], end = proofs.begin[i + 1], leaves = [];
    for (let s = begin; s < end; ++s) if (proofs.kinds[s] > 2) leaves.push(s);
    const by = new Set(leaves.filter(s => proofs.kinds[s] === 3).map(s => polygons.place(proofs.of[s])).filter(k => k !== undefined));
    by.forEach(k => blockers.add(k));
    const open = leaves.filter(s => proofs.kinds[s] === 6).length;
    return [element('p', {}, `source ${proofs.sources[i] + 1}: ${leaves.length} ${leaves.length === 1 ? 'leaf' : 'leaves'}` + (by.size > 0 ? `, blocked by ${[...by].slice(0, 12).map(faceName).join(', ')}${by.size > 12 ? ' …' : ''}` : '') + (open > 0 ? `; ${open} open` : '')),
      element('ul', {className: 'tree'}, nodeOf(begin, '', 0))];
  };
  const drawAll = () => {
    const list = [];
    if (showAll) for (let i = 0; i < Math.min(2000, sight.pieces.length); ++i) { const [p, q] = ends(i); list.push({from: p, to: q, colour: [...palette.front, 150], width: 1}); }
    setLines('all', list);
  };
  return {
    repaints: true,
    colourOf(k) {
      const role = data.groups[polygons.groups[k]].role, marked = k < base ? doubles.colourOf(k, false) : null;
      return marked ? marked : blockers.has(k) && selected >= 0 ? palette.other : palette[role];
    },
    begin() {
      setLines('sources', outlinesOf([...Array(polygons.count - base).keys()].map(k => base + k), palette.source, 2), true);
      doubles.begin();
      if (sight.pieces.length === 0) return;
      const box = element('input', {type: 'checkbox', onchange: () => { showAll = box.checked; drawAll(); }});
      section('Sightlines', element('label', {className: 'row'}, box, `all of them${sight.pieces.length > 2000 ? ', the first 2000' : ''}`),
        element('p', {className: 'faint'}, 'Click a face: its sightline, or what hides it.'));
    },
    select(k) {
      setLines('step', []), setLines('sightline', []), setLines('blockers', []);
      blockers = new Set();
      if (k < 0) return null;
      const face = polygons.faces[k], line = sightOfFace.get(face), pairs = proofsOfFace.get(face) || [];
      if (line !== undefined) {
        setLines('sightline', sightline(line), true);
        const [p, q] = ends(line).map(rounded);
        return element('div', {id: 'sightline'}, element('p', {className: 'faint'}, `Seen from source ${sight.sources[line] + 1} along the line`),
          element('ul', {className: 'exact'}, element('li', {}, 'from ' + (sight.texts[2 * line] || `${p}, rounded`)), element('li', {}, 'to ' + (sight.texts[2 * line + 1] || `${q}, rounded`))));
      }
      if (pairs.length === 0) return face === noFace ? null : element('p', {className: 'faint'}, 'There is no proof of it on this page.');
      const trees = pairs.slice(0, 50).flatMap(proofOf);
      setLines('blockers', outlinesOf([...blockers], palette.other, 2), true);
      return element('div', {id: 'proof'}, element('p', {className: 'faint'}, 'Nearly every line from the source to it is in a leaf of this tree. Click a node: its edge, or what blocks it.'), ...trees);
    },
  };
};

/// A cross about a place, of a size that is a share of the scene's.
function mark(p, colour, size = 0.012) {
  return [0, 1, 2].map(k => {
    const d = [0, 0, 0];
    d[k] = size * bounds.radius;
    return {from: minus(p, d), to: add(p, d), colour: [...colour, 255], width: 3};
  });
}

/// The path, played.
commands.cutset = () => {
  const from = data.frames, numbers = unpacked(from.numbers), cuts = unpacked(from.cut_edges), tests = unpacked(from.tests), far = unpacked(from.at_infinity), on = unpacked(from.on_view);
  const count = numbers.length, edges = data.edges ? Object.fromEntries(Object.entries(data.edges).map(([key, value]) => [key, unpacked(value)])) : null;
  const isOn = (frame, k) => bit(on, frame * polygons.of + polygons.number(k)) === 1;
  const wrong = ['missing', 'extra'].map(key => data.doubles && data.doubles[key] ? {begin: unpacked(data.doubles[key].begin), pieces: unpacked(data.doubles[key].pieces)} : {begin: [], pieces: []});
  const wrongAt = n => wrong.map(({begin, pieces}) => new Set(pieces.slice(begin[n], begin[n + 1])));
  const errsAt = [...Array(count).keys()].map(n => [n, wrong.reduce((sum, {begin}) => sum + (begin.length > 0 ? begin[n + 1] - begin[n] : 0), 0)]).filter(([, errors]) => errors > 0);
  const doubles = plainDoubles({
    who: 'A test of each plane in plain doubles', finds: 'the same faces on-view at all of these viewpoints', idOf: k => polygons.number(k),
    nameOf: n => polygons.place(n) === undefined ? 'one that is not drawn' : faceName(polygons.place(n)),
    missing: {set: new Set(), count: wrong[0].pieces.length, name: 'here off-view in doubles', words: 'times an on-view polygon is off-view'},
    extra: {set: new Set(), count: wrong[1].pieces.length, name: 'here on-view in doubles', words: 'times an off-view one is on-view'},
    more: [element('p', {className: 'faint'}, `at ${errsAt.length} of ${count} viewpoints:`), listOf(errsAt, ([n, errors]) => `viewpoint ${numbers[n]}: ${errors}`, ([n]) => {
      const slider = document.getElementById('slider');
      slider.value = n + 1;
      slider.dispatchEvent(new Event('input'));
    })],
  });
  let frame = 0, follows = false;
  const eyeLines = () => {
    const p = from.places[frame];
    if (!p || follows) return [];
    return mark(p, palette.front, 0.03).concat([{from: p, to: bounds.middle, colour: [...palette.front, 120], width: 1, dash: 8}]);
  };
  const cutLines = () => {
    const list = [];
    if (edges) edges.pieces.forEach((piece, i) => {
      const k = polygons.place(piece), other = polygons.place(edges.others[i]);
      if (k === undefined || other === undefined || isOn(frame, k) === isOn(frame, other)) return;
      const a = polygons.first[k] + edges.corners[i], b = edges.corners[i] + 1 < polygons.first[k + 1] - polygons.first[k] ? a + 1 : polygons.first[k];
      list.push({from: cornerOf(a), to: cornerOf(b), colour: [...ink, 255], width: 3});
    });
    return list;
  };
  return {
    groupsChange: true,
    colourOf: k => doubles.colourOf(k, !isOn(frame, k)) || (!isOn(frame, k) ? palette.hidden : frame > 0 && !isOn(frame - 1, k) ? palette.new : palette.seen),
    nameOf: k => isOn(frame, k) ? 'on-view' : 'off-view',
    begin() {
      const where = element('p', {id: 'viewpoint'}), what = element('p', {className: 'faint', id: 'frame'});
      const show = n => {
        frame = n - 1;
        let faces = 0;
        for (let k = 0; k < polygons.count; ++k) faces += isOn(frame, k);
        where.textContent = `${far[frame >> 3] >> (frame & 7) & 1 ? 'direction' : 'viewpoint'} ${numbers[frame]}: ${from.texts[frame]}`;
        what.textContent = `${faces} polygons on-view${polygons.count < polygons.of ? ' of those drawn' : ''}, ${cuts[frame]} edges in the cut-set, ${tests[frame]} tests`;
        setLines('cut', cutLines());
        doubles.change(...wrongAt(frame));
        follow();
        paint();
      };
      const follow = () => {
        eyePlace = follows && from.places[frame] ? eyeFor(from.places[frame]) : null;
        if (eyePlace) goToEye();
        else if (camera.atEye) goRound();
        setLines('eye', eyeLines());
      };
      const box = element('input', {type: 'checkbox', id: 'follow', onchange: () => { follows = box.checked; follow(); redraw(); }});
      const path = [];
      for (let i = 0; i + 1 < count; ++i) if (from.places[i] && from.places[i + 1]) path.push({from: from.places[i], to: from.places[i + 1], colour: [...palette.front, 110], width: 1.2});
      setLines('path', path);
      // The slider shows the first of them at once.
      section('Along the path', player('viewpoint', 1, Math.max(1, count), 1, show), where, what,
        element('label', {className: 'row'}, box, 'look from there'));
      doubles.begin();
    },
  };
};

/// Lines by the six numbers of each.
function segments(ends, colour, width) {
  const list = [];
  for (let i = 0; i < ends.length; i += 6) list.push({from: [...ends.subarray(i, i + 3)], to: [...ends.subarray(i + 3, i + 6)], colour: [...colour, 255], width});
  return list;
}

/// Cells to walk through, and leaks.
commands.cells = () => {
  const cells = new Map(data.cells.map(cell => [cell.cell, cell]));
  drawing.backs = false;
  // Faces that look into rooms, where there are rooms: outer walls would hide them.
  const rooms = new Set(data.cells.filter(cell => cell.kind === 'room').flatMap(cell => [...unpacked(cell.faces)]));
  let chosen = null, seen = new Set(), showAll = rooms.size === 0;
  const where = element('div', {id: 'cell'});
  const choose = cell => {
    chosen = cell, seen = new Set(unpacked(cell.faces));
    setLines('cell', segments(unpacked(cell.walls), palette.source, 2), true);
    setLines('portals', segments(unpacked(cell.portals), palette.new, 4), true);
    const next = [...new Set(unpacked(cell.neighbours))];
    where.replaceChildren(element('p', {}, `cell ${cell.cell}, ${cell.kind}, about ${cell.inside}: ${seen.size} faces look into it`),
      element('p', {className: 'faint'}, next.length > 0 ? 'Through its portals, which are green:' : 'It has no portal.'),
      listOf(next.map(n => cells.get(n)).filter(Boolean), n => `cell ${n.cell}, ${n.kind}`, choose));
    paint();
  };
  return {
    colourOf: k => chosen && seen.has(polygons.faces[k]) ? palette.seen : palette.face,
    isShown: k => showAll || rooms.has(polygons.faces[k]) || seen.has(polygons.faces[k]),
    begin() {
      const box = element('input', {type: 'checkbox', checked: showAll, onchange: () => { showAll = box.checked; paint(); }});
      section('Shown', element('label', {className: 'row'}, box, 'faces too that look into no room'));
      section('Cell', where);
      section('All cells', listOf(data.cells, cell => `cell ${cell.cell}, ${cell.kind}`, choose, 1000));
      if (data.leaks.length > 0) section('Ways out', listOf(data.leaks, leak => `from ${leak.from}, through ${unpacked(leak.cells).length} cells`, leak => {
        const way = unpacked(leak.way), list = [];
        for (let i = 0; i + 5 < way.length; i += 3) list.push({from: [...way.subarray(i, i + 3)], to: [...way.subarray(i + 3, i + 6)], colour: [...palette.front, 255], width: 4});
        setLines('way', list, true);
      }));
      if (data.cells.length > 0) choose(data.cells[0]);
    },
  };
};

/// What a cell sees.
commands.pvs = () => {
  const cells = data.cells.map(cell => ({...cell, visible: new Set(unpacked(cell.visible)), undecided: new Set(unpacked(cell.undecided)), walls: unpacked(cell.walls)}));
  const rooms = new Set(unpacked(data.rooms));
  let chosen = cells.length > 0 ? cells[0] : null, showAll = false;
  drawing.backs = false;
  const stateOf = k => chosen && chosen.visible.has(polygons.faces[k]) ? 0 : chosen && chosen.undecided.has(polygons.faces[k]) ? 2 : 1;
  const choose = cell => {
    chosen = cell;
    setLines('cell', segments(cell.walls, palette.source, 2.5), true);
    document.getElementById('cell').textContent = `cell ${cell.cell} about ${cell.inside}: sees ${cell.visible.size} faces` + (cell.undecided.size > 0 ? `, ${cell.undecided.size} undecided` : '');
    paint();
  };
  return {
    groupsChange: true,
    colourOf: k => palette[data.groups[stateOf(k)].role],
    isShown: k => showAll || rooms.has(polygons.faces[k]),
    nameOf: k => data.groups[stateOf(k)].name,
    begin() {
      const box = element('input', {type: 'checkbox', onchange: () => { showAll = box.checked; paint(); }});
      section('Shown', element('label', {className: 'row'}, box, 'faces too that look into no cell that is asked about'));
      section('Cells', element('p', {id: 'cell'}), listOf(cells, cell => `cell ${cell.cell}: ${cell.visible.size} faces`, choose, 1000));
      if (chosen) choose(chosen);
    },
    select(k) {
      if (k < 0) return null;
      const by = cells.filter(cell => cell.visible.has(polygons.faces[k]));
      return element('div', {id: 'seen-from'}, element('p', {className: 'faint'}, `Seen from ${by.length} of ${cells.length} cells:`), listOf(by, cell => `cell ${cell.cell}`, choose, 200));
    },
  };
};

/// Faces in the colours of their solids.
commands.boolean = () => {
  const faces = unpacked(data.operand_faces);
  return {nameOf: k => faces.length > 0 ? `face ${faces[polygons.number(k)]} of its solid` : ''};
};

/// Who was asked, what it took, and the faces that each has wrong.
commands.compare = () => {
  const visible = data.visible ? new Set(unpacked(data.visible)) : null;
  const methods = data.methods.map(one => ({...one, said: Boolean(one.missing), missing: new Set(one.missing ? unpacked(one.missing) : []), extra: new Set(one.extra ? unpacked(one.extra) : [])}));
  let chosen = null;
  const stateOf = k => {
    const face = polygons.faces[k];
    return !chosen || !chosen.said ? (visible.has(face) ? 0 : 1) : chosen.missing.has(face) ? 2 : chosen.extra.has(face) ? 3 : visible.has(face) ? 0 : 1;
  };
  const judged = new Set(['pairs', 'sides_asked']);  // how many, right or wrong
  const errorsOf = one => Object.entries(one.errors || {}).filter(([key, value]) => typeof value === 'number' && value !== 0 && !judged.has(key)).map(([key, value]) => `${key.replaceAll('_', ' ')} ${Number(value.toPrecision(3))}`).join(', ');
  const where = element('p', {id: 'method'});
  const saidOf = one => one.status !== 'done' ? one.status : `${one.seconds.toPrecision(2)} s, ${(one.peak_bytes / 1e6).toFixed(1)} MB${errorsOf(one) ? '; ' + errorsOf(one) : ''}`;
  const list = listOf(methods, one => `${one.name}: ${saidOf(one)}`, one => choose(one));
  const choose = one => {
    chosen = one;
    where.textContent = `${one.name}: ${one.said ? `${one.missing.size} faces are missing, ${one.extra.size} too many` : saidOf(one)}`;
    list.querySelectorAll('button').forEach((made, i) => made.setAttribute('aria-pressed', methods[i] === one));
    paint();
  };
  return {
    groupsChange: true,
    beginsAtEye: Boolean(data.eye),
    colourOf: visible ? k => palette[data.groups[stateOf(k)].role] : k => colourOfFace(polygons.faces[k]),
    nameOf: k => visible ? data.groups[stateOf(k)].name : '',
    begin() {
      section('Seconds and errors', where, element('div', {id: 'methods'}, list));
      if (methods.length > 0) choose(methods[0]);
    },
  };
};

/// What an answer has wrong, and the line that refutes it: dashed beyond what it meets.
commands.judge = commands.report = () => {
  const line = data.refutation, source = polygons.faces.indexOf(noFace);  // which comes after all faces
  drawing.base = Math.max(0, source);
  const withHalo = list => [...list.map(one => ({...one, colour: [255, 255, 255, 255], width: one.width + 3})), ...list];  // on faces and paper of any colour
  return {
    begin() {
      if (source >= 0) setLines('source', outlinesOf([source], palette.source, 2), true);
      if (eyePlace) setLines('eye', withHalo(mark(eyePlace, ink, 0.04)), true);
      if (!line) return;
      const [from, to, at] = [line.from, line.to, line.at || line.to];
      setLines('refutation', withHalo([{from, to: at, colour: [...ink, 255], width: 3}, {from: at, to, colour: [...ink, 255], width: 2, dash: 9}, ...mark(at, ink, 0.02), ...mark(to, ink, 0.02)]), true);
      section('Why it is wrong', element('p', {id: 'why'}, line.words));
    },
  };
};
