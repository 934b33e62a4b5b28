// The 3D view of a report: draws the frames that the page carries (packed.py) with three.js. Spheres and bonds are one quad each (shaders.js),
// so that ten thousand of them turn smoothly and a cut through them is exact.
(function () {
'use strict';
const $ = id => document.getElementById(id), page = JSON.parse($('view-data').textContent);
const canvas = $('canvas'), note = $('view-note'), details = $('details');
const KINDS = {f4: Float32Array, u4: Uint32Array, u2: Uint16Array, u1: Uint8Array};
const prefix = (value, unit) => {  // 1.2e-10 N as 0.12 nN
  const size = Math.abs(value);
  if (!isFinite(value)) return 'not known';
  if (size === 0) return '0 ' + unit;
  const steps = [[1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n'], [1e-12, 'p'], [1e-15, 'f']];
  const [factor, letter] = steps.find(([f]) => size >= f) || steps[steps.length - 1];
  return (value / factor).toPrecision(3).replace('-', '−') + ' ' + letter + unit;
};
const length = nm => Math.abs(nm) >= 1000 ? (nm / 1000).toPrecision(4) + ' µm' : nm.toPrecision(4) + ' nm';
const fail = why => { note.textContent = why; note.hidden = false; $('view').classList.add('without'); };

// ---- The arrays of a file -------------------------------------------------------------------------------------------------

async function unpack(head) {
  if (head.buffer) return head;
  const text = atob($(head.block).textContent.trim());
  const bytes = Uint8Array.from(text, c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  head.buffer = await new Response(stream).arrayBuffer();
  const array = ([kind, at, size]) => new KINDS[kind](head.buffer, at, size);
  const open = entry => { for (const key in entry) if (Array.isArray(entry[key])) entry[key] = array(entry[key]); };
  head.radius = array(head.radius);
  head.id = array(head.id);
  head.frames.forEach(open);
  return head;
}

// ---- Drawing --------------------------------------------------------------------------------------------------------------

let renderer, camera, target;
const shared = {plane: {value: null}, depth: {value: 1}, picking: {value: 0}, centre: {value: null}, turn: {value: null},
                half_: {value: null}, scale: {value: 1}, thick: {value: 1}};
const CORNERS = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], TRIANGLES = [0, 1, 2, 0, 2, 3];

// Four corners a thing, each with the thing's numbers. Instances of one quad would be a quarter of the memory, but graphics chips take
// things of two triangles one by one, and software rendering spends a tenth of a millisecond on each.
function quads(shader, more) {
  const material = new THREE.ShaderMaterial(Object.assign({uniforms: shared, extensions: {fragDepth: true}, side: THREE.DoubleSide}, shader, more));
  const mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
  mesh.frustumCulled = false;
  return mesh;
}
const attach = (mesh, name, array, width, normalized) => (mesh.geometry.setAttribute || mesh.geometry.addAttribute)
  .call(mesh.geometry, name, new THREE.BufferAttribute(array, width, !!normalized));
// Arrays of the same length are filled in place: only a change of number makes new buffers.
function fill(mesh, name, values, width, normalized) {
  const old = mesh.geometry.attributes[name], same = old && old.array.length === 4 * values.length;
  const out = same ? old.array : new (normalized ? Uint8Array : Float32Array)(4 * values.length);
  for (let k = 0; k < values.length; ++k) {
    const item = Math.floor(k / width), at = 4 * width * item + k - width * item;
    for (let corner = 0; corner < 4; ++corner) out[at + corner * width] = values[k];
  }
  if (same) old.needsUpdate = true; else attach(mesh, name, out, width, normalized);
}
function count(mesh, n) {
  mesh.visible = n > 0;
  if (mesh.things === n || n === 0) return;
  mesh.things = n;
  attach(mesh, 'position', Float32Array.from({length: 12 * n}, (_, k) => CORNERS[k % 12]), 3);
  mesh.geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from({length: 6 * n}, (_, k) => 4 * Math.floor(k / 6) + TRIANGLES[k % 6]), 1));
}
const numbers = (n, kind) => {  // 1 to n in two bytes and a half, the kind in the rest
  const out = new Uint8Array(3 * n);
  for (let k = 0; k < n; ++k) out.set([(k + 1) & 255, ((k + 1) >> 8) & 255, (((k + 1) >> 16) & 127) | (kind << 7)], 3 * k);
  return out;
};

// ---- State ------------------------------------------------------------------------------------------------------------------

const state = {file: null, frame: 0, colour: 'distance', size: 1, bonds: false, droplet: true, cut: 0, cutAlong: 'viewer', zoom: 1,
               playing: false, chosen: null};
let rotation, spheres, bonds, droplet, scene, drawn = 0, asked = false, extent = 1, depth = 1, ranges = {};
const frame = () => state.file.frames[state.frame];

function centreOf(f) {
  const c = [0, 0, 0], n = f.position.length / 3;
  if (f.droplet_radius > 0) return c;  // the droplet stays in the middle
  for (let k = 0; k < f.position.length; ++k) c[k % 3] += f.position[k] / n;
  return c;
}
function reachOf(file, f) {
  const c = centreOf(f);
  let most = 0;
  for (let p = 0; p < file.radius.length; ++p)
    most = Math.max(most, file.radius[p] + Math.hypot(f.position[3 * p] - c[0], f.position[3 * p + 1] - c[1], f.position[3 * p + 2] - c[2]));
  return Math.max(most, f.droplet_radius || 0);
}

// ---- Colours ------------------------------------------------------------------------------------------------------------------

const shade = (map, t) => map[Math.max(0, Math.min(map.length - 1, Math.round(t * (map.length - 1))))];
const GREY = [188, 188, 188], CHOSEN = [255, 0, 255];
const isBond = colour => colour === 'tension' || colour.startsWith('load ');
const bondColour = () => isBond(state.colour) ? state.colour : 'tension';

function distances() {
  const f = frame(), c = centreOf(f);
  return Float32Array.from(state.file.radius, (_, p) => Math.hypot(f.position[3 * p] - c[0], f.position[3 * p + 1] - c[1], f.position[3 * p + 2] - c[2]));
}
function rangeOf(what) {  // over all frames, so that colours mean the same in each
  if (ranges[what]) return ranges[what];
  let low = Infinity, high = -Infinity;
  const file = state.file;
  if (what === 'radius') for (const a of file.radius) { low = Math.min(low, a); high = Math.max(high, a); }
  else if (what === 'distance') {  // of this frame: a droplet shrinks
    const d = distances();
    return {low: d.reduce((a, b) => Math.min(a, b)), high: d.reduce((a, b) => Math.max(a, b))};
  }
  else if (what === 'coordination') { low = 0; for (const f of file.frames) for (const z of f.coordination) high = Math.max(high, z); }
  else {  // forces: symmetric; the strongest hundredth shares the end of the scale
    const all = [];
    for (const f of file.frames) if (f[what]) for (const t of f[what]) if (isFinite(t)) all.push(Math.abs(t));
    all.sort((a, b) => a - b);
    high = all.length ? all[Math.floor(0.99 * (all.length - 1))] || 1e-30 : 1e-30;
    low = -high;
  }
  return ranges[what] = {low, high};
}
function particleColours() {
  const file = state.file, f = frame(), n = file.radius.length, out = new Uint8Array(3 * n), what = state.colour;
  const range = isBond(what) || what === 'fragment' ? null : rangeOf(what);
  const values = {radius: file.radius, coordination: f.coordination, distance: what === 'distance' ? distances() : null}[what];
  for (let p = 0; p < n; ++p) {
    let colour = GREY;
    if (what === 'fragment') colour = page.fragments[Math.min(f.fragment[p], page.fragments.length - 1)];
    else if (range) colour = shade(page.sequential, range.high > range.low ? (values[p] - range.low) / (range.high - range.low) : 0.5);
    if (state.chosen && state.chosen.kind === 0 && state.chosen.row === p) colour = CHOSEN;
    out.set(colour, 3 * p);
  }
  return out;
}
function bondColours() {
  const f = frame(), tension = f[bondColour()] || f.tension, {high} = rangeOf(bondColour());
  const out = new Uint8Array(3 * tension.length);
  for (let k = 0; k < tension.length; ++k) {
    let colour = isFinite(tension[k]) ? shade(page.diverging, 0.5 + 0.5 * tension[k] / high) : GREY;
    if (state.chosen && state.chosen.kind === 1 && state.chosen.row === k) colour = CHOSEN;
    out.set(colour, 3 * k);
  }
  return out;
}
function legend() {
  const bar = (map, low, high, what) => `<span>${low}</span><span class="bar" style="background:linear-gradient(90deg,${
    map.map(c => `rgb(${c})`).join()})"></span><span>${high}</span><span>${what}</span>`;
  const parts = [];
  if (!isBond(state.colour)) {
    if (state.colour === 'fragment') {
      const names = ['largest', 'second', 'third', 'fourth', 'fifth', 'sixth', 'smaller'];
      const most = frame().fragment.reduce((a, b) => Math.max(a, b), 0);
      parts.push(page.fragments.slice(0, most + 1).map((c, k) => `<span class="dot" style="background:rgb(${c})"></span><span>${names[k]}</span>`).join('') + '<span>fragment</span>');
    } else {
      const {low, high} = rangeOf(state.colour);
      const show = state.colour === 'coordination' ? String : length;
      parts.push(bar(page.sequential, show(low), show(high), {radius: 'particle radius', distance: 'distance from the middle', coordination: 'contacts'}[state.colour]));
    }
  }
  if (state.bonds) {
    const {high} = rangeOf(bondColour());
    parts.push(bar(page.diverging, '≤ ' + prefix(-high, 'N'), '≥ ' + prefix(high, 'N'), 'contact: pressed … pulled'));
  }
  $('legend').innerHTML = parts.map(p => `<div>${p}</div>`).join('');
}

// ---- Frames and drawing -----------------------------------------------------------------------------------------------------------

function setFrame(k) {
  const file = state.file;
  state.frame = Math.max(0, Math.min(file.frames.length - 1, k));
  const f = frame(), c = centreOf(f);
  shared.centre.value.set(...c);
  fill(spheres, 'place', f.position, 3);
  if (state.chosen && state.chosen.kind === 1) state.chosen = null;  // contacts of another frame are others
  const m = f.pair.length / 2;
  if (state.bonds) {
    const start = new Float32Array(3 * m), end = new Float32Array(3 * m);
    for (let k = 0; k < m; ++k) for (let d = 0; d < 3; ++d) {
      start[3 * k + d] = f.position[3 * f.pair[2 * k] + d];
      end[3 * k + d] = f.position[3 * f.pair[2 * k + 1] + d];
    }
    fill(bonds, 'start', start, 3);
    fill(bonds, 'end', end, 3);
    if (!bonds.geometry.attributes.number || bonds.geometry.attributes.number.array.length !== 12 * m) fill(bonds, 'number', numbers(m, 1), 3, true);
  }
  count(bonds, state.bonds ? m : 0);
  fill(droplet, 'size', [f.droplet_radius || 1], 1);
  count(droplet, state.droplet && f.droplet_radius > 0 ? 1 : 0);
  $('frame').value = state.frame;
  const of = file.frames_in_file > file.frames.length ? ` (every so many of the ${file.frames_in_file} in the file)` : '';
  $('frame-text').textContent = `frame ${f.number} of ${file.frames_in_file - 1}, t = ${prefix(f.time, 's')}` +
    (f.flow_stress === undefined ? '' : `, µγ̇ = ${f.flow_stress.toPrecision(4)} Pa`) +
    (f.droplet_radius > 0 ? `, droplet ${length(f.droplet_radius)}` : '') + of;
  recolour();
}
function recolour() {
  fill(spheres, 'tint', particleColours(), 3, true);
  if (state.bonds) fill(bonds, 'tint', bondColours(), 3, true);
  legend();
  describe();
  draw();
}
// While the picture changes it is drawn as finely as the machine manages twenty times a second; a quarter of a second later as finely as
// the screen is.
let resting = true, fineness = 1, rest = 0, last = 0;
function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(now => {
    asked = false;
    const took = now - last;
    last = now;
    if (!resting && took < 2000) fineness = Math.max(0.3, Math.min(1, fineness * (took > 50 ? 0.8 : took < 25 ? 1.1 : 1)));
    resting = false;
    drawNow();
    clearTimeout(rest);
    rest = setTimeout(() => { resting = true; drawNow(); }, 250);
  });
}
function plane() {
  // The half space n·x > w is taken away; n in the view's axes.
  const n = state.cutAlong === 'viewer' ? new THREE.Vector3(0, 0, 1)
    : new THREE.Vector3(+(state.cutAlong === 'x'), +(state.cutAlong === 'y'), +(state.cutAlong === 'z')).applyMatrix3(shared.turn.value);
  const w = state.cut > 0 ? extent * (1 - 2 * state.cut / 100) : 1e9;
  return new THREE.Vector4(n.x, n.y, n.z, w);
}
function aim() {
  const wide = canvas.clientWidth || 1, high = canvas.clientHeight || 1, ratio = Math.min(2, window.devicePixelRatio || 1) * (resting ? 1 : fineness);
  if (canvas.width !== Math.round(wide * ratio) || canvas.height !== Math.round(high * ratio)) {
    renderer.setPixelRatio(ratio);
    renderer.setSize(wide, high, false);
  }
  const half = 1.05 * extent / state.zoom, aspect = wide / high;
  shared.half_.value.set(half * Math.max(1, aspect), half * Math.max(1, 1 / aspect));
  shared.turn.value.setFromMatrix4(new THREE.Matrix4().makeRotationFromQuaternion(rotation));
  shared.depth.value = depth;
  shared.scale.value = state.size;
  shared.plane.value = plane();
}
function drawNow() {
  if (!state.file) return;
  aim();
  shared.picking.value = 0;
  renderer.setRenderTarget(null);
  renderer.setClearColor(0xffffff, 1);
  renderer.render(scene, camera);
  ++drawn;
  const bar = 10 ** Math.floor(Math.log10(shared.half_.value.x)), per = canvas.clientWidth / (2 * shared.half_.value.x);
  $('scale-bar').style.width = bar * per + 'px';
  $('scale-text').textContent = bar >= 1000 ? bar / 1000 + ' µm' : bar + ' nm';
}

// ---- What is under the pointer ---------------------------------------------------------------------------------------------------

function pick(x, y) {
  resting = true;
  aim();
  const wide = canvas.width, high = canvas.height, ratio = wide / canvas.clientWidth;
  if (!target || target.width !== wide || target.height !== high) target = new THREE.WebGLRenderTarget(wide, high);
  const was = droplet.visible, pixel = new Uint8Array(4);
  droplet.visible = false;
  shared.picking.value = 1;
  renderer.setRenderTarget(target);
  renderer.setClearColor(0x000000, 0);
  renderer.clear();
  renderer.render(scene, camera);
  renderer.readRenderTargetPixels(target, Math.round(x * ratio), high - 1 - Math.round(y * ratio), 1, 1, pixel);
  droplet.visible = was;
  renderer.setRenderTarget(null);
  const number = pixel[0] | pixel[1] << 8 | (pixel[2] & 127) << 16;
  choose(number && pixel[3] ? {kind: pixel[2] >> 7, row: number - 1} : null);
  drawNow();
}
function choose(what) {
  state.chosen = what;
  recolour();
}
function describe() {
  const file = state.file, f = frame(), chosen = state.chosen;
  if (!chosen) { details.textContent = 'Click a particle or a contact for its numbers.'; return; }
  const rows = [];
  if (chosen.kind === 0) {
    const p = chosen.row, x = [0, 1, 2].map(d => f.position[3 * p + d].toPrecision(5));
    rows.push(['particle', file.id[p]], ['radius', length(file.radius[p])], ['centre', `${x.join(', ')} nm`], ['contacts', f.coordination[p]],
              ['fragment', f.fragment[p] === 0 ? '0 (the largest)' : f.fragment[p]]);
    for (let k = 0; k < f.tension.length; ++k)
      if (f.pair[2 * k] === p || f.pair[2 * k + 1] === p)
        rows.push([`contact with ${file.id[f.pair[2 * k] === p ? f.pair[2 * k + 1] : f.pair[2 * k]]}`, `tension ${prefix(f.tension[k], 'N')}`]);
  } else {
    const k = chosen.row, limits = ['sliding', 'twisting', 'rolling'].filter((_, b) => f.limit[k] >> b & 1);
    rows.push(['contact of', `${file.id[f.pair[2 * k]]} and ${file.id[f.pair[2 * k + 1]]}`], ['tension', prefix(f.tension[k], 'N')],
              ['gap', `${f.gap[k].toPrecision(3)} nm`], ['at its limit of', limits.join(', ') || 'none']);
    for (const name in file.loads) rows.push([name, `${prefix(f['load ' + name][k], 'N')} (${file.loads[name]})`]);
  }
  details.innerHTML = '<table>' + rows.map(r => `<tr><th scope="row">${r[0]}</th><td>${r[1]}</td></tr>`).join('') + '</table>';
}

// ---- Controls --------------------------------------------------------------------------------------------------------------------

function turn(across, up) {
  const q = new THREE.Quaternion().setFromEuler(new THREE.Euler(up, across, 0));
  rotation.premultiply(q);
  draw();
}
const zoom = factor => { state.zoom = Math.max(0.05, Math.min(50, state.zoom * factor)); draw(); };
function fit() { extent = reachOf(state.file, frame()); depth = 2 * Math.max(...state.file.frames.map(f => reachOf(state.file, f))); state.zoom = 1; draw(); }
function setCut(value) { state.cut = Math.max(0, Math.min(100, +value)); $('cut').value = state.cut; draw(); }
function setColour(value) {
  state.colour = value;
  $('colour').value = value;
  if (isBond(value)) { setBonds(true); } else recolour();
}
function setBonds(on) {
  state.bonds = on;
  $('bonds').checked = on;
  state.size = on ? 0.4 : 1;
  $('size').value = 100 * state.size;
  setFrame(state.frame);
}
function play(on) {
  state.playing = on && state.file.frames.length > 1;
  $('play').textContent = state.playing ? 'Pause' : 'Play';
  $('play').setAttribute('aria-pressed', state.playing);
  if (state.playing) step();
}
let before = 0;
function step(now) {
  if (!state.playing) return;
  if (now === undefined || now - before > 1000 / +$('speed').value) {
    before = now || 0;
    setFrame(state.frame + 1 < state.file.frames.length ? state.frame + 1 : 0);
  }
  requestAnimationFrame(step);
}
function look() { rotation.setFromEuler(new THREE.Euler(-Math.PI / 2, 0, 0)); state.zoom = 1; setCut(0); fit(); }  // along y, z up: as in the pictures

async function openFile(index) {
  play(false);
  note.textContent = 'Unpacking …';
  note.hidden = false;
  state.file = await unpack(page.files[index]);
  note.hidden = true;
  ranges = {};
  state.chosen = null;
  const file = state.file, n = file.radius.length;
  fill(spheres, 'size', file.radius, 1);
  fill(spheres, 'number', numbers(n, 0), 3, true);
  count(spheres, n);
  fill(droplet, 'place', [0, 0, 0], 3);
  fill(droplet, 'tint', [70, 140, 200], 3, true);
  fill(droplet, 'number', [0, 0, 0], 3, true);
  shared.thick.value = 0.16 * file.radius.reduce((a, b) => a + b, 0) / n;
  $('frame').max = file.frames.length - 1;
  for (const id of ['frame', 'play', 'speed']) $(id).disabled = file.frames.length < 2;
  const loads = Object.keys(file.loads).map(name => [`load ${name}`, `tension in ${name}`]);
  $('colour').innerHTML = [['distance', 'distance from the middle'], ['radius', 'particle radius'], ['coordination', 'coordination'], ['fragment', 'fragment'],
                           ['tension', 'tension'], ...loads].map(([v, t]) => `<option value="${v}">${t}</option>`).join('');
  state.colour = loads.length ? loads[0][0] : file.stage === 'breaker' ? 'fragment' : 'distance';
  $('colour').value = state.colour;
  state.frame = file.stage === 'breaker' ? 0 : file.frames.length - 1;
  fit();
  setBonds(isBond(state.colour));
  $('droplet-label').hidden = !file.frames.some(f => f.droplet_radius > 0);
  canvas.setAttribute('aria-label', `3D view of ${file.name}: ${n} particles. Arrow keys turn, + and - zoom, C and V cut, space plays, comma and full stop step, Home resets.`);
}

function listen() {
  const on = (id, event, act) => $(id).addEventListener(event, act);
  const pointers = new Map();
  let moved = 0, apart = 0;
  on('canvas', 'pointerdown', e => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.offsetX, e.offsetY]); moved = 0; apart = 0; });
  on('canvas', 'pointermove', e => {
    const was = pointers.get(e.pointerId);
    if (!was) return;
    pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
    const dx = e.offsetX - was[0], dy = e.offsetY - was[1];
    moved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 1) turn(dx * 0.01, dy * 0.01);
    else {
      const [a, b] = [...pointers.values()], now = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (apart > 0) zoom(now / apart);
      apart = now;
    }
  });
  const up = e => { if (pointers.delete(e.pointerId) && e.type === 'pointerup' && moved < 4) pick(e.offsetX, e.offsetY); apart = 0; };
  on('canvas', 'pointerup', up);
  on('canvas', 'pointercancel', up);
  canvas.addEventListener('wheel', e => { e.preventDefault(); zoom(Math.exp(-e.deltaY * 0.0015)); }, {passive: false});
  const keys = {ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, -0.1), ArrowDown: () => turn(0, 0.1),
                '+': () => zoom(1.15), '=': () => zoom(1.15), '-': () => zoom(1 / 1.15), c: () => setCut(state.cut + 5), v: () => setCut(state.cut - 5),
                b: () => setBonds(!state.bonds), ' ': () => play(!state.playing), ',': () => setFrame(state.frame - 1), '.': () => setFrame(state.frame + 1), Home: look};
  on('canvas', 'keydown', e => { const act = keys[e.key]; if (act && !e.ctrlKey && !e.metaKey && !e.altKey) { e.preventDefault(); act(); } });
  on('file', 'change', e => openFile(+e.target.value));
  on('colour', 'change', e => setColour(e.target.value));
  on('bonds', 'change', e => setBonds(e.target.checked));
  on('droplet', 'change', e => { state.droplet = e.target.checked; setFrame(state.frame); });
  on('size', 'input', e => { state.size = e.target.value / 100; draw(); });
  on('cut', 'input', e => setCut(e.target.value));
  on('cut-along', 'change', e => { state.cutAlong = e.target.value; draw(); });
  on('frame', 'input', e => { play(false); setFrame(+e.target.value); });
  on('play', 'click', () => play(!state.playing));
  on('reset', 'click', look);
  on('closer', 'click', () => zoom(1.25));
  on('farther', 'click', () => zoom(0.8));
  on('find', 'change', e => { const row = state.file.id.indexOf(+e.target.value); choose(row < 0 || e.target.value === '' ? null : {kind: 0, row}); });
  window.addEventListener('resize', draw);
  window.addEventListener('beforeprint', () => { resting = true; drawNow(); });
  canvas.addEventListener('webglcontextlost', e => { e.preventDefault(); fail('The graphics context was lost; load the page again.'); });
}

function start() {
  if (typeof THREE === 'undefined') return fail(page.without);
  if (typeof DecompressionStream === 'undefined') return fail('This browser is too old for the 3D view (it lacks DecompressionStream); numbers and figures follow.');
  const context = canvas.getContext('webgl2', {antialias: false, preserveDrawingBuffer: true});
  try {
    renderer = new THREE.WebGLRenderer(Object.assign({canvas, antialias: false, preserveDrawingBuffer: true}, context ? {context} : {}));
  } catch (error) { return fail('This browser has no WebGL, so there is no 3D view; numbers and figures follow.'); }
  camera = new THREE.Camera();
  scene = new THREE.Scene();
  rotation = new THREE.Quaternion();
  Object.assign(shared.centre, {value: new THREE.Vector3()});
  Object.assign(shared.turn, {value: new THREE.Matrix3()});
  Object.assign(shared.half_, {value: new THREE.Vector2(1, 1)});
  shared.plane.value = new THREE.Vector4(0, 0, 1, 1e9);
  spheres = quads(SPHERE);
  bonds = quads(BOND);
  // The glass is not scaled with the particles, and writes no depth of its own.
  droplet = quads(DROPLET, {uniforms: Object.assign({}, shared, {scale: {value: 1}}), transparent: true, depthWrite: false, depthTest: false});
  droplet.renderOrder = 1;
  scene.add(spheres, bonds, droplet);
  rotation.setFromEuler(new THREE.Euler(-Math.PI / 2, 0, 0));
  listen();
  openFile(0).then(() => { document.documentElement.dataset.view = 'ready'; }, error => fail(`The 3D view failed: ${error.message}`));
}
// For tests: what is shown, and how long a draw takes.
window.crumbleView = {state, get drawn() { return drawn; }, get calls() { return renderer.info.render.calls; }, get resting() { return resting && !asked; },
  time(times, part = 1) {
    const gl = renderer.getContext(), pixel = new Uint8Array(4), start = performance.now();
    resting = part === 1;
    fineness = part;
    for (let k = 0; k < times; ++k) { rotation.premultiply(new THREE.Quaternion(0.02, 0.03, 0, 1).normalize()); drawNow(); gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); }
    return (performance.now() - start) / times;
  }};
start();
})();
