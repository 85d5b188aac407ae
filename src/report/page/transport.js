// Time: play, pause, speed, slider with a tick for every shot, keys.

const playIcon = "M6 3.5v13l11-6.5z";
const pauseIcon = "M5 3.5h3.6v13H5zM11.4 3.5H15v13h-3.6z";

class Transport {
  constructor(section, { change, selectShot }) {
    this.change = change;
    this.selectShot = selectShot;
    this.t = 0;
    this.playing = false;
    this.play = section.querySelector("#play");
    this.slider = section.querySelector("#slider");
    this.clock = section.querySelector("#clock");
    this.action = section.querySelector("#action");
    this.state = section.querySelector("#state");
    this.fillSpeeds(section.querySelector("#speed"));
    this.fillTicks(section.querySelector("#ticks"));
    this.slider.max = String(duration);
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    this.play.addEventListener("click", () => this.toggle());
    section.querySelector("#back").addEventListener("click", () => this.step(-1));
    section.querySelector("#next").addEventListener("click", () => this.step(1));
    document.addEventListener("keydown", (event) => this.key(event));
  }

  fillSpeeds(select) {
    for (let speed = 1; speed <= 64; speed *= 2) select.append(element("option", `${speed}\u00d7`, { value: speed }));
    const wanted = 2 ** clamp(Math.round(Math.log2(duration / 45)), 0, 6);  // the whole run in under a minute or so
    select.value = String(wanted);
    this.speed = wanted;
    select.addEventListener("change", () => { this.speed = Number(select.value); });
  }

  fillTicks(place) {
    const share = (t) => `${(100 * clamp(t / duration, 0, 1)).toFixed(3)}%`;
    for (const path of report.paths) {
      const leg = element("i", "", { class: "leg" });
      leg.style.left = share(finite(path.start_s));
      leg.style.width = share(finite(path.end_s) - finite(path.start_s));
      place.append(leg);
    }
    this.ticks = shots.map((shot) => {
      const tick = element("i", "", { class: shot.hit ? "tick" : "tick miss", title: `Shot ${shot.index + 1} at ${shot.target}: ${shot.hit ? "hit" : "miss"}` });
      tick.style.left = share(shot.time_s);
      tick.addEventListener("click", () => this.selectShot(shot));
      place.append(tick);
      return tick;
    });
  }

  /** The shot after or before the present time. */
  step(direction) {
    const later = (shot) => shot.time_s > this.t + 1e-6;
    const earlier = (shot) => shot.time_s < this.t - 1e-6;
    const shot = direction > 0 ? shots.find(later) : shots.findLast(earlier);
    if (shot) this.selectShot(shot);
  }

  seek(t) {
    this.t = clamp(t, 0, duration);
    this.change();
  }

  toggle(on = !this.playing) {
    this.playing = on;
    if (on && this.t >= duration - 1e-9) this.t = 0;
    this.play.setAttribute("aria-label", on ? "Pause" : "Play");
    this.play.querySelector("path").setAttribute("d", on ? pauseIcon : playIcon);
    this.change();
  }

  /** Moves time on by `elapsed` seconds of the wall clock. */
  advance(elapsed) {
    if (!this.playing) return;
    this.t = Math.min(duration, this.t + Math.min(elapsed, 0.1) * this.speed);
    if (this.t >= duration) this.toggle(false);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, summary")) return;
    const onButton = event.target.closest("button");
    const stride = event.shiftKey ? 10 : 1;
    const acts = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.seek(this.t - stride),
      ArrowRight: () => this.seek(this.t + stride),
      Home: () => this.seek(0),
      End: () => this.seek(duration),
      n: () => this.step(1),
      p: () => this.step(-1),
    };
    const act = acts[event.key];
    if (!act || (event.key === " " && onButton)) return;
    event.preventDefault();
    act();
  }

  show(shot) {
    const { t } = this;
    this.slider.value = String(t);
    this.slider.style.setProperty("--done", `${((100 * t) / duration).toFixed(2)}%`);
    this.slider.setAttribute("aria-valuetext", `${clockText(t)} of ${clockText(duration)}`);
    this.clock.replaceChildren(clockText(t, 1), " ", element("small", `/ ${clockText(duration)}`));
    this.action.textContent = eventAt(t)?.text ?? "Before the start";
    const at = robotAt(t);
    const turn = (angle) => degrees(Math.atan2(Math.sin(angle), Math.cos(angle)), 0);
    this.state.textContent = `x ${fixed(at.x, 2)}  y ${fixed(at.y, 2)}  \u2220 ${turn(at.heading)}  gun ${turn(at.yaw)} \u2191${degrees(at.pitch, 0)}`;
    this.ticks.forEach((tick, i) => tick.classList.toggle("selected", shots[i] === shot));
  }
}

