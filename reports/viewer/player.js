// The page: what is played, and where the camera is.
const kSlow = 15;  // frames a second below which drafts are drawn in motion

class Player {
  constructor(facts, painter) {
    Object.assign(this, {facts, painter, frame: 0, lighting: 0, free: null, isPlaying: false});
    this.count = facts.frames.length / 7;
    this.keys = new Set();
    this.shown = [];
  }

  view() {
    if (this.free) return this.free;
    const f = this.facts.frames.slice(7 * this.frame, 7 * this.frame + 7);
    return {eye: f.slice(0, 3), target: f.slice(3, 6), fov: f[6]};
  }

  draw() {
    const {facts} = this, wanted = element("samples").value;
    const moves = this.isPlaying || this.isDragged || this.keys.size > 0;
    const moving = this.isSlow ? 0.5 : 1;
    const across = wanted === "auto" ? (moves ? moving : 2) : Number(wanted);
    const texels = Math.max(1, across), {canvas} = this.painter;
    this.painter.setDraft(across < 1);
    const camera = cameraOf(this.view(), canvas.width, canvas.height);
    this.drawn = this.painter.draw(camera, {
      texels, isFree: this.free !== null, lighting: this.lighting,
      light: facts.lightings[this.lighting], isFalse: element("false").checked,
      exposure: facts.exposure * 2 ** Number(element("exposure").value)});
    element("scrub").value = this.frame;
    element("time").textContent = `${(this.frame / facts.fps).toFixed(2)} s`;
    const stops = Number(element("exposure").value);
    element("stops").textContent = `${stops > 0 ? "+" : ""}${stops.toFixed(1)} EV`;
    element("back").hidden = this.free === null;
  }

  goTo(frame) {
    this.frame = Math.min(Math.max(frame, 0), this.count - 1);
    this.free = null;
    this.draw();
  }

  setLighting(index) {
    const n = this.facts.lightings.length;
    this.lighting = ((index % n) + n) % n;
    element("hour").value = this.lighting;
    this.draw();
  }

  play(isPlaying) {
    this.isPlaying = isPlaying;
    element("play").textContent = isPlaying ? "Pause" : "Play";
    if (isPlaying) {
      this.free = null;
      if (this.frame >= this.count - 1) this.frame = 0;
      this.start = performance.now() - 1000 * this.frame / this.facts.fps;
      this.shown = [];
      requestAnimationFrame((now) => this.step(now));
    } else {
      this.draw();
    }
  }

  // The clock tells the frame: a slow machine leaves frames out and keeps the film's speed.
  step(now) {
    if (!this.isPlaying) return;
    this.frame = Math.max(0, Math.floor((now - this.start) / 1000 * this.facts.fps));
    if (this.frame >= this.count) {
      this.frame = this.count - 1;
      this.play(false);
      return;
    }
    this.draw();
    this.noteRate(now);
    requestAnimationFrame((next) => this.step(next));
  }

  // A machine once found slow stays so: a picture that went back and forth would flicker.
  noteRate(now) {
    this.shown = [...this.shown.filter((t) => t > now - 2000), now];
    if (this.shown.length < 3) return;
    const rate = 1000 * (this.shown.length - 1) / (now - this.shown[0]);
    element("rate").textContent = `${rate.toFixed(1)} frames/s`;
    if (rate < kSlow) this.isSlow = true;
  }

  leavePath() {
    if (this.isPlaying) this.play(false);
    if (!this.free) this.free = this.view();
    return this.free;
  }

  look(dx, dy) {
    const view = this.leavePath(), d = sum(view.target, view.eye, -1);
    const turn = view.fov * Math.PI / 180 / this.painter.canvas.clientWidth;
    const azimuth = Math.atan2(d[0], d[1]) - dx * turn;
    const steepest = 0.499 * Math.PI;
    const altitude = Math.min(Math.max(Math.atan2(d[2], Math.hypot(d[0], d[1])) + dy * turn,
                                       -steepest), steepest);
    const flat = Math.cos(altitude);
    this.free = {...view, target: sum(view.eye, [flat * Math.sin(azimuth),
                                                 flat * Math.cos(azimuth), Math.sin(altitude)])};
    this.draw();
  }

  // Metres to the right, upwards and ahead.
  move(right, up, ahead) {
    const view = this.leavePath(), camera = cameraOf(view, 2, 2);
    const way = sum(sum([0, 0, up], camera.right, right), camera.forward, ahead);
    this.free = {...view, eye: sum(view.eye, way), target: sum(view.target, way)};
    this.draw();
  }

  walk() {
    const held = (a, b) => (this.keys.has(a) ? 1 : 0) - (this.keys.has(b) ? 1 : 0);
    if (this.keys.size === 0) {
      this.isWalking = false;
      this.draw();
      return;
    }
    const pace = 0.05;
    this.move(pace * held("d", "a"), pace * held("e", "q"), pace * held("w", "s"));
    requestAnimationFrame((now) => {
      this.noteRate(now);
      this.walk();
    });
  }

  // Frames per second of `count` frames drawn one after another, each waited for.
  measure(count, texels) {
    const pixel = new Uint8Array(4), gl = this.painter.gl, before = element("samples").value;
    element("samples").value = texels;
    const start = performance.now();
    for (let k = 0; k < count; ++k) {
      this.goTo(Math.floor(k * this.count / count));
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    element("samples").value = before;
    return 1000 * count / (performance.now() - start);
  }
}

function listen(player) {
  const canvas = player.painter.canvas;
  const on = (id, event, what) => element(id).addEventListener(event, what);
  on("play", "click", () => player.play(!player.isPlaying));
  on("scrub", "input", () => { player.play(false); player.goTo(Number(element("scrub").value)); });
  on("back", "click", () => player.goTo(player.frame));
  on("exposure", "input", () => player.draw());
  on("samples", "change", () => player.draw());
  on("false", "change", () => {
    element("legend").hidden = !element("false").checked;
    player.draw();
  });
  on("hour", "change", () => player.setLighting(Number(element("hour").value)));
  on("earlier", "click", () => player.setLighting(player.lighting - 1));
  on("later", "click", () => player.setLighting(player.lighting + 1));
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    player.isDragged = event.buttons !== 0;
    if (player.isDragged) player.look(event.movementX, event.movementY);
  });
  for (const event of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(event, () => {
      if (player.isDragged) player.isDragged = false, player.draw();
    });
  }
  addEventListener("keydown", (event) => {
    if (/^(INPUT|SELECT|BUTTON)$/.test(event.target.tagName)) return;
    const key = event.key.toLowerCase();
    if (key === " ") player.play(!player.isPlaying);
    else if (key === "arrowright" || key === "arrowleft") {
      player.play(false);
      player.goTo(player.frame + (key === "arrowright" ? 1 : -1));
    } else if ("wasdqe".includes(key)) {
      player.keys.add(key);
      if (!player.isWalking) player.isWalking = true, player.shown = [], player.walk();
    } else return;
    event.preventDefault();
  });
  addEventListener("keyup", (event) => player.keys.delete(event.key.toLowerCase()));
  addEventListener("blur", () => player.keys.clear());
}

function showLegend(facts) {
  const canvas = element("legend").querySelector("canvas"), context = canvas.getContext("2d");
  const picture = context.createImageData(512, 1), entries = facts.colours.length / 4;
  for (let x = 0; x < 512; ++x) {
    const from = 4 * Math.round(x / 511 * (entries - 1));
    picture.data.set(facts.colours.slice(from, from + 4), 4 * x);
  }
  context.putImageData(picture, 0, 0);
  for (const [place, text] of facts.ticks) {
    const tick = document.createElement("span");
    tick.style.left = `${100 * place}%`;
    tick.textContent = text;
    element("ticks").append(tick);
  }
}

async function open() {
  const facts = JSON.parse(element("film-facts").textContent);
  const painter = new PointPainter(element("film"), facts), player = new Player(facts, painter);
  facts.lightings.forEach((lighting, k) => {
    element("hour").append(new Option(lighting.label, k));
  });
  element("hours").hidden = facts.lightings.length < 2;
  element("scrub").max = player.count - 1;
  showLegend(facts);
  for (const [k, lighting] of facts.lightings.entries()) {
    lighting.skyTexture =
        painter.addSky(await inflated(`sky${k}`), lighting.columns, lighting.rows);
  }
  let points = 0;
  for (let c = 0; element(`blocks${c}`); ++c) {
    const blocks = JSON.parse(element(`blocks${c}`).textContent);
    let count = 0;
    for (const block of blocks) block.first = count, count += block.points;
    const geometry = records(await inflated(`points${c}`), count), colours = [];
    for (let k = 0; k < facts.lightings.length; ++k) {
      colours.push(colourCodes(await inflated(`colours${c}-${k}`)));
    }
    painter.addChunk(blocks, geometry, colours);
    points += count;
  }
  element("told").textContent =
      `${points.toLocaleString("en")} points, ${player.count} frames. ${facts.told}`;
  listen(player);
  player.goTo(0);
  return player;
}

// `tenkuPlayer` is for scripts that drive the page.
window.tenkuPlayer = new Promise((done) => addEventListener("DOMContentLoaded", () => done(
    open().catch((error) => {
      element("told").textContent = `${error.message}`;
      throw error;
    }))));
