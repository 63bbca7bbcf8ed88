// The discs of `kPointShader` and `kDiscShader`, one sample a pixel, drawn by a loop. Where WebGL
// itself is drawn by the processor this is several times as fast.
const kCosines = Float64Array.from({length: 320}, (_, k) => Math.cos(2 * Math.PI * k / 256));
const kFootprints = Float32Array.from({length: 32768}, (_, k) => 2 ** ((k - 1) / 512 - 20));

class DiscLoop {
  // Items and their nearness, row by row, `margin` pixels beyond the picture on every side.
  constructor(width, height, margin) {
    Object.assign(this, {width, height, margin});
    this.columns = width + 2 * margin, this.rows = height + 2 * margin;
    this.items = new Uint32Array(this.columns * this.rows);
    this.nearest = new Float32Array(this.columns * this.rows);
  }

  clear(nothing) {
    this.items.fill(nothing);
    this.nearest.fill(0);
  }

  // One point of `every` of a block. `geometry` is that of its chunk: words, signed words, bytes.
  drawBlock(block, geometry, colours, camera, {coarsest, grow, every, largest}) {
    const {words, signed, bytes} = geometry, {items, nearest, columns, rows} = this;
    const [coarsestDisc, coarsestEdge] = coarsest;
    const [ox, oy, oz] = sum(block.origin, camera.eye, -1), [sx, sy, sz] = block.step;
    const [rx, ry, rz] = camera.right, [dx, dy, dz] = camera.down, [fx, fy, fz] = camera.forward;
    const {pixel} = camera, {steep, cone: flat, least, overlap} = kDisc;
    const fromX = 0.5 * this.width + this.margin,
          fromY = 0.5 * this.height + this.margin;
    let e0 = 1 << 20, e1 = 0, nx = 0, ny = 0, nz = 0;
    // The border of a disc: across, along, and what it lies beyond the middle; for both.
    let a0 = 0, b0 = 0, c0 = 1, a1 = 0, b1 = 0, c1 = 1;
    const end = block.first + block.points;
    for (let i = block.first; i < end; i += every) {
      const w = 8 * i;
      const x = ox + sx * words[w], y = oy + sy * words[w + 1], z = oz + sz * words[w + 2];
      const depth = x * fx + y * fy + z * fz;
      if (!(depth > 1e-4)) continue;
      const code = words[w + 3], isEdge = (code & 1) !== 0, footprint = kFootprints[code >> 1];
      const nearness = 1 / depth, scale = nearness / pixel, shown = grow * footprint;
      const size = shown * scale;
      if (size > (isEdge ? coarsestEdge : coarsestDisc)) continue;
      if (signed[w + 4] !== e0 || signed[w + 5] !== e1) {
        e0 = signed[w + 4], e1 = signed[w + 5];
        nx = e0 / 32767, ny = e1 / 32767, nz = 1 - Math.abs(nx) - Math.abs(ny);
        if (nz < 0) {
          const folded = (1 - Math.abs(ny)) * (nx < 0 ? -1 : 1);
          ny = (1 - Math.abs(nx)) * (ny < 0 ? -1 : 1), nx = folded;
        }
        const by = 1 / Math.sqrt(nx * nx + ny * ny + nz * nz);
        nx *= by, ny *= by, nz *= by;
      }
      const above = nx * x + ny * y + nz * z;
      if (above >= 0) continue;
      const u = (x * rx + y * ry + z * rz) * scale + fromX;
      const v = (x * dx + y * dy + z * dz) * scale + fromY;
      const radius = Math.min(0.5 * Math.max(least, overlap * size), largest);
      const left = Math.max(0, Math.ceil(u - radius - 0.5));
      const right = Math.min(columns - 1, Math.floor(u + radius - 0.5));
      const top = Math.max(0, Math.ceil(v - radius - 0.5));
      const bottom = Math.min(rows - 1, Math.floor(v + radius - 0.5));
      if (left > right || top > bottom) continue;
      const square = radius * radius, turned = shown * nearness * nearness;
      const most = steep * turned, cone = flat * turned / square;
      const nr = nx * rx + ny * ry + nz * rz, nd = nx * dx + ny * dy + nz * dz;
      const slopeX = pixel * nr / above, slopeY = pixel * nd / above;
      if (isEdge) {
        const sign = nz < 0 ? -1 : 1, a = -1 / (sign + nz), b = nx * ny * a;
        const tx = 1 + sign * nx * nx * a, ty = sign * b, tz = -sign * nx;
        const ux = b, uy = sign + ny * ny * a, uz = -ny;  // the other tangent
        const px = ry * z - rz * y, py = rz * x - rx * z, pz = rx * y - ry * x;
        const qx = dy * z - dz * y, qy = dz * x - dx * z, qz = dx * y - dy * x;
        const tp = tx * px + ty * py + tz * pz, up = ux * px + uy * py + uz * pz;
        const tq = tx * qx + ty * qy + tz * qz, uq = ux * qx + uy * qy + uz * qz;
        const at = 16 * i + 12, reach = kDisc.reach / 254 * footprint;
        for (let k = 0; k < 2; ++k) {
          const turn = bytes[at + 2 * k], far = bytes[at + 2 * k + 1];
          const cosine = kCosines[turn], sine = kCosines[turn + 192], off = (far - 1) * reach;
          const across = cosine * up - sine * tp - off * nr;
          const along = cosine * uq - sine * tq - off * nd;
          const by = far === 0 ? 0 : 1 / Math.sqrt(across * across + along * along);
          const beyond = far === 0 ? 1 : kDisc.seam - off * above * scale * by;
          if (k === 0) a0 = across * by, b0 = along * by, c0 = beyond;
          else a1 = across * by, b1 = along * by, c1 = beyond;
        }
      }
      for (let row = top; row <= bottom; ++row) {
        const offY = row + 0.5 - v;
        for (let column = left; column <= right; ++column) {
          const offX = column + 0.5 - u, far = offX * offX + offY * offY;
          if (far > square) continue;
          if (isEdge && (a0 * offX + b0 * offY + c0 <= 0 || a1 * offX + b1 * offY + c1 <= 0)) {
            continue;
          }
          const slope = Math.min(Math.max(slopeX * offX + slopeY * offY, -most), most);
          const near = Math.max(nearness + slope - cone * far, 1e-9), at = row * columns + column;
          if (near <= nearest[at]) continue;
          nearest[at] = near;
          items[at] = colours[i];
        }
      }
    }
  }
}
