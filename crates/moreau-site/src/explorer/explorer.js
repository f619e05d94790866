// The explorer: controls, panels, time and address. It knows the runs by moreau.run alone and draws with moreauDraw.
"use strict";
(() => {
  const $ = (id) => document.getElementById(`explorer-${id}`);
  const { scenes, schemes, steps, texts } = JSON.parse($("table").textContent);
  const folder = document.getElementById("explorer").dataset.folder;
  const PANELS = ["coulomb", "anitescu", "sap", "mujoco"];
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const STILL = 500; // [ms] between two pictures where motion is to be reduced
  const state = { sample: 0, last: 1, h: 1, playing: false, begun: 0, from: 0, asked: 0, panels: new Map() };

  const plain = (value) => Number(value.toFixed(6)).toFixed(6).replace(/\.?0+$/, "").replace(/^-0$/, "0");
  const digits = (value) => value === 0 ? "0" : value.toExponential(1).replace(".0e", "e");
  const short = (value) => value === null ? "–" : value === Infinity ? "NaN" : digits(value);
  const scene = () => scenes.find((one) => one.id === $("scene").value);
  const scheme = (panel) => panel === "coulomb" ? $("scheme").value : $(panel).dataset.scheme;
  const entry = (id) => schemes.find((one) => one.id === id);
  const parameters = (id) => ({
    h: $("step").value, theta: entry(id).theta.length ? Number($("theta").value) : undefined,
    mu: Number($("friction").value), e: Number($("restitution").value),
  });

  // The controls: what is offered, and where it acts.
  const offer = (id, values, wanted, otherwise = 1) => {
    const select = $(id), before = wanted === undefined ? select.value : String(wanted);
    select.replaceChildren(...values.map((value) => new Option(String(value), String(value))));
    select.value = values.map(String).includes(before) ? before : String(values[Math.min(otherwise, values.length - 1)]);
    select.disabled = values.length < 2;
  };
  const offerAll = (wanted = {}) => {
    const { friction, restitution, about } = scene(), { theta } = entry($("scheme").value);
    offer("theta", schemes[0].theta, wanted.theta, 0);
    $("theta").disabled = theta.length < 2;
    offer("friction", friction, wanted.mu);
    offer("restitution", restitution, wanted.e);
    $("theta-note").textContent = theta.length ? texts.thetaActs : texts.thetaNot;
    $("restitution-note").textContent = restitution.length > 1 ? texts.restitutionActs : texts.actsNot;
    $("friction-note").textContent = friction.length > 1 ? "" : texts.actsNot;
    $("about").textContent = about;
  };

  // The address keeps the choice.
  const NAMES = { scene: "scene", scheme: "scheme", theta: "theta", mu: "friction", e: "restitution", h: "step" };
  const write = () => {
    const parts = Object.entries(NAMES).map(([name, id]) => `${name}=${$(id).value}`);
    history.replaceState(null, "", `#${[...parts, `k=${state.sample}`].join("&")}`);
    // the page in the other language opens with the same choice
    const twin = document.querySelector("a.language");
    if (twin) twin.href = twin.getAttribute("href").split("#")[0] + location.hash;
  };
  const read = () => {
    const asked = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
    const take = (name, known) => { if (known.includes(asked[name])) $(NAMES[name]).value = asked[name]; };
    take("scene", scenes.map((one) => one.id));
    take("scheme", schemes.filter((one) => one.id === "moreau-jean" || one.id === "stewart-trinkle").map((one) => one.id));
    take("h", steps);
    offerAll(asked);
    state.sample = Math.max(0, Math.floor(Number(asked.k)) || 0);
  };

  // The panels.
  const command = (panel) => {
    const id = scheme(panel), { h, theta, mu, e } = parameters(id), file = `${scene().id}-mu${mu}-e${e}.json`;
    const more = [theta === undefined ? "" : `--theta ${theta}`, entry(id).options, "--out run.json"].filter(Boolean).join(" ");
    $(`${panel}-command`).textContent = `moreau simulate --scene ${file} --scheme ${id} --step ${h} ${more}`;
    $(`${panel}-scene`).href = `${folder}${file}`;
  };
  const refuse = (panel, text) => {
    $(`${panel}-refusal`).textContent = text;
    $(`${panel}-refusal`).hidden = false;
    $(`${panel}-pictures`).hidden = true;
    ["certificate", "numbers", "note"].forEach((part) => $(`${panel}-${part}`).replaceChildren());
  };
  const ranges = (runs) => {
    const range = (name) => {
      const [low, high] = runs.flatMap((run) => run[name])
        .reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
      return high > low ? [low, high] : [low - 0.5, high + 0.5];
    };
    return { gap: range("gap"), energy: range("energy"), room: moreauDraw.room(runs) };
  };
  const prepare = (panel, run, { gap, energy, room }) => {
    const width = Math.max(240, $(`${panel}-pictures`).clientWidth || 300);
    const mu = Number($("friction").value), svg = (part) => $(`${panel}-${part}`);
    const graph = (part, more) => moreauDraw.graph(svg(part), run, { values: run[part], ...more }, width, 96);
    const drawn = [
      moreauDraw.motion(svg("motion"), run, room, width, 190),
      moreauDraw.cone(svg("cone"), run, mu, width, 170),
      graph("gap", { range: gap, label: `${texts.gap} [m]` }),
      graph("energy", { range: energy, label: `${texts.energy} [J]` }),
      graph("natural", { range: [-18, 0], log: true, label: `${texts.natural} [N·s]`, marks: run.verdict }),
    ];
    const away = Math.max(...run.bodies.flatMap((body) => body.y).map(Math.abs));
    const notes = [run.note && (texts[run.note] || run.note), away > 0 && `${texts.away} ${plain(away)} m`];
    $(`${panel}-note`).textContent = notes.filter(Boolean).join("; ");
    return { run, show: (k) => drawn.forEach((part) => part(k)) };
  };

  // The numbers of a sample.
  const residual = (word) => texts[word === "velocity" ? "velocityResidual" : word] || word;
  const verdict = (run, k) => {
    const kind = run.verdict[k];
    if (!k) return ["", texts.start];
    if (!kind) return ["", texts.nothing];
    const word = [texts.accepted, texts.unconverged, texts.rejected][kind - 1];
    const limit = `${texts.limit} ${short(run.limit)}`;
    const told = `${word}; ${texts.largest} ${short(run.relative[k])} (${residual(run.word[k])}, ${limit})`;
    return [["pass", "difference", "fail"][kind - 1], told];
  };
  const numbers = (run, k) => {
    const rows = run.bodies.map((body) => [body.name, `${texts.height} (${plain(body.x[k])}, ${plain(body.z[k])}) m, ${texts.speed} `
      + `(${plain(body.vx[k])}, ${plain(body.vz[k])}) m/s, ${texts.spin} ${plain(body.omega[k])} rad/s`]);
    rows.push([texts.gap, `${plain(run.gap[k])} m`], [texts.energy, `${plain(run.energy[k])} J`]);
    rows.push([texts.natural, run.natural[k] === null ? "–" : `${short(run.natural[k])} N·s`]);
    const active = run.contacts.filter((contact) => contact.active[k] && contact.rn[k] !== 0);
    const size = (contact) => Math.hypot(contact.rn[k], contact.rt[k], contact.rs[k]);
    const top = active.reduce((most, contact) => !most || size(contact) > size(most) ? contact : most, undefined);
    if (!top) return [...rows, [texts.impulse, texts.open]];
    const name = (body) => body < 0 ? texts.ground : run.bodies[body].name;
    const parts = (part, unit) => {
      const [n, t, s] = ["n", "t", "s"].map((row) => plain(top[part + row][k]));
      return `n ${n}, t ${t}${s === "0" ? "" : `, ${texts.across} ${s}`} ${unit}`;
    };
    const count = active.length > 1 ? `${active.length} ${texts.more}: ` : "";
    return [...rows, [texts.impulse, `${count}${parts("r", "N·s")} (${top.bodies.map(name).join("/")})`],
      [texts.velocity, parts("u", "m/s")], [texts.law, parts("y", "m/s")]];
  };
  const tell = (panel, { run }, k) => {
    const [kind, words] = verdict(run, k), line = $(`${panel}-certificate`);
    line.textContent = words;
    line.className = `certificate ${kind}`;
    const item = (kind, text) => Object.assign(document.createElement(kind), { textContent: text });
    $(`${panel}-numbers`).replaceChildren(...numbers(run, k).flatMap(([name, value]) => [item("dt", name), item("dd", value)]));
  };
  const when = () => `t = ${plain(state.sample * state.h)} s, ${texts.step} ${state.sample}${texts.stepEnd} ${texts.of} ${state.last}`;
  // what is read aloud: not while it plays
  const announce = () => {
    const lines = [...state.panels].map(([panel, { run }]) => {
      const [, words] = verdict(run, state.sample);
      return `${entry(scheme(panel)).name}: ${texts.gap} ${plain(run.gap[state.sample])} m, ${words}`;
    });
    $("numbers").textContent = [when(), ...lines].join(". ");
  };
  const show = (sample) => {
    state.sample = Math.min(state.last, Math.max(0, sample));
    state.panels.forEach((panel, id) => { panel.show(state.sample); tell(id, panel, state.sample); });
    $("time").value = state.sample;
    $("time").setAttribute("aria-valuetext", when());
    if (!state.playing) { announce(); write(); }
  };

  // A choice: every run is asked for, and drawn when all have come, so that they share their scales.
  const choose = async () => {
    const asked = ++state.asked;
    halt();
    const all = await Promise.all(PANELS.map((panel) => {
      const id = scheme(panel);
      return moreau.run(scene().id, id, parameters(id)).catch((error) => ({ missing: error.message }));
    }));
    if (asked !== state.asked) return;
    const runs = all.filter((run) => run.bodies), common = runs.length ? ranges(runs) : {};
    state.panels = new Map();
    if (runs.length) [state.last, state.h] = [runs[0].steps, runs[0].h];
    $("time").max = state.last;
    all.forEach((run, k) => {
      const panel = PANELS[k], { name, law } = entry(scheme(panel));
      [$(`${panel}-name`).textContent, $(`${panel}-law`).textContent] = [name, law];
      command(panel);
      if (!run.bodies) { refuse(panel, run.missing ? `${texts.missing} ${run.missing}` : `${texts.refused}: ${run.refused}`); return; }
      $(`${panel}-refusal`).hidden = true;
      $(`${panel}-pictures`).hidden = false;
      state.panels.set(panel, prepare(panel, run, common));
    });
    show(state.sample);
    document.getElementById("explorer").dataset.ready = String(asked);
  };

  // Time.
  const tick = (now) => {
    if (!state.playing) return;
    if (!calm.matches || now - state.begun >= STILL) {
      // a page that was hidden does not jump
      state.from += Math.min(1, (now - state.begun) / 1000) * Number($("speed").value);
      state.begun = now;
      const sample = Math.min(state.last, Math.floor(state.from / state.h));
      if (sample !== state.sample) show(sample);
      if (sample === state.last) { halt(); show(sample); }
    }
    requestAnimationFrame(tick);
  };
  const halt = () => { state.playing = false; $("play").textContent = texts.play; };
  const toggle = () => {
    if (state.playing) { halt(); show(state.sample); return; }
    if (state.sample === state.last) show(0);
    Object.assign(state, { playing: true, begun: performance.now(), from: state.sample * state.h });
    $("play").textContent = texts.pause;
    requestAnimationFrame(tick);
  };
  const move = (steps) => { halt(); show(state.sample + steps); };
  $("play").addEventListener("click", toggle);
  $("back").addEventListener("click", () => move(-1));
  $("on").addEventListener("click", () => move(1));
  $("time").addEventListener("input", () => { halt(); show(Number($("time").value)); });
  $("choice").addEventListener("submit", (event) => event.preventDefault());
  $("choice").addEventListener("change", (event) => {
    if (event.target === $("scene") || event.target === $("scheme")) offerAll();
    // another step keeps the time, another scene starts anew
    if (event.target === $("step")) state.sample = Math.round(state.sample * state.h / stepOf($("step").value));
    if (event.target === $("scene")) state.sample = 0;
    choose();
  });
  const stepOf = (text) => text.split("/").map(Number).reduce((a, b) => a / b);
  addEventListener("hashchange", () => { read(); choose(); });
  let wide = 0;
  new ResizeObserver(() => {
    const now = $("coulomb").clientWidth;
    if (wide && Math.abs(now - wide) > 8) choose();
    wide = now;
  }).observe($("coulomb"));
  read();
  choose();
})();
