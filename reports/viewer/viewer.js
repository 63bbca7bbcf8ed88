// Cameras and places are in metres, x east, y north, z up; the rows of a picture go down.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const cross = (a, b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const element = (id) => document.getElementById(id);
const kMargin = 2, kNothing = 0xffffffff;
// A draft has half the pixels across, and of points that lie beside each other draws one of four,
// twice as wide.
const kDraftOf = 4, kDraftGrowth = 2;

async function inflated(id) {
  const text = atob(element(id).textContent);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  element(id).remove();
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Records of 16 bytes: six words, which come as differences in planes, and four bytes.
function records(bytes, count) {
  const record = new Uint8Array(16 * count), words = new Uint16Array(record.buffer);
  for (let column = 0, from = 0; column < 6; ++column, from += 2 * count) {
    for (let i = 0, word = 0; i < count; ++i) {
      word = (word + bytes[from + i] + 256 * bytes[from + count + i]) & 65535;
      words[8 * i + column] = word;
    }
  }
  for (let k = 0; k < 4; ++k) {
    for (let i = 0; i < count; ++i) record[16 * i + 12 + k] = bytes[(12 + k) * count + i];
  }
  return record;
}

function colourCodes(bytes) {
  const count = bytes.length / 4, codes = new Uint8Array(bytes.length);
  for (let k = 0; k < 4; ++k) {
    for (let i = 0; i < count; ++i) codes[4 * i + k] = bytes[k * count + i];
  }
  return codes;
}

function cameraOf(view, width, height) {
  const forward = unit(sum(view.target, view.eye, -1));
  const upright = Math.hypot(forward[0], forward[1]) > 1e-9 ? [0, 0, 1] : [0, 1, 0];
  const right = unit(cross(forward, upright)), down = cross(forward, right);
  const pixel = 2 * Math.tan(view.fov * Math.PI / 360) / width;
  const corner = sum(sum(forward, right, -0.5 * width * pixel), down, -0.5 * height * pixel);
  return {eye: view.eye, forward, right, down, pixel, corner};
}

// Whether any point of a block may be in the picture.
function mayShow(camera, block, width, height, coarsest) {
  const half = block.step.map((s) => 0.5 * 65535 * s);
  const middle = sum(sum(block.origin, half), camera.eye, -1);
  const reach = (n) => half.reduce((all, h, k) => all + h * Math.abs(n[k]), 0);
  const farthest = dot(middle, camera.forward) + reach(camera.forward);
  if (farthest <= 1e-4 || block.finest > coarsest * camera.pixel * farthest) return false;
  const x = 0.5 * width * camera.pixel, y = 0.5 * height * camera.pixel;
  const wider = 1 + 8 / Math.min(width, height);
  for (const [axis, most] of [[camera.right, x * wider], [camera.down, y * wider]]) {
    for (const side of [-1, 1]) {
      const inward = sum(axis.map((a) => side * a), camera.forward, most);
      if (dot(middle, inward) + reach(inward) < 0) return false;
    }
  }
  return true;
}

function isDrawnBySoftware(gl) {
  const told = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

class PointPainter {
  constructor(canvas, facts) {
    const gl = canvas.getContext("webgl2", {antialias: false, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser has no WebGL 2.");
    this.gl = gl, this.facts = facts, this.canvas = canvas;
    this.chunks = [], this.targets = {};
    canvas.style.aspectRatio = `${facts.width} / ${facts.height}`;
    this.setDraft(false);
    this.isByLoop = isDrawnBySoftware(gl);
    this.points = this.program(kPointShader, kDiscShader);
    this.show = this.program(kScreenTriangle, kShowShader);
    this.empty = gl.createVertexArray();
    this.map = this.texture(gl.RGBA8, facts.colours.length / 4, 1, gl.RGBA, gl.UNSIGNED_BYTE,
                            new Uint8Array(facts.colours));
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getShaderInfoLog(shader));
      }
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(gl.getProgramInfoLog(program));
    }
    const at = {};
    for (let i = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i-- > 0;) {
      const name = gl.getActiveUniform(program, i).name;
      at[name] = gl.getUniformLocation(program, name);
    }
    return {program, at};
  }

  setDraft(isDraft) {
    const {canvas, facts} = this, across = isDraft ? kDraftGrowth : 1;
    const width = Math.ceil(facts.width / across), height = Math.ceil(facts.height / across);
    this.isDraft = isDraft;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
  }

  texture(format, width, height, layout, type, data) {
    const gl = this.gl, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, layout, type, data);
    for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
    }
    return texture;
  }

  addSky(bytes, columns, rows) {
    const gl = this.gl;
    return this.texture(gl.R32UI, columns, rows, gl.RED_INTEGER, gl.UNSIGNED_INT,
                        new Uint32Array(colourCodes(bytes).buffer));
  }

  buffer(data) {
    const gl = this.gl, buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    return buffer;
  }

  // One point of `every`.
  array(points, colour, every) {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, points);
    gl.vertexAttribIPointer(0, 4, gl.UNSIGNED_SHORT, 16 * every, 0);
    gl.vertexAttribIPointer(1, 2, gl.SHORT, 16 * every, 8);
    gl.vertexAttribIPointer(2, 4, gl.UNSIGNED_BYTE, 16 * every, 12);
    gl.bindBuffer(gl.ARRAY_BUFFER, colour);
    gl.vertexAttribIPointer(3, 1, gl.UNSIGNED_INT, 4 * every, 0);
    for (let k = 0; k < 4; ++k) gl.enableVertexAttribArray(k);
    gl.bindVertexArray(null);
    return array;
  }

  // Arrays of the points for each sun and sky, which differ in their colours: of all, and of a
  // draft. Points come ordered by place, so that one of four leaves no part out.
  addChunk(blocks, geometry, colours) {
    const points = this.buffer(geometry), arrays = [], drafts = [];
    for (const codes of colours) {
      const colour = this.buffer(codes);
      arrays.push(this.array(points, colour, 1));
      drafts.push(this.array(points, colour, kDraftOf));
    }
    const {buffer} = geometry;
    this.chunks.push({blocks, arrays, drafts,
                      geometry: {words: new Uint16Array(buffer), signed: new Int16Array(buffer),
                                 bytes: geometry},
                      colours: colours.map((codes) => new Uint32Array(codes.buffer))});
  }

  target(texels) {
    const name = `${texels} ${this.canvas.width}`;
    if (this.targets[name]) return this.targets[name];
    const gl = this.gl, width = texels * (this.canvas.width + 2 * kMargin),
          height = texels * (this.canvas.height + 2 * kMargin);
    const items = this.texture(gl.R32UI, width, height, gl.RED_INTEGER, gl.UNSIGNED_INT, null);
    const depth = gl.createRenderbuffer(), frame = gl.createFramebuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, items, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) {
      throw new Error("This browser cannot draw into a texture of points.");
    }
    return this.targets[name] = {frame, items, width, height};
  }

  // Calls `what` for every block that may be in the picture, and counts their points.
  eachBlock(camera, coarsest, every, what) {
    const {width, height} = this.canvas;
    let drawn = 0;
    for (const chunk of this.chunks) {
      for (const block of chunk.blocks) {
        if (!mayShow(camera, block, width, height, coarsest)) continue;
        what(chunk, block);
        drawn += Math.ceil(block.points / every);
      }
    }
    return drawn;
  }

  // What both ways of drawing points go by.
  detailOf(state) {
    // Off the path nothing finer may have been gathered: then all points are drawn.
    return {coarsest: state.isFree ? [1e9, 1e9] : [1.4, 0.7], largest: 40,
            grow: this.isDraft ? kDraftGrowth : 1,
            every: this.isDraft ? kDraftOf : 1};  // divides what blocks but the last hold
  }

  loopPoints(camera, state, target) {
    const gl = this.gl, {width, height} = this.canvas, detail = this.detailOf(state);
    if (this.loop?.width !== width) this.loop = new DiscLoop(width, height, kMargin);
    const {loop} = this;
    loop.clear(kNothing);
    const drawn = this.eachBlock(camera, detail.coarsest[0], detail.every, (chunk, block) => {
      loop.drawBlock(block, chunk.geometry, chunk.colours[state.lighting], camera, detail);
    });
    gl.bindTexture(gl.TEXTURE_2D, target.items);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, loop.columns, loop.rows, gl.RED_INTEGER,
                     gl.UNSIGNED_INT, loop.items);
    return drawn;
  }

  drawPoints(camera, state, target) {
    const gl = this.gl, {program, at} = this.points, {width, height} = this.canvas;
    const detail = this.detailOf(state);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.GREATER);
    gl.clearBufferuiv(gl.COLOR, 0, new Uint32Array([kNothing, 0, 0, 0]));
    gl.clearBufferfv(gl.DEPTH, 0, new Float32Array([0]));
    gl.uniform3fv(at.uRight, camera.right);
    gl.uniform3fv(at.uDown, camera.down);
    gl.uniform3fv(at.uForward, camera.forward);
    gl.uniform2f(at.uFrom, -0.5 * width, -0.5 * height);
    gl.uniform2f(at.uSize, width, height);
    gl.uniform2fv(at.uCoarsest, detail.coarsest);
    gl.uniform1f(at.uLargest, detail.largest);
    gl.uniform1f(at.uPixel, camera.pixel);
    gl.uniform1f(at.uMargin, kMargin);
    gl.uniform1f(at.uTexels, state.texels);
    gl.uniform1f(at.uGrow, detail.grow);
    return this.eachBlock(camera, detail.coarsest[0], detail.every, (chunk, block) => {
      gl.bindVertexArray((this.isDraft ? chunk.drafts : chunk.arrays)[state.lighting]);
      gl.uniform3fv(at.uOrigin, sum(block.origin, camera.eye, -1));
      gl.uniform3fv(at.uStep, block.step);
      gl.drawArrays(gl.POINTS, block.first / detail.every, Math.ceil(block.points / detail.every));
    });
  }

  draw(camera, state) {
    const gl = this.gl, target = this.target(state.texels), lighting = state.light;
    const byLoop = this.isByLoop && state.texels === 1;
    const drawn = byLoop ? this.loopPoints(camera, state, target)
                         : this.drawPoints(camera, state, target);
    const {program, at} = this.show;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.useProgram(program);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    [target.items, lighting.skyTexture, this.map].forEach((texture, k) => {
      gl.activeTexture(gl.TEXTURE0 + k);
      gl.bindTexture(gl.TEXTURE_2D, texture);
    });
    gl.uniform1i(at.uItems, 0);
    gl.uniform1i(at.uSky, 1);
    gl.uniform1i(at.uMap, 2);
    gl.uniform3fv(at.uRight, camera.right);
    gl.uniform3fv(at.uDown, camera.down);
    gl.uniform3fv(at.uCorner, camera.corner);
    gl.uniform3fv(at.uBelow, lighting.below);
    gl.uniform3fv(at.uScale, this.facts.scale);
    gl.uniform1f(at.uPixel, camera.pixel);
    gl.uniform1f(at.uExposure, state.exposure);
    gl.uniform1i(at.uMargin, kMargin);
    gl.uniform1i(at.uTexels, state.texels);
    gl.uniform1i(at.uHeight, this.canvas.height);
    gl.uniform1i(at.uFill, this.isDraft ? 1 : 0);
    gl.uniform1i(at.uFalse, state.isFalse ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return drawn;
  }
}
