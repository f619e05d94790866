// Pictures of a run: the motion from the side, the cone with the impulse in it, and graphs over time, as SVG.
"use strict";
const moreauDraw = (() => {
  const SVG = "http://www.w3.org/2000/svg";
  const make = (parent, kind, attributes = {}, text) => {
    const one = document.createElementNS(SVG, kind);
    Object.entries(attributes).forEach(([name, value]) => one.setAttribute(name, value));
    if (text !== undefined) one.textContent = text;
    return parent.appendChild(one);
  };
  const clear = (svg, width, height) => {
    svg.replaceChildren();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  };
  const degrees = (angle) => angle * 180 / Math.PI;

  // The box in the plane that holds every body of these runs at every sample, with the ground beneath.
  const room = (runs) => {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    runs.forEach((run) => run.bodies.forEach((body) => {
      const size = Math.hypot(...body.size);
      body.x.forEach((x, k) => {
        box[0] = Math.min(box[0], x - size);
        box[1] = Math.min(box[1], body.z[k] - size);
        box[2] = Math.max(box[2], x + size);
        box[3] = Math.max(box[3], body.z[k] + size);
      });
    }));
    const border = 0.04 * Math.max(box[2] - box[0], box[3] - box[1]);
    return [box[0] - border, box[1] - border, box[2] + border, box[3] + border];
  };
  const nice = (length) => {
    const ten = 10 ** Math.floor(Math.log10(length));
    return [5, 2, 1].map((part) => part * ten).find((part) => part <= length);
  };

  // The motion: bodies once, then `at(sample)` moves them.
  const motion = (svg, run, [left, low, right, high], width, height) => {
    clear(svg, width, height);
    const scale = Math.min(width / (right - left), height / (high - low));
    const [x0, z0] = [(width - scale * (right - left)) / 2 - scale * left, (height + scale * (high - low)) / 2 + scale * low];
    const onto = (x, z) => [x0 + scale * x, z0 - scale * z];
    if (run.ground) {
      const [nx, nz, c] = run.ground, far = 2 * (width + height) / scale, [px, pz] = [nx * c, nz * c];
      const [a, b] = [onto(px - far * nz, pz + far * nx), onto(px + far * nz, pz - far * nx)];
      const deep = [onto(px + far * (nz - nx), pz - far * (nx + nz)), onto(px - far * (nz + nx), pz + far * (nx - nz))];
      make(svg, "polygon", { points: [a, b, ...deep].join(" "), class: "earth" });
      make(svg, "line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], class: "ground" });
    }
    const unit = nice(0.3 * (right - left));
    make(svg, "line", { x1: 8, y1: height - 8, x2: 8 + scale * unit, y2: height - 8, class: "scale" });
    make(svg, "text", { x: 12 + scale * unit, y: height - 5 }, `${unit} m`);
    const drawn = run.bodies.map((body) => {
      const group = make(svg, "g", { class: "body" });
      if (body.size.length === 1) {
        make(group, "circle", { r: scale * body.size[0] });
        make(group, "line", { x1: 0, y1: 0, x2: scale * body.size[0], y2: 0 });
      } else {
        const [a, c] = body.size.map((half) => scale * half);
        make(group, "rect", { x: -a, y: -c, width: 2 * a, height: 2 * c });
      }
      return group;
    });
    return (k) => drawn.forEach((group, one) => {
      const body = run.bodies[one], [x, y] = onto(body.x[k], body.z[k]);
      group.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${degrees(body.angle[k]).toFixed(2)})`);
    });
  };

  // Whether a contact has an impulse: the law velocity of one that is far and open would dwarf those that touch.
  const pushes = (contact, k) => contact.active[k] && contact.rn[k] !== 0;
  // The largest impulse and the largest law velocity of the contacts of a run that push.
  const largest = (run, part) => Math.max(0, ...run.contacts.map((contact) => contact[`${part}n`].reduce((most, n, k) =>
    pushes(contact, k) ? Math.max(most, Math.hypot(n, contact[`${part}t`][k], contact[`${part}s`][k])) : most, 0)));
  // The size of the tangential part with the sign that it has in the plane of the picture.
  const aside = (contact, part, k) => Math.hypot(contact[`${part}t`][k], contact[`${part}s`][k]) * (contact[`${part}t`][k] < 0 ? -1 : 1);

  // The cone K = {|r_t| <= mu r_n} and its dual {y_n >= mu |y_t|}; arrows as long as the square root of what they show.
  const cone = (svg, run, mu, width, height) => {
    clear(svg, width, height);
    const [x, y, reach] = [width / 2, height - 22, height - 40];
    const far = 3 * width;
    const wedge = (along, up, kind) => {
      const size = Math.hypot(along, up), [a, b] = [far * along / size, far * up / size];
      const corner = up === 0 ? [[x + far, y - far], [x - far, y - far]] : [];
      return [{ points: [[x, y], [x + a, y - b], ...corner, [x - a, y - b]].join(" "), class: kind },
        { points: [[x + a, y - b], [x, y], [x - a, y - b]].join(" "), class: `${kind} edge` }];
    };
    // the narrower one lies on top
    const both = [wedge(1, mu, "dual"), wedge(mu, 1, "cone")];
    if (mu > 1) both.reverse();
    both.forEach(([filled]) => make(svg, "polygon", filled));
    both.forEach(([, edge]) => make(svg, "polyline", edge));
    make(svg, "line", { x1: 6, y1: y, x2: width - 6, y2: y, class: "axis" });
    make(svg, "line", { x1: x, y1: y, x2: x, y2: 8, class: "axis" });
    make(svg, "text", { x: x - 12, y: 16 }, "n");
    make(svg, "text", { x: width - 12, y: y - 5 }, "t");
    const K = [Math.min(width / 2 - 10, reach * mu * 0.85), reach * 0.85];
    // K beside its right edge, K* over its left one
    make(svg, "text", { x: x + K[0] - (mu > 0 ? 18 : -4), y: y - K[1], class: "told" }, "K");
    const over = mu > 1 ? [x - 0.6 * reach / mu, 0.85 * reach] : [10, Math.min(reach, (width / 2 - 14) * mu + 24)];
    make(svg, "text", { x: over[0], y: y - over[1], class: "told" }, "K*");
    const arrows = make(svg, "g"), most = [largest(run, "r"), largest(run, "y")];
    const arrow = (t, n, top, kind) => {
      const size = Math.hypot(t, n);
      if (!(size > 0) || !(top > 0)) return;
      const long = reach * 0.85 * Math.sqrt(size / top), [u, v] = [x + long * t / size, y - long * n / size];
      make(arrows, "line", { x1: x, y1: y, x2: u.toFixed(2), y2: v.toFixed(2), class: kind });
      const turn = Math.atan2(v - y, u - x), head = Math.min(9, long);
      const barb = (angle) => `${(u + head * Math.cos(turn + angle)).toFixed(2)},${(v + head * Math.sin(turn + angle)).toFixed(2)}`;
      make(arrows, "polygon", { points: `${u.toFixed(2)},${v.toFixed(2)} ${barb(2.7)} ${barb(-2.7)}`, class: `${kind} head` });
    };
    return (k) => {
      arrows.replaceChildren();
      run.contacts.filter((contact) => pushes(contact, k)).forEach((contact) => {
        arrow(aside(contact, "y", k), contact.yn[k], most[1], "velocity");
        arrow(aside(contact, "r", k), contact.rn[k], most[0], "impulse");
      });
    };
  };

  // A graph over time: `range` is common to all panels; `log` counts decades, zeros stand on the lowest line.
  const graph = (svg, run, { values, range: [low, high], log, label, marks }, width, height) => {
    clear(svg, width, height);
    const [left, right, top, bottom] = [52, width - 8, 18, height - 18];
    const last = run.steps, at = (k) => left + (right - left) * k / last;
    const level = (value) => {
      const place = log ? (value > 0 ? (Math.log10(value) - low) / (high - low) : 0) : (value - low) / ((high - low) || 1);
      return bottom - (bottom - top) * Math.min(1, Math.max(0, place));
    };
    make(svg, "rect", { x: left, y: top, width: right - left, height: bottom - top, class: "frame" });
    const written = (value) => log ? `1e${value}` : value !== 0 && Math.abs(value) < 0.1
      ? value.toExponential(1) : Number(value.toPrecision(3)).toString();
    const place = log ? (value) => level(10 ** value) : level;
    [low, high].forEach((value) => make(svg, "text", { x: left - 4, y: place(value) + 4, class: "end" }, written(value)));
    if (!log && low < 0 && high > 0) make(svg, "line", { x1: left, y1: level(0), x2: right, y2: level(0), class: "zero" });
    make(svg, "text", { x: left, y: 12 }, label);
    make(svg, "text", { x: left, y: height - 4 }, "0");
    make(svg, "text", { x: right, y: height - 4, class: "end" }, `${Number((last * run.h).toPrecision(4))} s`);
    let path = "", drawing = false;
    values.forEach((value, k) => {
      if (value === null || value === undefined) { drawing = false; return; }
      const y = value === Infinity ? top : level(value);
      path += `${drawing ? "L" : "M"}${at(k).toFixed(1)} ${y.toFixed(1)}`;
      if (!drawing) path += `h0.6`;
      drawing = true;
    });
    make(svg, "path", { d: path, class: "curve" });
    (marks || []).forEach((verdict, k) => {
      if (verdict < 2) return;
      const x = at(k).toFixed(1);
      const [shape, kind] = verdict === 3 ? ["l-4 -7h8z", "bad"] : ["l-4 -4l4 -4l4 4z", "open"];
      make(svg, "path", { d: `M${x} ${top}${shape}`, class: kind });
    });
    const cursor = make(svg, "line", { x1: left, x2: left, y1: top, y2: bottom, class: "cursor" });
    return (k) => { const x = at(k).toFixed(1); cursor.setAttribute("x1", x); cursor.setAttribute("x2", x); };
  };
  return { motion, cone, graph, room };
})();
