#!/usr/bin/env node
// An engine for `moreau gate`: one ball over a plane, without friction. It gets verdicts as it stands.
//
//     moreau protocol-check -- node engine.js      what is wrong with the adapter
//     moreau gate --quick -- node engine.js        every check; what it cannot do is `unsupported`
//
// Put your engine where YOURS is written. Node alone is enough. The messages, moreau-engine/1, are one JSON object
// a line; docs/protocol.md of moreau specifies them, `moreau schema request` and `reply` too.
//
//     x_m = x + h/2 v,    v+ = v + h g + p n,    x+ = x_m + h/2 v+,
//
// where p is the least impulse over the mass, p >= 0, with n.v+ >= -e n.v; it acts if the ball touches at x_m.
"use strict";
const readline = require("node:readline");

// Throw it for whatever your engine does not have, with the reason. It never counts against the engine.
class Unsupported extends Error {}

// YOURS: who the engine is, and the contact law that it documents. The gate predicts from it what is to be expected.
const DESCRIPTION = {
  name: "my-engine", version: "0.1.0", precision: "double",
  contact_model: { kind: "rigid", law: "coulomb" },
  restitution: true, friction: "none", reports_contacts: true,
  levels: ["simulate"], shapes: ["sphere"], options: {},
};

const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const plus = (a, s, b) => a.map((x, k) => x + s * b[k]);

// YOURS: the scene in your engine.
class World {
  constructor(scene, h) {
    const [ball] = scene.bodies, material = scene.material;
    if (scene.bodies.length > 1 || !ball.sphere || (ball.angular_velocity || []).some((w) => w !== 0)) {
      throw new Unsupported("one ball that does not turn is all there is");
    }
    if (material.friction > 0 || (material.pairs || []).length > 0) {
      throw new Unsupported("there is no friction, and no values of pairs");
    }
    Object.assign(this, { h, ball, gravity: scene.gravity, ground: scene.ground, restitution: material.restitution || 0 });
    [this.x, this.v] = [ball.position, ball.linear_velocity || [0, 0, 0]];
  }

  // One time step; the impulse [N s] of the ground on the ball, as a vector.
  step() {
    const h = this.h, before = this.v, n = this.ground ? this.ground.normal : [0, 0, 1];
    let p = 0;
    this.x = plus(this.x, h / 2, before);
    this.v = plus(before, h, this.gravity);
    if (this.ground && dot(n, this.x) - this.ground.offset <= this.ball.sphere.radius) {
      p = Math.max(0, -dot(n, this.v) - this.restitution * dot(n, before));
    }
    this.v = plus(this.v, p, n);
    this.x = plus(this.x, h / 2, this.v);
    return n.map((component) => this.ball.mass * p * component);
  }

  // Of every body in the order of the scene: position, orientation [w, x, y, z], velocity, angular velocity.
  state() {
    return [[this.x, this.ball.orientation || [1, 0, 0, 0], this.v, [0, 0, 0]]];
  }
}

function describe(request) {
  if (Object.keys(request.options || {}).length > 0) throw new Error("this engine has no options");
  return DESCRIPTION;
}

// The trajectory/1 of a scene: a sample every `sample_every` steps, impulses summed over the time between samples.
function simulate(request) {
  describe(request);
  const { scene, time_step: h, sample_every: every } = request;
  const world = new World(scene, h), steps = Math.round(scene.duration / h);
  if (Math.abs(steps * h - scene.duration) > 1e-9 * scene.duration) {
    throw new Error(`the time step ${h} does not divide the duration ${scene.duration}`);
  }
  const keys = ["position", "orientation", "linear_velocity", "angular_velocity"];
  const tracks = scene.bodies.map((body) => Object.fromEntries([["name", body.name], ...keys.map((key) => [key, []])]));
  const times = [], contacts = [];
  let impulse = [0, 0, 0];
  for (let step = 0; step <= steps; step += 1) {
    if (step > 0) impulse = plus(impulse, 1, world.step());
    if (step % every !== 0) continue;
    if (impulse.some((component) => component !== 0)) {
      const bodies = [scene.bodies[0].name, "ground"];
      contacts.push({ sample: times.length, bodies, normal: scene.ground.normal, impulse });
    }
    impulse = [0, 0, 0];
    times.push(step * h);
    world.state().forEach((values, body) => keys.forEach((key, k) => tracks[body][key].push(values[k])));
  }
  const engine = { name: DESCRIPTION.name, version: DESCRIPTION.version };
  return { schema: "trajectory/1", scene, engine, time_step: h, times, bodies: tracks, contacts };
}

const HANDLERS = { describe, simulate, bye: () => ({}) };

// What was asked, and the reply. Nothing below needs to be changed.
function answer(line) {
  let id = null;
  try {
    const request = JSON.parse(line);
    if (request === null || typeof request !== "object" || Array.isArray(request)) throw new Error("a request is an object");
    id = request.id === undefined ? null : request.id;
    if (request.protocol !== "moreau-engine/1") throw new Error("this adapter speaks moreau-engine/1");
    if (!Object.hasOwn(HANDLERS, request.request)) throw new Unsupported(`there is no request ${request.request}`);
    return [request.request, { id, result: HANDLERS[request.request](request) }];
  } catch (problem) {
    return ["", problem instanceof Unsupported ? { id, unsupported: problem.message } : { id, error: String(problem) }];
  }
}

console.log = console.error; // what anything prints is no reply
const lines = readline.createInterface({ input: process.stdin });
lines.on("line", (line) => {
  const [kind, reply] = answer(line);
  process.stdout.write(JSON.stringify(reply) + "\n");
  if (kind === "bye") process.stdin.destroy(); // nothing is left to wait for, and the program ends
});
