"use strict";
// Plots of a page: ``tables`` (name -> column -> numbers) and what ``add`` makes of them.
const plots = (() => {
  const NS = "http://www.w3.org/2000/svg";
  const charts = [];
  const tables = {};
  const PAPER = 700; // pixels of a plot on paper, so that its letters have the size of the text
  let printing = false;

  function element(name, attributes, parent) {
    const made = document.createElementNS(NS, name);
    for (const [key, value] of Object.entries(attributes || {})) made.setAttribute(key, value);
    if (parent) parent.appendChild(made);
    return made;
  }

  function html(name, properties, parent) {
    const made = Object.assign(document.createElement(name), properties || {});
    if (parent) parent.appendChild(made);
    return made;
  }

  function niceStep(span, count) {
    const rough = span / Math.max(1, count);
    const power = 10 ** Math.floor(Math.log10(rough));
    const best = [1, 2, 5, 10].find((m) => m * power >= rough);
    return best * power;
  }

  function ticks(low, high, count) {
    const step = niceStep(high - low, count);
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) {
      found.push([k * step, (k * step).toFixed(digits)]);
    }
    return found;
  }

  function range(arrays) {
    let low = Infinity, high = -Infinity;
    for (const array of arrays) for (const v of array) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    return low <= high ? [low, high] : [0, 1];
  }

  function padded([low, high], share) {
    const span = high - low || 1;
    return [low - share * span, high + share * span];
  }

  const number = (v, digits) => (Number.isFinite(v) ? v.toFixed(digits) : "–");

  // ---- one plot -------------------------------------------------------------------------------
  class Chart {
    constructor(figure, spec) {
      this.figure = figure;
      this.spec = spec;
      this.series = spec.series.map((s) => ({ ...s, shown: s.shown !== false }));
      this.equal = spec.kind === "map";
      this.touched = false; // by a person, who wants to go on seeing this part
      this.read();
      this.build();
      this.full = this.extent();
    }

    read() {
      for (const s of this.series) {
        s.xs = tables[s.table][s.x];
        s.ys = s.y ? tables[s.table][s.y] : null;
      }
    }

    // The tables or the marks have changed.
    refresh() {
      this.read();
      this.full = this.extent();
      if (this.touched) this.draw(); else this.reset();
    }

    build() {
      const head = html("div", { className: "head" }, this.figure);
      html("h3", { textContent: this.spec.title }, head);
      const tools = html("div", { className: "tools" }, head);
      const button = (text, title, action) => html("button", {
        type: "button", textContent: text, title, onclick: action,
      }, tools).setAttribute("aria-label", title + ": " + this.spec.title);
      button("+", "zoom in", () => this.zoom(0.5));
      button("−", "zoom out", () => this.zoom(2));
      button("⟲", "show everything", () => this.reset());
      this.legend = html("div", { className: "legend" }, this.figure);
      this.canvas = html("div", { className: "canvas" }, this.figure);
      this.readout = html("div", { className: "readout" }, this.figure);
      html("figcaption", { textContent: this.spec.note || "" }, this.figure);
      this.buildLegend();
      this.listen();
    }

    buildLegend() {
      const groups = new Map();
      for (const s of this.series) {
        if (!s.name) continue;
        if (!groups.has(s.name)) groups.set(s.name, []);
        groups.get(s.name).push(s);
      }
      for (const [name, own] of groups) {
        const item = html("button", { type: "button", title: "show or hide" }, this.legend);
        const kinds = { ellipses: "area", band: "area", dots: "dot", bars: "bar" };
        const mark = html("i", { className: kinds[own[0].style] || "" }, item);
        mark.style[mark.className ? "background" : "borderTopColor"] = own[0].color;
        if (own[0].dash) mark.style.borderTopStyle = "dashed";
        item.append(name);
        item.setAttribute("aria-pressed", String(own[0].shown));
        item.onclick = () => {
          const on = !own[0].shown;
          for (const s of own) s.shown = on;
          item.setAttribute("aria-pressed", String(on));
          this.draw();
        };
      }
    }

    extent() {
      const xs = range(this.series.filter((s) => s.style !== "ellipses").map((s) => s.xs));
      if (this.spec.kind === "strips") {
        xs[1] = Math.max(xs[1], ...this.series.map((s) => range([tables[s.table][s.end]])[1]));
        return { x: xs, y: [0, this.spec.rows.length] };
      }
      const ys = [];
      for (const s of this.series) {
        if (s.style === "ellipses") continue;
        if (s.ys) ys.push(s.ys);
        if (s.style === "band") for (const sign of [-1, 1]) {
          ys.push(s.ys.map((v, i) => v + sign * s.factor * tables[s.table][s.half][i]));
        }
      }
      const y = range(ys);
      if (this.spec.zero) y[0] = Math.min(0, y[0]);
      const low = this.spec.least;
      if (low && this.equal && xs[1] - xs[0] < low) {
        const middle = (xs[0] + xs[1]) / 2;
        xs[0] = middle - low / 2; xs[1] = middle + low / 2;
      }
      if (low && y[1] - y[0] < low) {
        const middle = (y[0] + y[1]) / 2;
        if (this.spec.zero) y[1] = low; else { y[0] = middle - low / 2; y[1] = middle + low / 2; }
      }
      if (this.equal) this.holdEllipses(xs, y);
      const tall = padded(y, 0.06);
      if (this.spec.zero && y[0] === 0) tall[0] = 0;
      return { x: this.equal ? padded(xs, 0.06) : xs, y: tall };
    }

    // Make room for the ellipses, but not so much that the line becomes small.
    holdEllipses(xs, ys) {
      const most = 0.5 * Math.max(xs[1] - xs[0], ys[1] - ys[0]);
      const line = [[...xs], [...ys]];
      for (const s of this.series.filter((each) => each.style === "ellipses")) {
        const { major, minor, angle } = tables[s.table];
        for (let i = 0; i < s.xs.length; i += 1) {
          const c = Math.cos(angle[i] * Math.PI / 180), d = Math.sin(angle[i] * Math.PI / 180);
          const reach = [Math.hypot(major[i] * c, minor[i] * d),
            Math.hypot(major[i] * d, minor[i] * c)];
          for (const [k, own, at] of [[0, xs, s.xs[i]], [1, ys, s.ys[i]]]) {
            if (!Number.isFinite(at + reach[k])) continue;
            own[0] = Math.min(own[0], Math.max(at - reach[k], line[k][0] - most));
            own[1] = Math.max(own[1], Math.min(at + reach[k], line[k][1] + most));
          }
        }
      }
    }

    size() {
      const screen = Math.max(260, Math.round(this.canvas.clientWidth || PAPER));
      const width = printing ? PAPER : screen;
      let height = this.spec.kind === "strips" ? 34 + 34 * this.spec.rows.length
        : Math.round(Math.min(300, Math.max(190, width * 0.34)));
      if (this.equal) {
        const { x, y } = this.full;
        const wanted = (width - 56) * (y[1] - y[0]) / (x[1] - x[0]) + 40;
        height = Math.round(Math.min(Math.max(wanted, 240), Math.min(620, width * 1.15)));
        if (this.spec.tall) height = Math.round(Math.min(620, width * (width < 500 ? 1 : this.spec.tall)));
      }
      return { width, height };
    }

    frame() {
      const { width, height } = this.size();
      return { width, height, left: 50, right: width - 8, top: 8, bottom: height - 34 };
    }

    reset() {
      this.touched = false;
      this.view = { x: [...this.full.x], y: [...this.full.y] };
      this.draw();
    }

    // Same scale on both axes of a map: widen the one that has room.
    fitted(frame) {
      const view = { x: [...this.view.x], y: [...this.view.y] };
      if (!this.equal) return view;
      const wide = frame.right - frame.left, tall = frame.bottom - frame.top;
      const scale = Math.max((view.x[1] - view.x[0]) / wide, (view.y[1] - view.y[0]) / tall);
      for (const [axis, pixels] of [["x", wide], ["y", tall]]) {
        const middle = (view[axis][0] + view[axis][1]) / 2;
        view[axis] = [middle - scale * pixels / 2, middle + scale * pixels / 2];
      }
      return view;
    }

    draw() {
      const f = this.frame();
      const view = this.fitted(f);
      const X = (v) => f.left + (v - view.x[0]) / (view.x[1] - view.x[0]) * (f.right - f.left);
      const Y = (v) => f.bottom - (v - view.y[0]) / (view.y[1] - view.y[0]) * (f.bottom - f.top);
      Object.assign(this, { f, shownView: view, X, Y });
      const svg = element("svg", { viewBox: `0 0 ${f.width} ${f.height}`, role: "img",
        "aria-label": this.spec.title, "font-family": "inherit", "font-size": 12 });
      const clip = "clip-" + this.spec.id;
      const defs = element("defs", {}, svg);
      element("rect", { x: f.left, y: f.top, width: f.right - f.left, height: f.bottom - f.top },
        element("clipPath", { id: clip }, defs));
      this.drawAxes(svg);
      const inside = element("g", { "clip-path": `url(#${clip})` }, svg);
      let drawn = 0;
      if (this.spec.picture) this.drawPicture(inside);
      for (const s of this.series) if (s.shown) drawn += this.drawSeries(inside, s);
      for (const mark of this.spec.marks || []) this.drawMark(inside, mark);
      if (this.equal) this.drawScale(svg);
      if (Number.isFinite(this.spec.north)) this.drawNorth(svg, this.spec.north);
      this.cursor = element("g", { "pointer-events": "none" }, inside);
      this.canvas.replaceChildren(svg);
      this.figure.dataset.drawn = String(drawn);
      this.figure.dataset.view = [...view.x, ...view.y].map((v) => v.toFixed(3)).join(" ");
    }

    drawAxes(svg) {
      const { f, X, Y, shownView: view, spec } = this;
      const grid = element("g", { stroke: "#e6e6e6" }, svg);
      const text = element("g", { fill: "#5c5c5c" }, svg);
      for (const [v, label] of ticks(view.x[0], view.x[1], (f.right - f.left) / 80)) {
        element("path", { d: `M${X(v)} ${f.top}V${f.bottom}` }, grid);
        element("text", { x: X(v), y: f.bottom + 15, "text-anchor": "middle" }, text)
          .textContent = label;
      }
      if (spec.kind === "strips") {
        spec.rows.forEach((name, row) => element("text", { x: f.left - 6, "text-anchor": "end",
          y: Y(spec.rows.length - row - 0.5) + 4 }, text).textContent = name);
      } else {
        for (const [v, label] of ticks(view.y[0], view.y[1], (f.bottom - f.top) / 45)) {
          element("path", { d: `M${f.left} ${Y(v)}H${f.right}` }, grid);
          element("text", { x: f.left - 6, y: Y(v) + 4, "text-anchor": "end" }, text)
            .textContent = label;
        }
        element("text", { x: 12, y: (f.top + f.bottom) / 2, "text-anchor": "middle",
          transform: `rotate(-90 12 ${(f.top + f.bottom) / 2})` }, text).textContent = spec.y;
      }
      element("text", { x: this.equal ? f.left : (f.left + f.right) / 2, y: f.height - 3,
        "text-anchor": this.equal ? "start" : "middle" }, text).textContent = spec.x;
    }

    drawSeries(parent, s) {
      if (s.style === "bars") return this.drawBars(parent, s);
      if (s.style === "ellipses") return this.drawEllipses(parent, s);
      if (s.style === "band") return this.drawBand(parent, s);
      if (s.style === "dots") return this.drawDots(parent, s);
      const { path, count } = this.line(s.xs, s.ys);
      element("path", { d: path, fill: "none", stroke: s.color, "stroke-width": s.width || 1.5,
        "stroke-dasharray": s.dash || "none", "stroke-linejoin": "round",
        "stroke-opacity": s.opacity || 1 }, parent);
      return count;
    }

    // A line without the points that lie within half a pixel of the one before.
    line(xs, ys) {
      const { X, Y, f } = this;
      const parts = [];
      let count = 0, px = NaN, py = NaN, up = true, low = 0, high = 0;
      const near = this.equal ? 0.7 : 0;
      for (let i = 0; i < xs.length; i += 1) {
        const x = X(xs[i]), y = Y(ys[i]);
        if (!Number.isFinite(x) || !Number.isFinite(y)) { up = true; continue; }
        if (!this.equal && (x < f.left - 60 || x > f.right + 60)) { up = true; continue; }
        if (!up && this.equal && Math.hypot(x - px, y - py) < near && i < xs.length - 1) continue;
        if (!up && !this.equal && x - px < 0.4) {
          // one vertical stroke holds all that falls on this column of pixels
          if (y < low || y > high) {
            low = Math.min(low, y); high = Math.max(high, y);
            parts.push("L" + x.toFixed(1) + " " + y.toFixed(1));
          }
          continue;
        }
        parts.push((up ? "M" : "L") + x.toFixed(1) + " " + y.toFixed(1));
        [px, py, up, low, high] = [x, y, false, y, y];
        count += 1;
      }
      return { path: parts.join("") || "M0 0", count };
    }

    drawDots(parent, s) {
      const { X, Y } = this;
      let count = 0;
      for (let i = 0; i < s.xs.length; i += 1) {
        if (!Number.isFinite(s.xs[i]) || !Number.isFinite(s.ys[i])) continue;
        element("circle", { cx: X(s.xs[i]).toFixed(1), cy: Y(s.ys[i]).toFixed(1), r: s.width || 2,
          fill: s.hollow ? "none" : s.color, stroke: s.hollow ? s.color : "none" }, parent);
        count += 1;
      }
      return count;
    }

    drawBand(parent, s) {
      const half = tables[s.table][s.half];
      const step = Math.max(1, Math.floor(s.xs.length / 800));
      const there = [], back = [];
      for (let i = 0; i < s.xs.length; i += step) {
        const reach = s.factor * half[i];
        if (!Number.isFinite(reach)) continue;
        const x = this.X(s.xs[i]).toFixed(1);
        there.push(x + " " + this.Y(s.ys[i] + reach).toFixed(1));
        back.push(x + " " + this.Y(s.ys[i] - reach).toFixed(1));
      }
      if (!there.length) return 0;
      element("path", { d: "M" + there.concat(back.reverse()).join("L") + "Z", fill: s.color,
        "fill-opacity": 0.18 }, parent);
      return there.length;
    }

    drawEllipses(parent, s) {
      const columns = tables[s.table];
      const group = element("g", { opacity: 0.2, fill: s.color }, parent);
      const scale = (this.f.right - this.f.left) / (this.shownView.x[1] - this.shownView.x[0]);
      let count = 0, px = Infinity, py = Infinity;
      for (let i = 0; i < s.xs.length; i += 1) {
        if (!Number.isFinite(columns.major[i])) continue;
        let x = this.X(s.xs[i]), y = this.Y(s.ys[i]);
        // so near to each other that they look like one band
        const near = Math.max(1.5, 0.5 * columns.minor[i] * scale);
        if (Math.hypot(x - px, y - py) < near && i < s.xs.length - 1) continue;
        [px, py, count] = [x, y, count + 1];
        x = x.toFixed(1); y = y.toFixed(1);
        element("ellipse", { cx: x, cy: y, rx: (columns.major[i] * scale).toFixed(1),
          ry: (columns.minor[i] * scale).toFixed(1),
          transform: `rotate(${(-columns.angle[i]).toFixed(1)} ${x} ${y})` }, group);
      }
      return count;
    }

    drawBars(parent, s) {
      const ends = tables[s.table][s.end];
      const y = this.Y(this.spec.rows.length - s.row - 0.12);
      const height = this.Y(this.spec.rows.length - s.row - 0.88) - y;
      let path = "";
      for (let i = 0; i < s.xs.length; i += 1) {
        const a = Math.max(this.f.left - 1, this.X(s.xs[i]));
        const b = Math.min(this.f.right + 1, this.X(ends[i]));
        if (b >= a) path += `M${a.toFixed(1)} ${y.toFixed(1)}H${b.toFixed(1)}v${height.toFixed(1)}`
          + `H${a.toFixed(1)}Z`;
      }
      element("path", { d: path || "M0 0", fill: s.color }, parent);
      return s.xs.length;
    }

    drawMark(parent, mark) {
      const x = this.X(mark.x), y = this.Y(mark.y);
      const group = element("g", { transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})` },
        parent);
      if (mark.symbol === "arrow") {
        element("path", { d: "M0 0H34M34 0l-9 -5v10Z", stroke: "#1b1b1b", "stroke-width": 2,
          fill: "#1b1b1b", transform: `rotate(${-mark.angle})` }, group);
      }
      if (mark.symbol === "foot") {
        element("path", { d: "M-9 -3c4 -3 13 -3 18 0c3 2 3 5 0 6c-5 2 -14 2 -18 -1c-3 -2 -3 -4 0 -5Z",
          fill: mark.color, "fill-opacity": mark.opacity || 1, stroke: "#1b1b1b",
          transform: `rotate(${-mark.angle})` }, group);
        return;
      }
      const shape = mark.symbol === "cross" ? "M-5 -5L5 5M5 -5L-5 5" : "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0";
      element("path", { d: shape, stroke: "#1b1b1b", "stroke-width": mark.symbol === "cross" ? 3 : 1.5,
        fill: "#f0e442" }, group);
      const ahead = mark.symbol === "arrow" && Math.cos(mark.angle * Math.PI / 180) > 0;
      element("text", { x: ahead ? -9 : 9, y: mark.symbol === "cross" ? 16 : -8, fill: "#1b1b1b",
        "text-anchor": ahead ? "end" : "start", // beside the arrow, not under it
        stroke: "#fff", "stroke-width": 3, "paint-order": "stroke" }, group)
        .textContent = mark.label;
    }

    drawPicture(parent) {
      const p = this.spec.picture;
      const scale = (this.f.right - this.f.left) / (this.shownView.x[1] - this.shownView.x[0]);
      const x = this.X(p.x), y = this.Y(p.y);
      element("image", { href: p.href, x: x - p.left * scale, y: y - p.up * scale, opacity: 0.75,
        width: p.width * scale, height: p.height * scale, preserveAspectRatio: "none",
        transform: `rotate(${-p.angle} ${x} ${y})` }, parent);
    }

    drawScale(svg) {
      const { f, shownView: view } = this;
      const metres = niceStep(view.x[1] - view.x[0], 7);
      const pixels = metres / (view.x[1] - view.x[0]) * (f.right - f.left);
      const x = f.right - 4 - pixels, y = f.height - 5;
      const group = element("g", { class: "scale" }, svg);
      element("path", { d: `M${x} ${y - 4}v4h${pixels}v-4`, fill: "none", stroke: "#1b1b1b",
        "stroke-width": 1.5 }, group);
      element("text", { x: x - 6, y, "text-anchor": "end", fill: "#1b1b1b" }, group)
        .textContent = `${Number(metres.toPrecision(6))} m`;
    }

    drawNorth(svg, angle) {
      const group = element("g", { class: "north", fill: "#1b1b1b", "text-anchor": "middle",
        transform: `translate(${this.f.left + 26} ${this.f.top + 28})` }, svg);
      element("path", { d: "M-12 -5L14 0L-12 5L-7 0Z", transform: `rotate(${-angle})` }, group);
      const turn = angle * Math.PI / 180;
      element("text", { x: 21 * Math.cos(turn), y: 4 - 21 * Math.sin(turn), "font-weight": 600 },
        group).textContent = "N";
    }

    // ---- pan, zoom, hover ---------------------------------------------------------------------
    zoom(factor, at) {
      const view = this.shownView;
      const axes = this.equal ? ["x", "y"] : ["x"];
      for (const axis of axes) {
        const [low, high] = view[axis];
        const centre = at ? at[axis] : (low + high) / 2;
        this.view[axis] = [centre + (low - centre) * factor, centre + (high - centre) * factor];
      }
      this.follow();
    }

    pan(dx, dy) {
      const { f, shownView: view } = this;
      const shift = dx / (f.right - f.left) * (view.x[1] - view.x[0]);
      this.view.x = view.x.map((v) => v - shift);
      if (this.equal) {
        const rise = dy / (f.bottom - f.top) * (view.y[1] - view.y[0]);
        this.view.y = view.y.map((v) => v + rise);
      }
      this.follow();
    }

    // Plots over the same abscissa show the same part of it.
    follow() {
      this.touched = true;
      this.draw();
      if (this.equal) return;
      for (const other of charts) {
        if (other === this || other.equal || other.spec.group !== this.spec.group) continue;
        other.view.x = [...this.view.x];
        other.draw();
      }
    }

    place(event) {
      const box = this.canvas.firstChild.getBoundingClientRect();
      const k = this.f.width / box.width;
      const px = (event.clientX - box.left) * k, py = (event.clientY - box.top) * k;
      const { f, shownView: view } = this;
      return { px, py, k,
        x: view.x[0] + (px - f.left) / (f.right - f.left) * (view.x[1] - view.x[0]),
        y: view.y[0] + (f.bottom - py) / (f.bottom - f.top) * (view.y[1] - view.y[0]) };
    }

    listen() {
      const fingers = new Map();
      let before = null;
      const c = this.canvas;
      c.addEventListener("wheel", (e) => {
        if (!e.ctrlKey && !e.shiftKey && !e.metaKey) return;
        e.preventDefault();
        const turned = e.deltaY || e.deltaX;
        this.zoom(Math.exp(Math.max(-1, Math.min(1, turned / 240))), this.place(e));
      }, { passive: false });
      c.addEventListener("dblclick", () => this.reset());
      c.addEventListener("pointerdown", (e) => {
        fingers.set(e.pointerId, e);
        const now = this.place(e);
        before = fingers.size === 1 ? { px: now.px, py: now.py } : null;
        if (e.pointerType === "mouse") c.setPointerCapture(e.pointerId);
      });
      const up = (e) => { fingers.delete(e.pointerId); before = null; };
      for (const name of ["pointerup", "pointercancel"]) c.addEventListener(name, up);
      c.addEventListener("pointerleave", () => { if (!fingers.size) hover(null, -1); });
      c.addEventListener("pointermove", (e) => {
        if (fingers.has(e.pointerId)) fingers.set(e.pointerId, e);
        if (fingers.size === 2) { before = this.pinch([...fingers.values()], before); return; }
        if (fingers.size === 1 && e.pointerType === "mouse") {
          const now = this.place(e);
          if (before) this.pan(now.px - before.px, now.py - before.py);
          before = { px: now.px, py: now.py };
          return;
        }
        this.point(this.place(e));
      });
    }

    pinch(two, before) {
      const [a, b] = two.map((e) => this.place(e));
      const apart = Math.hypot(a.px - b.px, a.py - b.py);
      const middle = { px: (a.px + b.px) / 2, py: (a.py + b.py) / 2 };
      if (before) {
        this.pan(middle.px - before.px, middle.py - before.py);
        this.zoom(before.apart / Math.max(20, apart), { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
      }
      return { ...middle, apart };
    }

    point(at) {
      const table = this.spec.link;
      if (!table) return;
      let best = -1, least = Infinity;
      for (const key of this.equal ? [["x", "y"]] : [[this.spec.over]]) {
        const xs = tables[table][key[0]], ys = key[1] ? tables[table][key[1]] : null;
        for (let i = 0; i < xs.length; i += 1) {
          const d = ys ? Math.hypot(xs[i] - at.x, ys[i] - at.y) : Math.abs(xs[i] - at.x);
          if (d < least) { least = d; best = i; }
        }
      }
      if (best >= 0) hover(table, best);
    }

    showCursor(table, row) {
      this.cursor.replaceChildren();
      this.readout.textContent = "";
      if (!table || this.spec.link !== table) return;
      const columns = tables[table];
      if (this.equal) {
        element("circle", { cx: this.X(columns.x[row]), cy: this.Y(columns.y[row]), r: 6,
          fill: "none", stroke: "#1b1b1b", "stroke-width": 2 }, this.cursor);
      } else {
        const x = this.X(columns[this.spec.over][row]);
        element("path", { d: `M${x} ${this.f.top}V${this.f.bottom}`, stroke: "#1b1b1b",
          "stroke-width": 1 }, this.cursor);
      }
      this.readout.textContent = (this.spec.told || [])
        .map(([key, words, digits]) => `${words} ${number(columns[key][row], digits)}`).join(" · ");
      this.figure.dataset.cursor = String(row);
    }
  }

  function hover(table, row) {
    for (const chart of charts) chart.showCursor(table, row);
  }

  function add(figure, spec) {
    const chart = new Chart(figure, spec);
    charts.push(chart);
    return chart;
  }

  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth === width) return;
    width = window.innerWidth;
    for (const chart of charts) chart.draw();
  });
  for (const name of ["beforeprint", "afterprint"]) {
    window.addEventListener(name, () => {
      printing = name === "beforeprint";
      for (const chart of charts) chart.draw();
    });
  }
  return { tables, charts, add, range, padded, number, html };
})();
