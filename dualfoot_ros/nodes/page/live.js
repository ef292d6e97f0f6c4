"use strict";
// The live page: what the server sends, drawn and said.
(() => {
  const { tables, number } = plots;
  const COLOURS = { person: "#1b1b1b", left: "#d55e00", right: "#0072b2", error: "#e69f00" };
  const FEET = ["left", "right"];
  const PATIENCE_MS = 3000; // without a message: the program has ended, or the way to it is broken
  const trails = {}; // name -> places [t, x, y, z]
  const byId = (id) => document.getElementById(id);
  let now = {}, heard = 0, source = null, times = 0;

  // ---- plots ----------------------------------------------------------------------------------
  const dots = (foot) => ({ table: foot, x: "x", y: "y", style: "dots", name: foot + " foot",
    color: COLOURS[foot], width: 2.5 });
  const specs = {
    map: {
      id: "map", kind: "map", title: "From above", x: "x (m)", y: "y (m)", least: 4,
      tall: 0.55, marks: [],
      series: [
        { table: "now", x: "x", y: "y", style: "ellipses", name: "95 % of the position",
          color: COLOURS.error },
        { table: "person", x: "x", y: "y", name: "person", color: COLOURS.person, width: 2 },
        dots("left"), dots("right"),
      ],
    },
    height: {
      id: "height", title: "Height of the floor", x: "time (s)", y: "height (m)", least: 1,
      marks: [],
      series: [{ table: "height", x: "t", y: "z", name: "", color: COLOURS.person, width: 2 }],
    },
  };

  function fill() {
    const start = trails.height && trails.height.length ? trails.height[0][0] : 0;
    const floor = trails.height && trails.height.length ? trails.height[0][3] : 0;
    for (const name of ["person", "height", ...FEET]) {
      const places = trails[name] || [];
      const column = (k, less) => Float64Array.from(places, (place) => place[k] - less);
      tables[name] = { t: column(0, start), x: column(1, 0), y: column(2, 0), z: column(3, floor) };
    }
    const p = now.person;
    const axis = (value) => (p && value !== null ? [2.4477 * value] : []); // 95 % of two numbers
    tables.now = { x: p ? [p.x] : [], y: p ? [p.y] : [], major: axis(p && p.major),
      minor: axis(p && p.minor), angle: p ? [p.angle] : [] };
    if (p) { // the newest place ends the line
      for (const key of ["x", "y"]) {
        tables.person[key] = Float64Array.of(...tables.person[key], p[key]);
      }
    }
    specs.map.marks = FEET.filter((foot) => now[foot]).map((foot) => ({ x: now[foot].x,
      y: now[foot].y, angle: now[foot].heading, symbol: "foot", color: COLOURS[foot],
      opacity: ((now.feet || {})[foot] || {}).state === "tracking" ? 1 : 0.35 }));
    if (p) specs.map.marks.push({ x: p.x, y: p.y, angle: p.heading, symbol: "arrow", label: "" });
  }

  fill();
  const charts = ["map", "height"].map((name) => plots.add(
    document.querySelector(`figure.plot[data-plot="${name}"]`), specs[name]));
  for (const chart of charts) chart.reset();

  // ---- words ----------------------------------------------------------------------------------
  function pill(element, text, tone) {
    element.textContent = text;
    element.className = "pill " + tone;
  }

  function clock(seconds) {
    const whole = Math.max(0, Math.round(seconds));
    const hours = Math.floor(whole / 3600), minutes = Math.floor(whole / 60) % 60;
    const two = (n) => String(n).padStart(2, "0");
    return (hours ? hours + ":" + two(minutes) : minutes) + ":" + two(whole % 60);
  }

  function measure(value, digits, unit) {
    const known = value !== null && value !== undefined;
    return known ? number(value, digits) + "\u00a0" + unit : "–";
  }

  function trustLeft(trust) {
    if (!trust.heading_known) return "–";
    if (!trust.trusted) return "beyond " + measure(trust.limit, 0, "m");
    if (trust.way_left === null) return "unlimited";
    const way = measure(trust.way_left, 0, "m");
    return trust.time_left === null ? way : way + ", " + clock(trust.time_left);
  }

  function direction(p) {
    if (p.heading_std > 45) return "not known";
    return `${Math.round(p.heading)}° ± ${number(p.heading_std, 1)}°`;
  }

  function showTiles() {
    const p = now.person, trust = now.trust, last = tables.height.t.length - 1;
    const set = (id, text) => { byId(id).textContent = text; };
    set("walked", p ? measure(now.walked, now.walked < 100 ? 1 : 0, "m") : "–");
    set("time", last >= 0 ? clock(tables.height.t[last]) : "–");
    set("height", last >= 0 ? measure(tables.height.z[last], 2, "m") : "–");
    set("speed", p ? measure(p.speed, 1, "m/s") : "–");
    set("std", p ? measure(p.major, 2, "m") + ", " + measure(p.height_std, 2, "m") : "–");
    set("heading", p ? direction(p) : "–");
    set("radius", trust ? measure(trust.radius, trust.radius < 1 ? 2 : 1, "m") : "–");
    set("trusted", trust ? trustLeft(trust) : "–");
    for (const id of ["radius", "trusted"]) {
      byId(id).parentElement.classList.toggle("bad", Boolean(trust) && !trust.trusted);
    }
  }

  function showFeet() {
    const tones = { tracking: "good", STALE: "bad", aligning: "wait" };
    for (const foot of FEET) {
      const f = (now.feet || {})[foot] || { state: "no report" };
      const cells = byId(foot).children;
      pill(cells[1].firstElementChild, f.state, tones[f.state] || "wait");
      cells[2].textContent = measure(f.rate, 0, "Hz");
      const known = typeof f.lost === "number";
      const share = known && f.received + f.lost ? 100 * f.lost / (f.received + f.lost) : 0;
      const percent = number(share, share && share < 10 ? 1 : 0) + "\u00a0%";
      cells[3].textContent = known ? `${f.lost} (${percent})` : "–";
      cells[4].textContent = measure(f.battery, 0, "%");
    }
    const s = now.step;
    const pace = s && s.duration ? `, ${number(60 / s.duration, 0)} steps a minute` : "";
    byId("step").textContent = s ? `Last step: ${s.foot}, ${number(s.length, 2)} m long, `
      + `${number(s.width, 2)} m wide${pace}` : "";
  }

  function sentences() {
    const found = [];
    if (!alive()) {
      found.push(["warning", "The program behind this page does not answer: has it been ended? "
        + "The page goes on trying, and what it shows is old."]);
      return found;
    }
    for (const w of now.warnings || []) found.push(["warning", `${w.node}: ${w.text}`]);
    if (now.phase === "aligning") {
      found.push(["warning", "The feet are being aligned: stand still."]);
    } else if (now.silent) found.push(["warning", "Nothing arrives: " + now.silent + "."]);
    if (now.trust && now.person && !now.silent) {
      const text = now.trust.text;
      const sentence = text[0].toUpperCase() + text.slice(1) + ".";
      found.push([now.trust.trusted ? "good" : "warning", sentence]);
    }
    return found;
  }

  function showWords() {
    const list = byId("words");
    const items = sentences().map(([tone, text]) =>
      Object.assign(document.createElement("li"), { className: tone, textContent: text }));
    const same = items.length === list.children.length
      && items.every((item, k) => item.isEqualNode(list.children[k]));
    if (!same) list.replaceChildren(...items);
    const link = byId("link");
    if (!alive()) pill(link, "not connected", "bad");
    else if (now.silent && now.phase !== "aligning") pill(link, "nothing arrives", "bad");
    else if (!now.person) pill(link, now.phase || "nothing arrives", now.phase ? "wait" : "bad");
    else pill(link, now.phase || "live", "good");
    const parts = [];
    if (now.method) parts.push("method " + now.method);
    if (now.filter && now.filter.pairs) parts.push(number(now.filter.pairs, 0) + " pairs a second");
    if (now.filter && now.filter.nis) parts.push("NIS of zero-velocity updates "
      + number(now.filter.nis, 2) + " of what is expected");
    byId("about").textContent = parts.join(" · ");
  }

  const alive = () => heard > 0 && performance.now() - heard < PATIENCE_MS;

  function show() {
    fill();
    showTiles();
    showFeet();
    showWords();
    for (const chart of charts) chart.refresh();
    times += 1;
    document.documentElement.dataset.shown = String(times);
  }

  // ---- the connection ---------------------------------------------------------------------------
  function take(message) {
    heard = performance.now();
    now = message.now;
    for (const [name, { first, places }] of Object.entries(message.trails)) {
      trails[name] = (trails[name] || []).slice(0, first).concat(places);
    }
    if (!document.hidden) show();
  }

  function connect() {
    source = new EventSource("events");
    source.onmessage = (event) => take(JSON.parse(event.data));
  }

  connect();
  setInterval(() => {
    showWords();
    if (source.readyState === EventSource.CLOSED) connect(); // refused, as when places are taken
  }, 1000);
  document.addEventListener("visibilitychange", () => { if (!document.hidden) show(); });
})();
