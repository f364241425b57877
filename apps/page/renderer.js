// ---- Drawing, by WebGL 2

const canvas = document.getElementById('view');
const isLarge = triangles.count > 30000;  // neither outlines nor smooth borders, which would take a software renderer twice as long
let gl = canvas.getContext('webgl2', {antialias: !isLarge, alpha: false});

const faceVertex = outlined => `#version 300 es
precision highp float;
layout(location = 0) in vec3 place; layout(location = 1) in vec4 look;
uniform mat4 matrix;
flat out vec3 colour;
${outlined ? 'layout(location = 2) in vec4 sides; out vec3 side;' : ''}
void main() {
  colour = look.rgb;
  ${outlined ? 'side = sides.xyz;' : ''}
  gl_Position = look.a < 0.5 ? vec4(2.0, 2.0, 2.0, 1.0) : matrix * vec4(place, 1.0);
}`;
const faceFragment = outlined => `#version 300 es
precision highp float;
flat in vec3 colour;
${outlined ? 'in vec3 side;' : ''}
out vec4 pixel;
void main() {
  vec3 c = gl_FrontFacing ? colour : mix(colour, vec3(dot(colour, vec3(0.33))), 0.55) * 0.8;
  ${outlined ? `
  vec3 width = max(fwidth(side), vec3(1e-6));
  vec3 line = (1.0 - smoothstep(0.4, 1.4, side / width)) * clamp(1.5 - 2.5 * width, 0.0, 1.0);
  c = mix(c, vec3(0.08, 0.08, 0.1), 0.6 * max(line.x, max(line.y, line.z)));` : ''}
  pixel = vec4(c, 1.0);
}`;
const lineVertex = `#version 300 es
precision highp float;
in vec3 from; in vec3 to; in vec4 paint; in vec2 kind;
uniform mat4 matrix; uniform vec2 size; uniform float bias; uniform float near;
flat out vec4 colour; flat out float dash; out vec2 along;
// An end no farther from the canvas than four times its size: of a line that comes from beside the eye the rest is millions of pixels long, and rasterizers lose all of it.
vec4 brought(vec4 p, vec4 q) {
  for (int i = 0; i < 4; ++i) {
    float s = i < 2 ? 1.0 : -1.0, a = 4.0 * p.w - s * p[i & 1], b = 4.0 * q.w - s * q[i & 1];
    if (a < 0.0 && b > 0.0) p = mix(p, q, a / (a - b));
  }
  return p;
}
void main() {
  vec4 p = matrix * vec4(from, 1.0), q = matrix * vec4(to, 1.0);
  if (p.w < near) p = mix(p, q, clamp((near - p.w) / max(q.w - p.w, 1e-12), 0.0, 1.0));
  if (q.w < near) q = mix(q, p, clamp((near - q.w) / max(p.w - q.w, 1e-12), 0.0, 1.0));
  p = brought(p, q), q = brought(q, p);
  vec2 a = p.xy / p.w * size, b = q.xy / q.w * size, d = b - a;
  float l = length(d);
  vec2 normal = l > 1e-6 ? vec2(-d.y, d.x) / l : vec2(0.0, 1.0);
  int corner = gl_VertexID % 6;  // of two triangles
  bool last = corner == 2 || corner == 4 || corner == 5;
  vec4 c = last ? q : p;
  c.xy += (corner == 0 || corner == 2 || corner == 4 ? -1.0 : 1.0) * 0.5 * kind.x * normal / size * c.w;
  c.z -= bias * max(2e-3 * near, 6e-7 * c.w);  // by a thousandth of the way to it, but no less than depths are told apart by
  c.z = min(c.z, 0.999999 * c.w);  // lines may lead beyond all faces
  along = vec2(last ? l * c.w : 0.0, c.w);
  colour = paint;
  dash = kind.y;
  gl_Position = max(p.w, q.w) < near ? vec4(2.0, 2.0, 2.0, 1.0) : c;
}`;
const lineFragment = `#version 300 es
precision highp float;
flat in vec4 colour; flat in float dash; in vec2 along;
out vec4 pixel;
void main() {
  if (dash > 0.0 && mod(along.x / along.y, dash) > 0.55 * dash) discard;
  pixel = vec4(colour.rgb * colour.a, colour.a);
}`;
const sphereVertex = `#version 300 es
out vec2 at;
void main() {
  at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(at, 0.0, 1.0);
}`;
const sphereFragment = `#version 300 es
precision highp float;
in vec2 at;
uniform samplerCube around; uniform float yaw; uniform mat3 frame;
out vec4 pixel;
void main() {
  float a = yaw - 3.14159265 * at.x, b = 1.57079633 * at.y;
  pixel = texture(around, vec3(cos(b) * cos(a), cos(b) * sin(a), sin(b)) * frame);
}`;

function programOf(vertex, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
    gl.deleteShader(shader);  // the program keeps it as long as it is there
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
  const at = {program};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(program, i).name;
    at[name] = gl.getUniformLocation(program, name);
  }
  return at;
}
function attribute(program, name, array, size) {
  const at = gl.getAttribLocation(program.program, name);
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(at);
  gl.vertexAttribPointer(at, size, array instanceof Float32Array ? gl.FLOAT : gl.UNSIGNED_BYTE, !(array instanceof Float32Array), 0, 0);
  return buffer;
}

// ---- What there is to draw

const looks = new Uint8Array(4 * polygons.count);              // colour, and whether it is shown, of each polygon
const looksOfCorners = new Uint32Array(3 * triangles.count);  // the same for each corner of each triangle
const drawing = {
  from: 0, to: polygons.count,  // polygons
  base: 0,                      // so many of the first lie beneath those that follow
  outlines: !isLarge, backs: true,
  painter: false,               // in their order, without a depth buffer
};
let faces = null, lineLayers = new Map(), frames = 0, wanted = false, looksChanged = true;

function prepare() {
  faces = {plain: programOf(faceVertex(false), faceFragment(false)), outlined: programOf(faceVertex(true), faceFragment(true)), vertices: gl.createVertexArray()};
  gl.bindVertexArray(faces.vertices);
  attribute(faces.outlined, 'place', triangles.places, 3);
  attribute(faces.outlined, 'sides', triangles.sides, 4);
  faces.looks = attribute(faces.outlined, 'look', new Uint8Array(looksOfCorners.buffer), 4);
  faces.lines = programOf(lineVertex, lineFragment);
  for (const layer of lineLayers.values()) layer.vertices = null;
  looksChanged = true;
  gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
}

/// Lines by a name, in place of those it had: {from, to, colour: [r, g, b, a] of 255, width, dash}. `through`: in front of all.
function setLines(name, list, through = false) {
  const before = lineLayers.get(name);
  if (before && before.vertices && gl) gl.deleteVertexArray(before.vertices), before.buffers.forEach(buffer => gl.deleteBuffer(buffer));
  if (list.length === 0) lineLayers.delete(name);
  else lineLayers.set(name, {list, through, vertices: null});
  redraw();
}
/// Each line as two triangles of its own: a software renderer takes as long for an instance as for a draw.
function prepareLines(layer) {
  const n = 6 * layer.list.length, from = new Float32Array(3 * n), to = new Float32Array(3 * n), paint = new Uint8Array(4 * n), kind = new Float32Array(2 * n);
  layer.list.forEach((line, i) => {
    for (let c = 6 * i; c < 6 * i + 6; ++c) {
      from.set(line.from, 3 * c), to.set(line.to, 3 * c), paint.set(line.colour, 4 * c);
      kind[2 * c] = line.width * devicePixelRatio, kind[2 * c + 1] = (line.dash || 0) * devicePixelRatio;
    }
  });
  layer.vertices = gl.createVertexArray();
  gl.bindVertexArray(layer.vertices);
  layer.buffers = [['from', from, 3], ['to', to, 3], ['paint', paint, 4], ['kind', kind, 2]].map(([key, array, size]) => attribute(faces.lines, key, array, size));
}

// ---- A frame

function redraw() {
  if (wanted) return;
  wanted = true;
  requestAnimationFrame(() => { wanted = false; draw(); });
}
function isDark() { return matchMedia('(prefers-color-scheme: dark)').matches; }
function paperColour() { return isDark() ? [23, 24, 27] : [246, 245, 241]; }

function drawFaces(matrix, outlines, painter) {
  const program = outlines ? faces.outlined : faces.plain;
  gl.useProgram(program.program);
  gl.bindVertexArray(faces.vertices);
  if (looksChanged) {
    const all = new Uint32Array(looks.buffer);
    for (let t = 0; t < triangles.count; ++t) looksOfCorners.fill(all[triangles.of[t]], 3 * t, 3 * t + 3);
    gl.bindBuffer(gl.ARRAY_BUFFER, faces.looks);
    gl.bufferData(gl.ARRAY_BUFFER, looksOfCorners, gl.DYNAMIC_DRAW);
    looksChanged = false;
  }
  gl.uniformMatrix4fv(program.matrix, false, Float32Array.from(matrix));
  painter ? gl.disable(gl.DEPTH_TEST) : gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  drawing.backs ? gl.disable(gl.CULL_FACE) : gl.enable(gl.CULL_FACE);
  const range = (a, b) => {
    const first = triangles.first[Math.min(a, polygons.count)], end = triangles.first[Math.min(b, polygons.count)];
    if (end > first) gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * (end - first));
  };
  if (drawing.base > drawing.from) {
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 4);
    range(drawing.from, Math.min(drawing.base, drawing.to));
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }
  range(Math.max(drawing.base, drawing.from), drawing.to);
}

function draw() {
  if (!gl || gl.isContextLost()) return;
  const width = Math.round(canvas.clientWidth * devicePixelRatio), height = Math.round(canvas.clientHeight * devicePixelRatio);
  if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.viewport(0, 0, width, height);
  gl.clearColor(...paperColour().map(c => c / 255), 1);
  gl.depthMask(true);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const frame = cameraFrame();
  drawFaces(frame.matrix, drawing.outlines, drawing.painter && camera.atEye);
  gl.disable(gl.CULL_FACE);
  gl.enable(gl.BLEND);
  gl.useProgram(faces.lines.program);
  gl.uniformMatrix4fv(faces.lines.matrix, false, Float32Array.from(frame.matrix));
  gl.uniform2f(faces.lines.size, width / 2, height / 2);
  gl.uniform1f(faces.lines.near, frame.near);
  for (const through of [false, true])
    for (const layer of lineLayers.values()) {
      if (layer.through !== through) continue;
      if (!layer.vertices) prepareLines(layer);
      through ? gl.disable(gl.DEPTH_TEST) : gl.enable(gl.DEPTH_TEST);
      gl.uniform1f(faces.lines.bias, through ? 0 : 1);
      gl.bindVertexArray(layer.vertices);
      gl.drawArrays(gl.TRIANGLES, 0, 6 * layer.list.length);
    }
  gl.disable(gl.BLEND);
  ++frames;
}

// The axes of a cube about the eye, of no scene's: one software renderer drops triangles with a corner just beside the eye's own plane.
const aslant = (function () {
  const x = unit([1, 0.37, 0.21]), y = unit(cross([-0.13, 0.29, 1], x));
  return [x, y, cross(x, y)];
}());

/// All directions from a place, unrolled: to the right as one turns to the right, the middle at `yaw`. As rows of RGBA, the top first.
function unrolled(place, yaw, width, height) {
  const size = 512, cube = gl.createTexture(), depth = gl.createRenderbuffer(), buffer = gl.createFramebuffer();
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube);
  for (let side = 0; side < 6; ++side)
    gl.texImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + side, 0, gl.RGBA8, size, size, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, size, size);
  gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
  gl.viewport(0, 0, size, size);
  gl.clearColor(...paperColour().map(c => c / 255), 1);
  gl.depthMask(true);
  const beyond = bounds.reach + 1.2 * bounds.radius, far = lengthOf(minus(bounds.middle, place)) + beyond;
  const view = perspective(Math.PI / 2, 1, Math.max(1e-4 * bounds.radius, far - 2 * beyond), far), whole = [drawing.from, drawing.backs];
  drawing.from = drawing.base, drawing.backs = true;  // what is seen, nothing beneath
  [[[1, 0, 0], [0, -1, 0]], [[-1, 0, 0], [0, -1, 0]], [[0, 1, 0], [0, 0, 1]], [[0, -1, 0], [0, 0, -1]], [[0, 0, 1], [0, -1, 0]], [[0, 0, -1], [0, -1, 0]]]
    .map(two => two.map(d => add(times(d[0], aslant[0]), add(times(d[1], aslant[1]), times(d[2], aslant[2])))))
    .forEach(([ahead, up], side) => {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_CUBE_MAP_POSITIVE_X + side, cube, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      drawFaces(product(view, lookMatrix(place, cross(ahead, up), up, ahead)), false, false);
    });
  [drawing.from, drawing.backs] = whole;
  // The sphere.
  const flat = gl.createTexture(), program = programOf(sphereVertex, sphereFragment);
  gl.bindTexture(gl.TEXTURE_2D, flat);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, null);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, flat, 0);
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube);
  gl.viewport(0, 0, width, height);
  gl.disable(gl.DEPTH_TEST), gl.disable(gl.CULL_FACE);
  gl.useProgram(program.program);
  gl.uniform1f(program.yaw, yaw);
  gl.uniformMatrix3fv(program.frame, false, aslant.flat());
  gl.bindVertexArray(null);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const below = new Uint8Array(4 * width * height), rows = new Uint8ClampedArray(below.length);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, below);
  for (let y = 0; y < height; ++y) rows.set(below.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.deleteTexture(cube), gl.deleteTexture(flat), gl.deleteRenderbuffer(depth), gl.deleteFramebuffer(buffer), gl.deleteProgram(program.program);
  return rows;
}
