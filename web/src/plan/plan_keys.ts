// Keys of the planning page: through a search, for start and goal, for steps back, for the view.
import type { Camera } from "../base/camera";
import type { Key } from "../base/keys";
import type { Steps } from "./steps";

export const searchKeys = (steps: Steps): Key[] => [
  { key: " ", words: "play or pause the search", act: () => steps.toggle() },
  { key: "ArrowLeft", words: "one expansion back", act: () => steps.go(steps.step - 1) },
  { key: "ArrowRight", words: "one expansion on", act: () => steps.go(steps.step + 1) },
  { key: "Shift+ArrowLeft", words: "100 expansions back", act: () => steps.go(steps.step - 100) },
  { key: "Shift+ArrowRight", words: "100 expansions on", act: () => steps.go(steps.step + 100) },
  { key: "Home", words: "before the search", act: () => steps.go(0) },
  { key: "End", words: "the whole search", act: () => steps.go(steps.end) },
];

export const endKeys = (acts: { select: (end: "start" | "goal") => void; nudge: (dx: number, dy: number) => void; turn: (side: number) => void }): Key[] => [
  { key: "1", words: "take the start", act: () => acts.select("start") },
  { key: "2", words: "take the goal", act: () => acts.select("goal") },
  { key: "h", words: "move it left", act: () => acts.nudge(-1, 0) },
  { key: "j", words: "move it down", act: () => acts.nudge(0, -1) },
  { key: "k", words: "move it up", act: () => acts.nudge(0, 1) },
  { key: "l", words: "move it right", act: () => acts.nudge(1, 0) },
  { key: ",", words: "turn the start left, where a planner counts its heading", act: () => acts.turn(1) },
  { key: ".", words: "turn the start right", act: () => acts.turn(-1) },
];

export const undoKeys = (undo: (again: boolean) => void): Key[] => [
  { key: "Ctrl+z", words: "undo", act: () => undo(false) },
  { key: "u", words: "undo", act: () => undo(false) },
  { key: "Ctrl+y", words: "do it again", act: () => undo(true) },
  { key: "U", words: "do it again", act: () => undo(true) },
];

export const cameraKeys = (cameras: () => Camera[]): Key[] => [
  { key: "+", words: "zoom in", act: () => cameras().forEach((one) => one.zoom(1.5)) },
  { key: "-", words: "zoom out", act: () => cameras().forEach((one) => one.zoom(1 / 1.5)) },
  { key: "0", words: "show everything", act: () => cameras().forEach((one) => one.reset()) },
];
