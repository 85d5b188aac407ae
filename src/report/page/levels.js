// Water and charge that end: their levels over the run, and the stations in the plan view.

const { supplies } = report;

function drawStations(ctx, camera) {
  if (!supplies) return;
  camera.toScreen(ctx);
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.font = `450 11.5px ${theme.sans}`;
  for (const { name, position, gives_water, gives_charge } of supplies.stations) {
    const { x, y } = camera.screen(...position);
    ctx.fillStyle = gives_water ? theme.water : theme.robot;
    ctx.fillRect(x - 6, y - 6, 12, 12);
    if (gives_water && gives_charge) {
      ctx.fillStyle = theme.robot;
      ctx.fillRect(x, y - 6, 6, 12);
    }
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = 1.2;
    ctx.strokeRect(x - 6, y - 6, 12, 12);
    ctx.fillStyle = theme.ink;
    ctx.fillText(name, x + 10, y);
  }
  camera.toPlane(ctx);
}

class Levels {
  constructor(section) {
    section.hidden = !supplies;
    if (!supplies) return;
    const canvas = section.querySelector("canvas");
    this.canvas = canvas;
    this.rows = [
      { name: "water", full: supplies.tank, column: 1, colour: "water", unit: "" },
      { name: "charge", full: supplies.battery_j, column: 2, colour: "robot", unit: " J" },
    ].filter((row) => Number.isFinite(row.full));
    new ResizeObserver(() => invalidate()).observe(canvas);
  }

  at(row, t) {
    const { levels } = supplies;
    const next = levels.findIndex((level) => level[0] > t);
    if (next <= 0) return levels.at(next)?.[row.column] ?? row.full;
    const [a, b] = [levels[next - 1], levels[next]];
    return mix(a[row.column], b[row.column], (t - a[0]) / (b[0] - a[0]));
  }

  draw(t) {
    if (!this.canvas) return;
    const { canvas } = this;
    const ratio = devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const ctx = canvas.getContext("2d");
    ctx.scale(ratio, ratio);
    ctx.font = `11.5px ${theme.sans}`;
    const [left, right] = [150, width - 12];
    const x = (time) => left + (right - left) * clamp(time / duration, 0, 1);
    const tall = height / this.rows.length;
    this.rows.forEach((row, i) => {
      const [top, base] = [i * tall + 6, (i + 1) * tall - 6];
      const y = (level) => base - (base - top) * clamp(level / row.full, 0, 1);
      ctx.fillStyle = theme.ink;
      ctx.textBaseline = "middle";
      ctx.fillText(`${row.name} ${fixed(this.at(row, t), 1)} of ${fixed(row.full, 0)}${row.unit}`, 8, (top + base) / 2);
      ctx.strokeStyle = theme.line;
      ctx.strokeRect(left, top, right - left, base - top);
      ctx.beginPath();
      for (const level of supplies.levels) ctx.lineTo(x(level[0]), y(level[row.column]));
      ctx.strokeStyle = theme[row.colour];
      ctx.lineWidth = 1.5;
      ctx.stroke();
      ctx.lineWidth = 1;
    });
    ctx.strokeStyle = theme.ink;
    ctx.beginPath();
    ctx.moveTo(x(t), 2);
    ctx.lineTo(x(t), height - 2);
    ctx.stroke();
  }
}
