// The one door to the runs of the explorer: moreau.run(scene, scheme, parameters).
//
// It promises { refused } with what the scheme says, or a run in SI units, sample 0 the start and sample k the end of step k:
//   { note, scheme, law, h, steps, limit, ground: [n_x, n_z, c] or null,
//     bodies: [{ name, size, x, z, angle, vx, vz, omega, y }], energy, gap, natural, relative, verdict, word,
//     contacts: [{ bodies: [first, second or -1], active, rn, rt, rs, un, ut, us, yn, yt, ys }] }
// t is the tangent in the plane of the picture, s the one across it. Every name of a sample's numbers is a list over the samples.
// natural and relative are null where nothing was solved, and Infinity where they are no number; verdict is 0 (nothing solved),
// 1 (accepted), 2 (unconverged by declaration) or 3 (rejected).
// Here the runs are read from scripts that `moreau report` wrote. Whatever else gives the same promise may take this file's place.
"use strict";
const moreau = (() => {
  const kept = new Map(), asked = new Map();
  const folder = document.currentScript.src.replace(/[^/]*$/, "");
  const BODY = ["x", "z", "angle", "vx", "vz", "omega", "y"];
  const WHOLE = ["energy", "gap", "natural", "relative", "verdict", "word"];
  const CONTACT = ["active", "rn", "rt", "rs", "un", "ut", "us", "yn", "yt", "ys"];

  // A channel: its order, then its differences; see code.rs.
  const reader = (text) => {
    const bytes = atob(text);
    let at = 0;
    const taken = () => {
      let value = 0, scale = 1;
      for (;;) {
        const byte = bytes.charCodeAt(at++);
        value += (byte % 128) * scale;
        if (byte < 128) return value;
        scale *= 128;
      }
    };
    return (length) => {
      const order = bytes.charCodeAt(at++), numbers = new Array(length).fill(0);
      for (let k = 0; k < length; k++) {
        const value = taken();
        numbers[k] = value % 2 ? -(value + 1) / 2 : value / 2;
        if (value === 0) k += taken();
      }
      for (let d = 0; d < order; d++) for (let k = 1; k < length; k++) numbers[k] += numbers[k - 1];
      return numbers;
    };
  };
  const millionths = (number) => number / 1e6;
  const residual = (code) => {
    if (code === 0) return null;
    if (code < 1000) return code === 1 ? 0 : Infinity;
    const [exponent, digits] = [Math.floor((code - 1000) / 100) - 400, (code - 1000) % 100];
    return Number(`${digits / 10}e${exponent}`);
  };
  const unpacked = (run, scene, note) => {
    const next = reader(run.data), length = run.steps + 1;
    const group = (names) => Object.fromEntries(names.map((name) => [name, next(length)]));
    const real = (group) => Object.fromEntries(Object.entries(group).map(([name, all]) => [name, all.map(millionths)]));
    const bodies = scene.bodies.map((body) => ({ ...body, ...real(group(BODY)) }));
    const whole = group(WHOLE);
    const contacts = run.contacts.map(([first, second]) => {
      const { active, ...numbers } = group(CONTACT);
      return { bodies: [first, second], active, ...real(numbers) };
    });
    return {
      note, scheme: run.scheme, law: run.law, h: run.h, steps: run.steps, limit: run.limit, ground: scene.ground, bodies, contacts,
      energy: whole.energy.map(millionths), gap: whole.gap.map(millionths), natural: whole.natural.map(residual),
      relative: whole.relative.map(residual), verdict: whole.verdict, word: whole.word.map((word) => run.words[word] || ""),
    };
  };

  const scripts = (scene) => {
    if (!asked.has(scene)) {
      asked.set(scene, new Promise((resolve, reject) => {
        const script = document.createElement("script"), file = `${folder}${scene}.js`;
        const failed = () => { asked.delete(scene); reject(new Error(file)); };
        script.src = file;
        script.addEventListener("load", () => kept.has(scene) ? resolve(kept.get(scene)) : failed());
        script.addEventListener("error", failed);
        document.head.append(script);
      }));
    }
    return asked.get(scene);
  };
  const key = (scheme, { h, theta, mu, e }) => `${scheme} h=${h}${theta === undefined ? "" : ` theta=${theta}`} mu=${mu} e=${e}`;
  const run = (scene, scheme, parameters) => scripts(scene).then((all) => {
    const name = key(scheme, parameters), told = all.runs[name];
    if (!told) throw new Error(`${scene}: ${name}`);
    const stored = all.stored[told.run];
    return stored.refused === undefined ? unpacked(stored, all, told.note || "") : { refused: stored.refused };
  });
  return { run, keep: (scene, runs) => { kept.set(scene, runs); } };
})();
