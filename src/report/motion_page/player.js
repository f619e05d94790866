"use strict";
// Draws the motion of the page's data on a canvas: bodies as convex meshes, drawn from the farthest to the nearest.
(() => {
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($("data").textContent);
  const canvas = $("view"), strip = $("strip"), slider = $("time");
  const brush = canvas.getContext("2d");
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const last = data.times.length - 1;
  const FREE = [[86, 180, 233], [230, 159, 0], [0, 158, 115], [204, 121, 167], [0, 114, 178], [213, 94, 0], [222, 205, 60]];
  const STATIC = [150, 150, 150], PRESCRIBED = [168, 142, 110];
  const MANY = 80, ROWS = 8, STILL = 500, FIELD = 1.1;

  const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const size = (a) => Math.hypot(a[0], a[1], a[2]);
  const unit = (a) => { const l = size(a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
  const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

  // A number as the command writes it.
  const shown = (x) => {
    if (x === null) return "not a number";
    const a = Math.abs(x);
    return a === 0 || (a >= 0.001 && a < 1e6) ? String(x === 0 ? 0 : x) : x.toExponential().replace("e+", "e");
  };

  // Shapes about their centre: corners, faces of four corners each (some twice), and which faces are dark, so that turning is seen.
  const revolve = (profile, parts) => {
    const corners = [], faces = [];
    profile.forEach(([r, z]) => {
      for (let k = 0; k < parts; k++) corners.push([r * Math.cos(2 * Math.PI * k / parts), r * Math.sin(2 * Math.PI * k / parts), z]);
    });
    for (let row = 0; row + 1 < profile.length; row++) {
      for (let k = 0; k < parts; k++) {
        const a = row * parts + k, b = row * parts + (k + 1) % parts;
        const dark = (Math.floor(4 * k / parts) + (profile[row][1] + profile[row + 1][1] > 0 ? 1 : 0)) % 2;
        faces.push([a, b, b + parts, a + parts, dark]);
      }
    }
    return { corners, faces };
  };
  const arc = (r, from, to, lift, n) => Array.from({ length: n + 1 }, (_, k) => from + (to - from) * k / n)
    .map((angle) => [r * Math.sin(angle), r * Math.cos(angle) + lift]);
  const fine = data.bodies.length > MANY ? 8 : data.bodies.length > 20 ? 12 : 20;
  const mesh = ({ shape, size: [a, b, c] }) => {
    const half = Math.PI / 2;
    if (shape === "sphere") return revolve(arc(a, 0, Math.PI, 0, fine / 2), fine);
    if (shape === "capsule") return revolve([...arc(a, 0, half, b, fine / 4), ...arc(a, half, Math.PI, -b, fine / 4)], fine);
    if (shape === "cylinder") return revolve([[0, b], [a, b], [a, 0], [a, -b], [0, -b]], fine);
    const corners = [];
    for (let k = 0; k < 8; k++) corners.push([k & 1 ? a : -a, k & 2 ? b : -b, k & 4 ? c : -c]);
    const faces = [[0, 1, 3, 2, 0], [4, 5, 7, 6, 0], [0, 1, 5, 4, 0], [2, 3, 7, 6, 0], [0, 2, 6, 4, 0], [1, 3, 7, 5, 0]];
    return { corners, faces };
  };
  const radius = ({ shape, size: s }) => shape === "sphere" ? s[0] : shape === "box" ? size(s)
    : shape === "capsule" ? s[0] + s[1] : Math.hypot(s[0], s[1]);
  let frees = 0;
  const bodies = data.bodies.map((body) => {
    const colour = body.kind === "static" ? STATIC : body.kind === "prescribed" ? PRESCRIBED : FREE[frees++ % FREE.length];
    return { ...body, ...mesh(body), radius: radius(body), colour };
  });
  document.querySelectorAll(".swatch").forEach((swatch, k) => { swatch.style.background = `rgb(${bodies[k].colour})`; });

  // Where a body is at a sample: its centre, and its axes in the world as columns.
  const pose = (sample, k) => {
    const [x, y, z, w, i, j, l] = data.places[sample].slice(7 * k, 7 * k + 7);
    return {
      centre: [x, y, z],
      axes: [
        [1 - 2 * (j * j + l * l), 2 * (i * j + w * l), 2 * (i * l - w * j)],
        [2 * (i * j - w * l), 1 - 2 * (i * i + l * l), 2 * (j * l + w * i)],
        [2 * (i * l + w * j), 2 * (j * l - w * i), 1 - 2 * (i * i + j * j)],
      ],
    };
  };
  const place = ({ centre, axes }, [x, y, z]) => add(add(add(centre, axes[0], x), axes[1], y), axes[2], z);
  // How far a body reaches from its centre in a direction.
  const reach = (body, { axes }, n) => {
    const s = body.size, along = Math.abs(dot(n, axes[2]));
    if (body.shape === "sphere") return s[0];
    if (body.shape === "box") return s[0] * Math.abs(dot(n, axes[0])) + s[1] * Math.abs(dot(n, axes[1])) + s[2] * along;
    return s[1] * along + s[0] * (body.shape === "capsule" ? 1 : Math.sqrt(Math.max(0, 1 - along * along)));
  };

  // The room that the motion takes: of what moves, or of all.
  const moving = bodies.map((body, k) => k).filter((k) => bodies[k].kind === "free");
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  (moving.length ? moving : bodies.map((_, k) => k)).forEach((k) => data.places.forEach((all) => {
    for (let axis = 0; axis < 3; axis++) {
      low[axis] = Math.min(low[axis], all[7 * k + axis] - bodies[k].radius);
      high[axis] = Math.max(high[axis], all[7 * k + axis] + bodies[k].radius);
    }
  }));
  const middle = add(low, add(high, low, -1), 0.5), room = size(add(high, low, -1)) / 2 || 1;
  const hardest = Math.max(0, ...data.contacts.map((all) => Math.max(0, ...all.map((one) => size(one[3])))));

  // The eye.
  const eye = { yaw: 0, pitch: 0, distance: 1, target: middle };
  const state = { sample: 0, playing: false, clock: 0, begun: 0, followed: -1 };
  let view = {}, colours = {};
  const look = () => {
    const [sy, cy, sp, cp] = [Math.sin(eye.yaw), Math.cos(eye.yaw), Math.sin(eye.pitch), Math.cos(eye.pitch)];
    const forward = [sy * cp, cy * cp, -sp], right = [cy, -sy, 0], up = [sy * sp, cy * sp, cp];
    const { followed } = state;
    const target = followed < 0 ? eye.target : add(add(eye.target, middle, -1), pose(state.sample, followed).centre);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    view = { forward, right, up, target, at: add(target, forward, -eye.distance), width, height, scale: FIELD * Math.min(width, height) };
  };
  const seen = (p) => { const d = add(p, view.at, -1); return [dot(d, view.right), dot(d, view.up), dot(d, view.forward)]; };
  const near = () => eye.distance / 50;
  const onto = ([x, y, z]) => [view.width / 2 + view.scale * x / z, view.height / 2 - view.scale * y / z];
  const home = () => {
    Object.assign(eye, { yaw: 0.35, pitch: 0.25, distance: room, target: middle });
    look();
    let distance = 0;
    for (let k = 0; k < 8; k++) {
      const corner = [k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]];
      const [x, y, z] = seen(corner), depth = z - eye.distance;
      distance = Math.max(distance, view.scale * Math.max(Math.abs(x) / view.width, Math.abs(y) / view.height) / 0.46 - depth);
    }
    eye.distance = Math.max(distance, 1.05 * room);
  };

  // Draws a polygon or a line, cut off at the plane before the eye.
  const trace = (points, closed) => {
    const floor = near(), cut = [];
    points.forEach((p, k) => {
      const q = points[(k + 1) % points.length];
      if (p[2] >= floor) cut.push(p);
      if ((closed || k + 1 < points.length) && (p[2] >= floor) !== (q[2] >= floor)) {
        const part = (floor - p[2]) / (q[2] - p[2]);
        cut.push([p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1]), floor]);
      }
    });
    if (cut.length < 2) return false;
    brush.beginPath();
    cut.map(onto).forEach(([x, y], k) => k ? brush.lineTo(x, y) : brush.moveTo(x, y));
    if (closed) brush.closePath();
    return true;
  };

  // A length of 1, 2 or 5 times a power of ten, for the grid of the ground.
  const power = 10 ** Math.floor(Math.log10(room / 3));
  const cell = [5, 2, 1].map((k) => k * power).find((length) => length <= room / 3) || power;
  const drawGround = () => {
    const [normal, offset] = data.ground, n = normal;
    const t = unit(Math.abs(n[0]) < 0.9 ? add([1, 0, 0], n, -n[0]) : add([0, 1, 0], n, -n[1])), s = cross(n, t);
    const foot = add(middle, n, offset - dot(n, middle)), half = cell * Math.ceil(2 * room / cell);
    const snap = (axis) => cell * Math.round(dot(foot, axis) / cell) - dot(foot, axis);
    const centre = add(add(foot, t, snap(t)), s, snap(s));
    const at = (a, b) => seen(add(add(centre, t, a), s, b));
    if (trace([at(-half, -half), at(half, -half), at(half, half), at(-half, half)], true)) {
      brush.fillStyle = colours.earth;
      brush.globalAlpha = dot(n, view.at) >= offset ? 1 : 0.45;
      brush.fill();
    }
    brush.strokeStyle = colours.grid;
    brush.lineWidth = 1;
    for (let a = -half; a <= half * 1.0001; a += cell) {
      if (trace([at(a, -half), at(a, half)], false)) brush.stroke();
      if (trace([at(-half, a), at(half, a)], false)) brush.stroke();
    }
    brush.globalAlpha = 1;
  };

  // Whether body a is behind b: on the far side of the plane that parts them best. Undefined where neither hides the other.
  const behind = (a, b) => {
    const [p, q] = [a.pose, b.pose], between = add(q.centre, p.centre, -1);
    const [from, to] = [add(p.centre, view.at, -1), add(q.centre, view.at, -1)];
    const spread = ({ body }, d) => size(d) > body.radius ? Math.asin(body.radius / size(d)) : Math.PI;
    if (Math.acos(clamp(dot(unit(from), unit(to)), -1, 1)) > spread(a, from) + spread(b, to)) return undefined;
    const own = (one) => one.body.shape === "box" ? one.pose.axes : one.body.shape === "sphere" ? [] : [one.pose.axes[2]];
    const [m, n] = [own(a), own(b)];
    const beside = [...m, ...n].map((axis) => add(between, axis, -dot(between, axis)));
    const tried = [between, ...m, ...n, ...beside, ...m.flatMap((x) => n.map((y) => cross(x, y)))];
    let best = -Infinity, hidden = false;
    tried.filter((axis) => size(axis) > 1e-9 * room).map(unit).forEach((axis) => {
      const way = dot(axis, between) < 0 ? add([0, 0, 0], axis, -1) : axis;
      const [upper, lower] = [dot(way, p.centre) + reach(a.body, p, way), dot(way, q.centre) - reach(b.body, q, way)];
      if (lower - upper > best) [best, hidden] = [lower - upper, dot(way, view.at) > (upper + lower) / 2];
    });
    return hidden;
  };
  const ordered = (all) => {
    const far = (one) => { const d = add(one.pose.centre, view.at, -1); return dot(d, d) - one.body.radius ** 2; };
    all.forEach((one) => { one.far = far(one); });
    all.sort((a, b) => b.far - a.far);
    if (all.length > MANY) return all;
    const done = new Set(), order = [];
    const visit = (one) => {
      if (done.has(one)) return;
      done.add(one);
      all.forEach((other) => { if (!done.has(other) && behind(other, one)) visit(other); });
      order.push(one);
    };
    all.forEach(visit);
    return order;
  };
  const drawBody = ({ body, pose: at }) => {
    const corners = body.corners.map((corner) => place(at, corner)), eyes = corners.map(seen);
    const light = unit(add(add(add([0, 0, 0.4], view.forward, -0.8), view.up, 0.5), view.right, -0.35));
    Object.assign(brush, { lineWidth: 1, lineJoin: "round" });
    body.faces.forEach(([a, b, c, d, dark]) => {
      let normal = unit(cross(add(corners[c], corners[a], -1), add(corners[d], corners[b], -1)));
      const face = add(add(corners[a], corners[c]), add(corners[b], corners[d]));
      if (dot(normal, face) < 4 * dot(normal, at.centre)) normal = add([0, 0, 0], normal, -1);
      if (dot(normal, add(view.at, face, -0.25)) <= 0 || !trace([eyes[a], eyes[b], eyes[c], eyes[d]], true)) return;
      const bright = (0.55 + 0.45 * Math.max(0, dot(normal, light))) * (dark ? 0.72 : 1);
      brush.fillStyle = `rgb(${body.colour.map((part) => Math.round(part * bright))})`;
      brush.strokeStyle = body.shape === "box" ? colours.edge : brush.fillStyle;
      brush.fill();
      brush.stroke();
    });
  };
  // Arrows from the contacts, as long as the square root of their impulses.
  const drawPushes = () => {
    const all = data.contacts[state.sample], small = all.length > 40;
    Object.assign(brush, { strokeStyle: colours.push, fillStyle: colours.push, lineWidth: small ? 1.2 : 2.5, lineCap: "round" });
    all.forEach(([, , point, impulse]) => {
      const from = seen(point), force = size(impulse);
      if (from[2] < near()) return;
      const [x, y] = onto(from);
      brush.beginPath();
      brush.arc(x, y, small ? 2 : 4, 0, 2 * Math.PI);
      brush.fill();
      const tip = seen(add(point, impulse, 0.5 * room * Math.sqrt(force / hardest) / (force || 1)));
      if (!(force > 0) || !trace([from, tip], false)) return;
      brush.stroke();
      if (tip[2] < near()) return;
      const [u, v] = onto(tip), turn = Math.atan2(v - y, u - x), head = Math.min(small ? 5 : 10, Math.hypot(u - x, v - y));
      const barb = (angle) => [u + head * Math.cos(angle), v + head * Math.sin(angle)];
      brush.beginPath();
      [barb(turn + 2.65), [u, v], barb(turn - 2.65)].forEach(([a, b], k) => k ? brush.lineTo(a, b) : brush.moveTo(a, b));
      brush.stroke();
    });
  };

  const fit = (one) => {
    const ratio = window.devicePixelRatio || 1, pen = one.getContext("2d");
    const [width, height] = [one.clientWidth, one.clientHeight].map((length) => Math.round(length * ratio));
    if (one.width !== width || one.height !== height) Object.assign(one, { width, height });
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, one.clientWidth, one.clientHeight);
    return pen;
  };
  const draw = () => {
    fit(canvas);
    look();
    const above = data.ground && dot(data.ground[0], view.at) >= data.ground[1];
    if (data.ground && above) drawGround();
    ordered(bodies.map((body, k) => ({ body, pose: pose(state.sample, k) }))).forEach(drawBody);
    if (data.ground && !above) drawGround();
    drawPushes();
  };
  // Under the slider: what acted, and above it red where a step is rejected, amber where it is unconverged by declaration.
  const drawStrip = () => {
    const pen = fit(strip), [width, height] = [strip.clientWidth, strip.clientHeight], wide = Math.max(1, width / (last + 1));
    data.contacts.forEach((all, k) => {
      const force = Math.max(0, ...all.map((one) => size(one[3]))), x = (width - wide) * k / last, of = data.certificates[k];
      const bar = (height - 8) * Math.sqrt(force / (hardest || 1));
      pen.fillStyle = colours.quiet;
      pen.fillRect(x, height - bar, wide, bar);
      pen.fillStyle = of && of[0] ? colours.push : colours.amber;
      if (of && (of[0] || of[1])) pen.fillRect(x, 0, Math.max(2, wide), 6);
    });
  };

  const certificate = (k) => {
    const [first, end, of] = [(k ? data.ends[k - 1] : 0) + 1, data.ends[k], data.certificates[k]];
    if (!k) return ["", "the start: nothing was solved"];
    const steps = first === end ? `step ${end}` : `steps ${first} to ${end}`;
    if (!of) return ["", `${steps}: nothing to solve`];
    const [rejected, unconverged, relative, limit, word, at] = of;
    const verdict = rejected ? "rejected" : unconverged ? "unconverged by declaration" : "accepted";
    const count = rejected || unconverged, many = first === end || !count ? "" : `${count} of ${end - first + 1} `;
    const where = first === end ? "" : `, in step ${at}`;
    const worst = `largest residual ${shown(relative)} (${data.residuals[word]}, limit ${shown(limit)}${where})`;
    return [rejected ? "fail" : unconverged ? "difference" : "pass", `${steps}: ${many}${verdict}; ${worst}`];
  };
  const name = (k) => k < 0 ? "ground" : data.bodies[k].name;
  const read = () => {
    const k = state.sample, all = [...data.contacts[k]].sort((a, b) => size(b[3]) - size(a[3]));
    const time = `${shown(data.times[k])} s`, [verdict, words] = certificate(k);
    $("t").textContent = `${time} of ${shown(data.times[last])} s, step ${data.ends[k]} of ${data.steps}`;
    $("energy").textContent = `${shown(data.energies[k])} J`;
    $("certificate").textContent = words;
    $("certificate").className = verdict;
    $("none").textContent = all.length ? `${all.length} ${all.length === 1 ? "contact" : "contacts"} acted since the sample before`
      + (all.length > ROWS ? `; the ${ROWS} largest impulses:` : ":") : "Nothing acted since the sample before.";
    $("rows").replaceChildren(...all.slice(0, ROWS).map((one) => {
      const row = document.createElement("tr");
      [`${name(one[0])}/${name(one[1])}`, shown(one[4]), shown(one[5])].forEach((text, column) => {
        const part = row.appendChild(document.createElement("td"));
        part.textContent = text;
        if (column) part.className = "n";
      });
      return row;
    }));
    slider.value = k;
    slider.setAttribute("aria-valuetext", `${time}, ${words}`);
  };
  let asked = 0;
  const refresh = () => { asked = asked || requestAnimationFrame(() => { asked = 0; draw(); }); };
  const show = (sample) => {
    state.sample = clamp(sample, 0, last);
    state.clock = data.times[state.sample];
    read();
    refresh();
  };

  const tick = (now) => {
    if (!state.playing) return;
    // a page that was hidden does not jump
    const passed = Math.min(1, (now - state.begun) / 1000);
    if (!calm.matches || passed * 1000 >= STILL) {
      const clock = state.clock + passed * Number($("speed").value);
      state.begun = now;
      let sample = state.sample;
      while (sample < last && data.times[sample + 1] <= clock) sample++;
      if (sample !== state.sample) show(sample);
      state.clock = clock;
      if (sample === last) halt();
    }
    requestAnimationFrame(tick);
  };
  const halt = () => { state.playing = false; $("play").textContent = "Play"; };
  const toggle = () => {
    if (state.playing) { halt(); return; }
    if (state.sample === last) show(0);
    Object.assign(state, { playing: true, begun: performance.now(), clock: data.times[state.sample] });
    $("play").textContent = "Pause";
    requestAnimationFrame(tick);
  };
  const move = (steps) => { halt(); show(state.sample + steps); };

  // Hands: buttons, pointers, the wheel and keys.
  const turn = (yaw, pitch) => { eye.yaw += yaw; eye.pitch = clamp(eye.pitch + pitch, -1.55, 1.55); refresh(); };
  const zoom = (factor) => { eye.distance = clamp(eye.distance * factor, room / 100, room * 100); refresh(); };
  const pan = (x, y) => {
    eye.target = add(add(eye.target, view.right, -x * eye.distance / view.scale), view.up, y * eye.distance / view.scale);
    refresh();
  };
  const all = () => { home(); refresh(); };
  const fingers = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const after = [event.clientX, event.clientY], [x, y] = [after[0] - before[0], after[1] - before[1]];
    fingers.set(event.pointerId, after);
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, point]) => point);
      const apart = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
      zoom(apart(before) / apart(after));
      pan(x / 2, y / 2);
    } else if (event.shiftKey || event.buttons > 1) pan(x, y);
    else turn(-x / 150, y / 150);
  });
  ["pointerup", "pointercancel"].forEach((kind) => canvas.addEventListener(kind, (event) => fingers.delete(event.pointerId)));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(clamp(event.deltaY, -200, 200) / 400)); },
    { passive: false });
  const keys = {
    ArrowLeft: () => turn(0.1, 0), ArrowRight: () => turn(-0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
    "+": () => zoom(0.8), "=": () => zoom(0.8), "-": () => zoom(1.25), 0: all, " ": toggle, ",": () => move(-1), ".": () => move(1),
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  [["nearer", () => zoom(0.8)], ["farther", () => zoom(1.25)], ["home", all], ["play", toggle], ["back", () => move(-1)],
    ["on", () => move(1)]].forEach(([id, action]) => $(id).addEventListener("click", action));
  slider.addEventListener("input", () => { halt(); show(Number(slider.value)); });
  if ($("follow")) $("follow").addEventListener("change", () => { state.followed = Number($("follow").value); refresh(); });

  const repaint = () => {
    const style = getComputedStyle(document.documentElement);
    ["earth", "grid", "push", "edge", "amber", "quiet"].forEach((word) => { colours[word] = style.getPropertyValue(`--${word}`).trim(); });
    drawStrip();
    refresh();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  new ResizeObserver(repaint).observe(canvas);
  const speeds = [...$("speed").options].map((option) => option.value);
  const wanted = data.times[last] / clamp(data.times[last], 1, 10);
  $("speed").value = speeds.reduce((a, b) => Math.abs(Math.log(a / wanted)) <= Math.abs(Math.log(b / wanted)) ? a : b);
  $("grid").textContent = data.ground ? `one square: ${shown(Number(cell.toPrecision(1)))} m` : "";
  home();
  repaint();
  show(0);
})();
