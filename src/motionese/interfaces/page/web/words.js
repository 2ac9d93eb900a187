// The words that the page explains: a sentence each, a picture where it helps, and who says so.

import { task } from "./task.js";

const MOCHIZUKI = "Mochizuki et al. 2013";
const BRAND = "Brand et al. 2002";
const ROHLFING = "Rohlfing et al. 2006";
const YAMASHITA = "Yamashita & Tani 2008";

/** Pictures are lines [kind, path] in a field of 120 by 48. */
export const WORDS = {
  caregiver: {
    title: "Caregiver",
    sentence: "Who shows the motions, and lets the robot find out by imitating: here, you.",
    source: MOCHIZUKI,
  },
  primitive: {
    title: "Primitive",
    sentence: "A piece of motion that comes again in many others, such as one stroke.",
    source: MOCHIZUKI,
    picture: [
      ["slow", "M16 6V40M16 40l-5-7M16 40l5-7"],
      ["fast", "M52 40V8M52 8l-5 7M52 8l5 7"],
      ["io", "M108 24H76M76 24l7-5M76 24l7 5"],
    ],
  },
  tau: {
    title: "τ, the time constant",
    sentence: "In about how many steps a unit follows its input: few are fast, many are slow.",
    source: YAMASHITA,
    picture: [
      ["axis", "M4 44H116"],
      ["fast", "M8 44C14 10 22 8 116 8"],
      ["slow", "M8 44C44 36 72 20 116 16"],
    ],
  },
  io: {
    title: "IO, input and output",
    sentence: "Units that take in what is sensed now, and foretell what will be sensed next.",
    source: MOCHIZUKI,
    picture: [
      ["io", "M6 24H44M44 24l-7-5M44 24l-7 5M76 24H114M114 24l-7-5M114 24l-7 5"],
      ["axis", "M48 10H72V38H48Z"],
    ],
  },
  cf: {
    title: "Cf, fast context",
    sentence: "Units of a small τ, in which primitives are to come about.",
    source: MOCHIZUKI,
    picture: [["fast", "M4 24C12-4 20-4 28 24S44 52 52 24 68-4 76 24 92 52 100 24 112 4 116 14"]],
  },
  cs: {
    title: "Cs, slow context",
    sentence: "Units of a large τ, which are to hold the order of primitives.",
    source: MOCHIZUKI,
    picture: [["slow", "M4 38C40 38 70 10 116 10"]],
  },
  start: {
    title: "Initial state",
    sentence: "Where the network starts from; each motion has one, and another leads elsewhere.",
    source: YAMASHITA,
    picture: [
      ["slow", "M8 12C50 12 70 4 112 6M8 9v6"],
      ["fast", "M8 36C50 36 70 46 112 44M8 33v6"],
    ],
  },
  loop: {
    title: "Closed loop",
    sentence: "What the network foretells is its next input: it goes on without looking.",
    source: YAMASHITA,
    picture: [
      ["axis", "M40 8H80V30H40Z"],
      ["io", "M80 19H100V42H20V19H36M36 19l-7-5M36 19l-7 5"],
    ],
  },
  motionese: {
    title: "Motionese",
    sentence: "How people show things to infants: slower, with more pauses, wider, and again.",
    source: BRAND,
  },
  pauses: {
    title: "Pauses",
    sentence: "Where the hand is still between two movements, for 0.15 s at least.",
    source: ROHLFING,
    picture: [
      ["axis", "M4 44H116"],
      ["io", "M4 42C16 42 16 8 28 8S40 42 48 42H72C80 42 80 8 92 8S104 42 116 42"],
    ],
  },
  pace: {
    title: "Pace",
    sentence: "How many times as long as it pauses the hand moves; a low pace has long pauses.",
    source: ROHLFING,
  },
  roundness: {
    title: "Roundness",
    sentence: "How long a way is, over the distance of its ends: 1 is straight, 1.57 half a circle.",
    source: ROHLFING,
    picture: [
      ["axis", "M12 42H108"],
      ["io", "M12 42C30 2 90 2 108 42"],
    ],
  },
  places: {
    get title() {
      return Object.keys(task.places).join(", ");
    },
    get sentence() {
      const all = Object.entries(task.places).map(([name, { title }]) => `${name} is ${title}`);
      return `Motions are named by where they start, and an arrow a stroke: ${all.join("; ")}.`;
    },
    source: "",
  },
};
