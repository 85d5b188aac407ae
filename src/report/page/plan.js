// The plan view: the yard from above, the robot in it, flights with their shadows.

class PlanView {
  constructor(section, { redraw, selectShot, selectTarget }) {
    this.tip = section.querySelector(".tip");
    this.now = { t: 0, shot: null, target: null, speed: 0 };
    this.still = document.createElement("canvas");
    this.stillVersion = "";
    this.prepare();
    this.camera = new Camera(section.querySelector("canvas"), {
      box: this.area,
      margin: { left: 34, right: 20, top: 38, bottom: 40 },
      redraw,
      click: (at) => {
        const found = this.pick(at);
        if (found.target) selectTarget(found.target);
        else if (found.shot) selectShot(found.shot);
      },
      hover: (at) => this.hover(at),
    });
    const legend = section.querySelector(".legend");
    for (const status of ["waiting", "reached", "failed", "unreachable"]) {
      const item = element("li");
      item.append(signElement(status), status);
      legend.append(item);
    }
  }

  /** Paths in metres, made once. */
  prepare() {
    this.solids = world.solids
      .filter((solid) => solid.footprint.length > 0)
      .map((solid) => {
        const path = new Path2D();
        for (const piece of solid.footprint) traceRounded(path, piece.core, piece.radius_m);
        return { ...solid, path, top: finite(solid.high_z_m, Infinity) };
      })
      .sort((a, b) => a.top - b.top);
    this.highest = Math.max(1e-3, ...this.solids.map((solid) => (Number.isFinite(solid.top) ? solid.top : 0)));

    this.bounds = world.bounds ? [...world.bounds[0], ...world.bounds[1]] : null;
    this.area = this.bounds ?? this.around();
    this.inflated = new Path2D();
    for (const solid of this.solids.filter((one) => one.blocks_driving)) {
      for (const piece of solid.footprint) traceRounded(this.inflated, piece.core, piece.radius_m + robot.radius_m);
    }
    if (this.bounds) {  // the robot's disk stays inside: a rim, outer side one way round, inner the other
      const [x0, y0, x1, y1] = this.bounds;
      const r = robot.radius_m;
      const rim = (points) => { points.forEach(([x, y], i) => (i ? this.inflated.lineTo(x, y) : this.inflated.moveTo(x, y))); this.inflated.closePath(); };
      rim([[x0 - 1, y0 - 1], [x1 + 1, y0 - 1], [x1 + 1, y1 + 1], [x0 - 1, y1 + 1]]);
      rim([[x0 + r, y0 + r], [x0 + r, y1 - r], [x1 - r, y1 - r], [x1 - r, y0 + r]]);
    }
    this.steep = new Path2D();
    for (const piece of world.terrain?.steep ?? []) traceRounded(this.steep, piece.core, piece.radius_m);
    this.contours = (world.terrain?.contours ?? []).map(({ height_m, points }) => {
      const path = new Path2D();
      for (const [x, y] of points) path.lineTo(x, y);
      return { height: height_m, path };
    });
    if (report.explore) {
      this.found = new Discovery(report.explore.map, { unknown: 0x66808080, free: 0, occupied: 0xb07a45e0 });
    }
    this.way = new Path2D();
    for (let i = 0; i < track.length; ++i) this.way.lineTo(track.x[i], track.y[i]);
    this.boxes = targets.map((target) => {
      const path = new Path2D();
      const [x, y] = target.centre;
      const [length, width] = target.size;
      const turned = new DOMMatrix().translate(finite(x), finite(y)).rotate((finite(target.box_yaw_rad) * 180) / Math.PI);
      const box = new Path2D();
      box.rect(-length / 2, -width / 2, length, width);
      path.addPath(box, turned);
      return path;
    });
  }

  around() {
    const xs = [...track.x];
    const ys = [...track.y];
    for (const solid of this.solids) {
      for (const { core, radius_m: r } of solid.footprint) {
        for (const [x, y] of core) { xs.push(x - r, x + r); ys.push(y - r, y + r); }
      }
    }
    const least = (list) => list.reduce((a, b) => Math.min(a, b), Infinity);
    const most = (list) => list.reduce((a, b) => Math.max(a, b), -Infinity);
    return [least(xs) - 0.5, least(ys) - 0.5, most(xs) + 0.5, most(ys) + 0.5];
  }

  draw(now) {
    this.now = now;
    const { camera } = this;
    const version = `${camera.version} ${theme.ground} ${camera.canvas.width}`;
    if (version !== this.stillVersion) {
      this.drawStill();
      this.stillVersion = version;
    }
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, camera.canvas.width, camera.canvas.height);
    ctx.drawImage(this.still, 0, 0);
    camera.toPlane(ctx);
    this.drawFound(ctx);
    this.drawWay(ctx);
    this.drawShots(ctx);
    drawStations(ctx, camera);
    this.drawTargets(ctx);
    this.drawRobot(ctx);
    this.drawFlights(ctx);
    this.drawLabels(ctx);
  }

  /** The map that was found by now: what is unknown is veiled. */
  drawFound(ctx) {
    if (!this.found) return;
    const { origin: [x, y], columns, rows, cell_m: cell } = this.found.map;
    ctx.save();
    ctx.imageSmoothingEnabled = false;
    ctx.translate(x, y + rows * cell);
    ctx.scale(cell, -cell);
    ctx.drawImage(this.found.at(this.now.t), 0, 0, columns, rows);
    ctx.restore();
  }

  // What does not move.

  drawStill() {
    const { camera, still } = this;
    still.width = camera.canvas.width;
    still.height = camera.canvas.height;
    const ctx = still.getContext("2d");
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, 0, still.width, still.height);
    camera.toPlane(ctx);
    const [x0, y0, x1, y1] = this.area;
    ctx.fillStyle = theme.yard;
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    this.drawGrid(ctx);
    this.drawTerrain(ctx);
    ctx.save();
    ctx.beginPath();
    ctx.rect(x0, y0, x1 - x0, y1 - y0);
    ctx.clip();
    this.drawInflation(ctx);
    ctx.restore();
    for (const solid of this.solids) this.drawSolid(ctx, solid);
    ctx.strokeStyle = theme.soft;
    ctx.lineWidth = camera.px(1);
    ctx.strokeRect(x0, y0, x1 - x0, y1 - y0);
    ctx.strokeStyle = theme.robot;
    ctx.globalAlpha = 0.3;
    ctx.lineWidth = camera.px(1.2);
    ctx.stroke(this.way);
    ctx.globalAlpha = 1;
    this.drawScales(ctx);
    this.placeLabels(ctx);
  }

  drawGrid(ctx) {
    const { camera } = this;
    const [x0, y0, x1, y1] = this.area;
    const step = roundStep(18 / camera.scale);
    ctx.lineWidth = camera.px(1);
    ctx.strokeStyle = theme.grid;
    ctx.beginPath();
    for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) { ctx.moveTo(x, y0); ctx.lineTo(x, y1); }
    for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) { ctx.moveTo(x0, y); ctx.lineTo(x1, y); }
    ctx.stroke();
  }

  /** Ground too steep to drive on, and lines of equal height, the higher the stronger. */
  drawTerrain(ctx) {
    const heights = this.contours.map((line) => line.height);
    const low = Math.min(...heights);
    const span = Math.max(...heights) - low || 1;
    ctx.fillStyle = theme.failed;
    ctx.globalAlpha = 0.12;
    ctx.fill(this.steep);
    ctx.strokeStyle = theme.soft;
    ctx.lineWidth = this.camera.px(1);
    for (const { height, path } of this.contours) {
      ctx.globalAlpha = 0.35 + (0.5 * (height - low)) / span;
      ctx.stroke(path);
    }
    ctx.globalAlpha = 1;
  }

  /** The union of the obstacles grown by the robot's radius: hatched, with one contour around it. */
  drawInflation(ctx) {
    const { camera, still } = this;
    const layer = document.createElement("canvas");
    layer.width = still.width;
    layer.height = still.height;
    const pen = layer.getContext("2d");
    const paint = (mode, work) => {
      pen.globalCompositeOperation = mode;
      camera.toPlane(pen);
      pen.fillStyle = pen.strokeStyle = theme.inflated;
      work();
    };
    const put = () => {
      ctx.save();
      ctx.setTransform(1, 0, 0, 1, 0, 0);
      ctx.drawImage(layer, 0, 0);
      ctx.restore();
      pen.setTransform(1, 0, 0, 1, 0, 0);
      pen.clearRect(0, 0, layer.width, layer.height);
    };
    paint("source-over", () => {
      pen.fillStyle = "#000";
      pen.fill(this.inflated);
    });
    pen.globalCompositeOperation = "source-in";
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = this.hatch(pen, camera.dpr);
    pen.fillRect(0, 0, layer.width, layer.height);
    put();
    paint("source-over", () => {
      pen.lineWidth = camera.px(2.2);
      pen.stroke(this.inflated);
    });
    paint("destination-out", () => {
      pen.fillStyle = "#000";
      pen.fill(this.inflated);
    });
    put();
  }

  hatch(pen, dpr) {
    const tile = document.createElement("canvas");
    const size = Math.max(4, Math.round(5 * dpr));
    tile.width = tile.height = size;
    const line = tile.getContext("2d");
    line.strokeStyle = theme.inflated;
    line.lineWidth = 0.8 * dpr;
    line.beginPath();
    for (const shift of [-size, 0, size]) {
      line.moveTo(shift - 1, size + 1);
      line.lineTo(shift + size + 1, -1);
    }
    line.stroke();
    return pen.createPattern(tile, "repeat");
  }

  tone(top) {
    const share = Math.sqrt(clamp(top / this.highest, 0, 1));
    return `color-mix(in srgb, ${theme["solid-high"]} ${(100 * share).toFixed(1)}%, ${theme["solid-low"]})`;
  }

  drawSolid(ctx, solid) {
    const { camera } = this;
    ctx.fillStyle = ctx.strokeStyle = this.tone(solid.top);
    if (solid.blocks_driving) {
      ctx.fill(solid.path);
      return;
    }
    ctx.globalAlpha = 0.28;
    ctx.fill(solid.path);
    ctx.globalAlpha = 1;
    ctx.strokeStyle = theme.soft;
    ctx.lineWidth = camera.px(1);
    ctx.setLineDash([camera.px(4), camera.px(3)]);
    if (solid.footprint.length === 1) ctx.stroke(solid.path);
    ctx.setLineDash([]);
  }

  /** Coordinates along two edges, a bar of round length, and the tones of heights. */
  drawScales(ctx) {
    const { camera } = this;
    const [x0, y0, x1, y1] = this.area;
    camera.toScreen(ctx);
    ctx.font = `10.5px ${theme.sans}`;
    ctx.fillStyle = ctx.strokeStyle = theme.soft;
    ctx.lineWidth = 1;
    const step = roundStep(70 / camera.scale);
    const corner = camera.screen(x0, y0);
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    for (let x = Math.ceil(x0 / step) * step; x <= x1 + 1e-9; x += step) {
      ctx.fillText(minus(String(+x.toFixed(6))), camera.screen(x, y0).x, corner.y + 5);
    }
    ctx.textAlign = "right";
    ctx.textBaseline = "middle";
    for (let y = Math.ceil(y0 / step) * step; y <= y1 + 1e-9; y += step) {
      ctx.fillText(minus(String(+y.toFixed(6))), corner.x - 6, camera.screen(x0, y).y);
    }
    ctx.globalAlpha = 0.8;
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, camera.height - 24, camera.width, 24);
    ctx.globalAlpha = 1;
    ctx.fillStyle = theme.soft;
    const length = roundStep(50 / camera.scale);
    const [left, base] = [14, camera.height - 12];
    const right = left + length * camera.scale;
    ctx.beginPath();
    ctx.moveTo(left, base - 4);
    ctx.lineTo(left, base);
    ctx.lineTo(right, base);
    ctx.lineTo(right, base - 4);
    ctx.strokeStyle = theme.ink;
    ctx.stroke();
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    ctx.fillText(`${+length.toPrecision(3)} m`, right + 6, base + 1);

    const text = `${fixed(this.highest, 1)} m high`;
    const end = camera.width - 14 - ctx.measureText(text).width;
    for (let i = 0; i < 40; ++i) {
      ctx.fillStyle = this.tone((this.highest * i) / 39);
      ctx.fillRect(end - 66 + 1.5 * i, base - 7, 1.6, 8);
    }
    ctx.fillStyle = theme.soft;
    ctx.fillText(text, end, base + 1);
    ctx.textAlign = "right";
    ctx.fillText("0", end - 71, base + 1);
  }

  // What moves.

  drawWay(ctx) {
    const { t } = this.now;
    const { index } = placeInTrack(t);
    const at = robotAt(t);
    ctx.beginPath();
    for (let i = 0; i <= index; ++i) ctx.lineTo(track.x[i], track.y[i]);
    ctx.lineTo(at.x, at.y);
    ctx.strokeStyle = theme.robot;
    ctx.lineWidth = this.camera.px(2.2);
    ctx.lineJoin = ctx.lineCap = "round";
    ctx.stroke();
  }

  drawShots(ctx) {
    const { camera, now } = this;
    for (const shot of shots) {
      if (shot.end_s > now.t && shot !== now.shot) continue;
      const selected = shot === now.shot;
      ctx.strokeStyle = shot.hit ? theme.water : theme.failed;
      ctx.globalAlpha = selected ? 0.95 : 0.33;
      ctx.lineWidth = camera.px(selected ? 1.6 : 1.1);
      ctx.setLineDash(shot.hit ? [] : [camera.px(5), camera.px(4)]);
      ctx.beginPath();
      ctx.moveTo(shot.from[0], shot.from[1]);
      ctx.lineTo(shot.to[0], shot.to[1]);
      ctx.stroke();
      ctx.setLineDash([]);
      if (!shot.hit) this.cross(ctx, shot.to[0], shot.to[1], 3.5);
      if (selected) this.shadow(ctx, shot, shot.end_s - shot.time_s, 0.5);
    }
    ctx.globalAlpha = 1;
  }

  cross(ctx, x, y, pixels) {
    const r = this.camera.px(pixels);
    ctx.beginPath();
    ctx.moveTo(x - r, y - r);
    ctx.lineTo(x + r, y + r);
    ctx.moveTo(x - r, y + r);
    ctx.lineTo(x + r, y - r);
    ctx.stroke();
  }

  /** The flight's shadow, as if the sun stood in the upper left: the higher, the farther off. */
  shadowOf(ball) { return { x: ball.x + 0.3 * ball.z, y: ball.y - 0.3 * ball.z }; }
  shadow(ctx, shot, until, alpha) {
    ctx.save();
    ctx.globalAlpha = alpha;
    ctx.strokeStyle = theme.soft;
    ctx.lineWidth = this.camera.px(1.3);
    ctx.setLineDash([this.camera.px(2), this.camera.px(3)]);
    ctx.beginPath();
    for (let i = 0; i <= 32; ++i) {
      const at = this.shadowOf(ballAt(shot, (until * i) / 32));
      ctx.lineTo(at.x, at.y);
    }
    ctx.stroke();
    ctx.restore();
  }

  drawFlights(ctx) {
    const { camera, now } = this;
    for (const shot of shots) {
      const age = now.t - shot.time_s;
      const flight = shot.end_s - shot.time_s;
      if (age >= 0 && age < flight) {
        const ball = ballAt(shot, age);
        this.shadow(ctx, shot, age, 0.8);
        ctx.strokeStyle = theme.water;
        ctx.lineWidth = camera.px(2.4);
        ctx.beginPath();
        ctx.moveTo(shot.from[0], shot.from[1]);
        ctx.lineTo(ball.x, ball.y);
        ctx.stroke();
        const below = this.shadowOf(ball);
        ctx.fillStyle = "#0006";
        this.disk(ctx, below.x, below.y, 3);
        ctx.fillStyle = theme.water;
        this.disk(ctx, ball.x, ball.y, 4 + 1.5 * clamp(ball.z, 0, 4));
        ctx.fillStyle = theme.yard;
        this.disk(ctx, ball.x, ball.y, 1.8 + 1.5 * clamp(ball.z, 0, 4));
      }
      const spread = (now.t - shot.end_s) / (0.55 * Math.max(1, now.speed));
      if (now.speed > 0 && spread >= 0 && spread < 1) {
        ctx.strokeStyle = shot.hit ? theme.water : theme.failed;
        ctx.globalAlpha = 1 - spread;
        ctx.lineWidth = camera.px(2);
        ctx.beginPath();
        ctx.arc(shot.to[0], shot.to[1], camera.px(6 + 22 * spread), 0, 2 * Math.PI);
        ctx.stroke();
        ctx.globalAlpha = 1;
      }
    }
  }

  disk(ctx, x, y, pixels) {
    ctx.beginPath();
    ctx.arc(x, y, this.camera.px(pixels), 0, 2 * Math.PI);
    ctx.fill();
  }

  drawTargets(ctx) {
    const { camera, now } = this;
    targets.forEach((target, i) => {
      const offset = offsetAt(target, now.t);
      if (!offset) return;
      const status = statusAt(target, now.t);
      camera.toPlane(ctx);
      ctx.translate(...offset);
      ctx.fillStyle = ctx.strokeStyle = statusColour(status);
      ctx.globalAlpha = 0.35;
      ctx.fill(this.boxes[i]);
      ctx.globalAlpha = 1;
      ctx.lineWidth = camera.px(1.2);
      ctx.stroke(this.boxes[i]);
      camera.toScreen(ctx);
      const at = camera.screen(finite(target.centre[0]) + offset[0], finite(target.centre[1]) + offset[1]);
      const belief = beliefAt(target, now.t);
      if (belief) {
        const seen = camera.screen(belief[0], belief[1]);
        ctx.setLineDash([3, 3]);
        ctx.beginPath();
        ctx.arc(seen.x, seen.y, 10, 0, 2 * Math.PI);
        ctx.stroke();
        ctx.setLineDash([]);
      }
      drawSign(ctx, status, at.x, at.y, 6);
      if (target === now.target) {
        ctx.strokeStyle = theme.ink;
        ctx.lineWidth = 1.5;
        ctx.beginPath();
        ctx.arc(at.x, at.y, 11, 0, 2 * Math.PI);
        ctx.stroke();
      }
    });
    camera.toPlane(ctx);
  }

  drawRobot(ctx) {
    const { camera, now } = this;
    const at = robotAt(now.t);
    const r = Math.max(finite(robot.radius_m), camera.px(7));
    const gun = Math.max(finite(robot.gun_length_m), 1.3 * r);
    ctx.save();
    ctx.translate(at.x, at.y);
    ctx.beginPath();
    ctx.arc(0, 0, r, 0, 2 * Math.PI);
    ctx.fillStyle = theme.yard;
    ctx.fill();
    ctx.lineWidth = camera.px(2);
    ctx.strokeStyle = theme.robot;
    ctx.stroke();
    ctx.save();
    ctx.rotate(at.heading);
    ctx.beginPath();
    ctx.moveTo(0.84 * r, 0);
    ctx.lineTo(0.34 * r, 0.4 * r);
    ctx.lineTo(0.34 * r, -0.4 * r);
    ctx.closePath();
    ctx.fillStyle = theme.robot;
    ctx.fill();
    ctx.restore();
    ctx.rotate(at.yaw);
    ctx.beginPath();
    ctx.moveTo(0, 0);
    ctx.lineTo(gun, 0);
    ctx.lineCap = "round";
    ctx.lineWidth = Math.max(camera.px(3.5), 0.16 * r);
    ctx.strokeStyle = theme.water;
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(0, 0, 0.28 * r, 0, 2 * Math.PI);
    ctx.fillStyle = theme.water;
    ctx.fill();
    ctx.restore();
  }

  // Names, where there is room for them.

  placeLabels(ctx) {
    const { camera } = this;
    camera.toScreen(ctx);
    ctx.font = `11.5px ${theme.sans}`;
    const signsAt = targets.map((target) => camera.screen(finite(target.centre[0]), finite(target.centre[1])));
    const taken = signsAt.map(({ x, y }) => [x - 8, y - 8, x + 8, y + 8]);
    const free = ([x0, y0, x1, y1]) => x0 > 2 && x1 < camera.width - 2 && y0 > 2 && y1 < camera.height - 2 &&
      taken.every((other) => x0 > other[2] || x1 < other[0] || y0 > other[3] || y1 < other[1]);
    this.labels = [];
    targets.forEach((target, i) => {
      const { x, y } = signsAt[i];
      const text = target.name.length > 28 ? target.name.slice(0, 27) + "\u2026" : target.name;
      const width = ctx.measureText(text).width;
      const places = [[x + 11, y], [x - 11 - width, y], [x - width / 2, y - 16], [x - width / 2, y + 16]];
      for (const [left, middle] of places) {
        const box = [left - 2, middle - 7, left + width + 2, middle + 7];
        if (!free(box)) continue;
        taken.push(box);
        this.labels.push({ text, x: left, y: middle, target });
        break;
      }
    });
  }

  drawLabels(ctx) {
    this.camera.toScreen(ctx);
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.lineJoin = "round";
    for (const { text, x, y, target } of this.labels) {
      const offset = offsetAt(target, this.now.t);
      if (!offset || offset[0] !== 0 || offset[1] !== 0) continue;  // named once it is in its place
      ctx.font = `${target === this.now.target ? 650 : 450} 11.5px ${theme.sans}`;
      ctx.strokeStyle = theme.yard;
      ctx.lineWidth = 3.5;
      ctx.globalAlpha = 0.85;
      ctx.strokeText(text, x, y);
      ctx.globalAlpha = 1;
      ctx.fillStyle = theme.ink;
      ctx.fillText(text, x, y);
    }
  }

  // The pointer.

  pick(at) {
    const { camera, now } = this;
    let target = null;
    let least = 13;
    for (const one of targets) {
      const offset = offsetAt(one, now.t);
      if (!offset) continue;
      const sign = camera.screen(finite(one.centre[0]) + offset[0], finite(one.centre[1]) + offset[1]);
      const distance = Math.hypot(sign.x - at.x, sign.y - at.y);
      if (distance < least) [least, target] = [distance, one];
    }
    const { x, y } = camera.plane(at);
    let shot = null;
    least = camera.px(7);
    for (const one of shots) {
      if (one.time_s > now.t && one !== now.shot) continue;
      const { distance } = nearestOnPolygon(x, y, [one.from, one.to]);
      if (distance < least) [least, shot] = [distance, one];
    }
    const covers = ({ core, radius_m: r }) =>
      nearestOnPolygon(x, y, core).distance <= r + 1e-9;
    const solids = this.solids.filter((solid) => solid.footprint.some(covers)).reverse();
    return { target, shot, solids };
  }

  hover(at) {
    this.tip.hidden = true;
    if (!at) return;
    const { target, shot, solids } = this.pick(at);
    const lines = [];
    if (target) {
      const base = finite(target.centre[2]) - finite(target.size[2]) / 2;
      lines.push(`${target.name}: ${statusAt(target, this.now.t)}`, `base at ${fixed(base, 2)} m, ${fixed(target.size[2], 2)} m high`);
    } else if (shot) {
      lines.push(`Shot ${shot.index + 1} at ${shot.target}: ${shot.hit ? "hit" : `touched ${shot.contact}`}`);
    }
    for (const solid of solids.slice(0, 3)) {
      lines.push(`${solid.name}: ${fixed(solid.low_z_m, 2)} to ${fixed(solid.high_z_m, 2)} m${solid.blocks_driving ? "" : ", does not block driving"}`);
    }
    this.camera.canvas.style.cursor = target || shot ? "pointer" : "crosshair";
    if (lines.length === 0) return;
    this.tip.textContent = lines.join("\n");
    this.tip.hidden = false;
    const room = this.camera.width - this.tip.offsetWidth - 8;
    this.tip.style.left = `${clamp(at.x + 14, 4, Math.max(4, room))}px`;
    const above = at.y + 18 + this.tip.offsetHeight > this.camera.height;
    this.tip.style.top = `${above ? at.y - 10 - this.tip.offsetHeight : at.y + 18}px`;
  }
}

