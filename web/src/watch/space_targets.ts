// Targets, the water that flies at them, and pursuers with what they pursue, in space.
import { BoxGeometry, BufferGeometry, EdgesGeometry, Float32BufferAttribute, Line, LineBasicMaterial, LineSegments, Mesh, RingGeometry, SphereGeometry } from "three";
import { statusColour } from "../base/signs";
import { pursuerColours, theme } from "../base/theme";
import { ballOf, blockedOf, flightsOf, type Flight } from "../log/flights";
import { pursuitOf } from "../log/pursuit";
import type { Run } from "../log/run";
import { targetsOf, type TargetStory } from "../log/targets";
import { costPicture, placeOnWay } from "./pursuit_layer";
import { carpet, lambert, lineOf, type Actor } from "./space_parts";

function oneTarget(target: TargetStory): Actor {
  const { size, yaw } = target.last;
  const [length, width, height] = [size.x, size.y, size.z].map((value) => Math.max(0.02, value)) as [number, number, number];
  const material = lambert(theme.waiting, 0.92);
  const box = new Mesh(new BoxGeometry(length, width, height), material);
  box.rotation.z = yaw;
  box.add(new LineSegments(new EdgesGeometry(box.geometry), new LineBasicMaterial({ color: theme.ink })));
  const halo = new Mesh(new RingGeometry(0.32, 0.38, 40), lambert(theme.ink));
  return { things: [box, halo], act: (now) => {
    const place = target.placeAt(now.t);
    box.visible = place !== null;
    halo.visible = place !== null && now.target === target;
    if (!place) return;
    const [, , middle] = target.centre;
    box.position.set(place[0], place[1], middle);
    halo.position.set(place[0], place[1], middle - height / 2 + 0.015);
    material.color.set(statusColour(target.statusAt(now.t)));
  } };
}

export const targetActor = (run: Run): Actor[] => targetsOf(run).map(oneTarget);

/** The flight of the ball, or of the selected shot while none is in the air. */
export function waterActor(run: Run): Actor[] {
  const flights = flightsOf(run);
  if (flights.length === 0) return [];
  const ball = new Mesh(new SphereGeometry(Math.max(0.05, 2 * run.info.ball_radius), 20, 14), lambert(theme.water));
  const samples = 48;
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(new Float32Array(3 * (samples + 1)), 3));
  const material = new LineBasicMaterial({ color: theme.water });
  const curve = new Line(geometry, material);
  curve.frustumCulled = false;
  const draw = (shot: Flight, until: number): void => {
    const positions = geometry.getAttribute("position");
    for (let i = 0; i <= samples; ++i) {
      const { x, y, z } = ballOf(run, shot, (until * i) / samples);
      positions.setXYZ(i, x, y, z);
    }
    positions.needsUpdate = true;
    material.color.set(shot.hit ? theme.water : theme.failed);
  };
  return [{ things: [ball, curve], act: ({ t, shot }) => {
    const flying = flights.find((one) => t >= one.start && t < one.end);
    ball.visible = flying !== undefined;
    const shown = flying ?? shot;
    curve.visible = shown !== null;
    if (shown) draw(shown, flying ? t - shown.start : shown.end - shown.start);
    if (!flying) return;
    const { x, y, z } = ballOf(run, flying, t - flying.start);
    ball.position.set(x, y, z);
  } }];
}

/** The best blocked flight at each target that cannot be hit, with a ball where something is in its way. */
export function blockedActor(run: Run): Actor[] {
  const samples = 48;
  return [...blockedOf(run).values()].map((flight): Actor => {
    const points = Array.from({ length: samples + 1 }, (_, i): [number, number, number] => {
      const { x, y, z } = ballOf(run, flight, ((flight.end - flight.start) * i) / samples);
      return [x, y, z];
    });
    const curve = lineOf(points, theme.unreachable);
    const stop = new Mesh(new SphereGeometry(0.07, 16, 12), lambert(theme.unreachable));
    stop.position.set(...flight.to);
    const story = targetsOf(run).find(({ name }) => name === flight.target);
    return { things: [curve, stop], act: ({ t }) => { curve.visible = stop.visible = story?.statusAt(t) === "unreachable"; } };
  });
}

export function pursuitActor(run: Run): Actor[] {
  const pursuit = pursuitOf(run);
  if (!pursuit) return [];
  const { origin: { x, y }, width, height, resolution } = pursuit.grid;
  const size = 0.6 * resolution;
  const ways = [pursuit.target, ...pursuit.robots].map((way, i): Actor => {
    const colour = i === 0 ? theme.failed : pursuerColours()[(i - 1) % pursuerColours().length]!;
    const body = new Mesh(new SphereGeometry(size, 20, 14), lambert(colour));
    return { things: [body, lineOf(way.map(([wx, wy]) => [wx, wy, 0.1]), colour)], act: ({ t }) => body.position.set(...placeOnWay(way, t), size) };
  });
  return [{ things: [carpet(costPicture(pursuit.grid), [x, y, x + width * resolution, y + height * resolution], 0.01).mesh] }, ...ways];
}
