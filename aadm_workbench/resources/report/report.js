"use strict";
(() => {
  const root = document.documentElement;
  const byId = (id) => document.getElementById(id);
  const all = (selector, from = document) => Array.from(from.querySelectorAll(selector));
  const words = JSON.parse(byId("words").textContent);
  const views = JSON.parse(byId("views").textContent);
  root.classList.add("js");
  all(".tools, .view3d").forEach((part) => { part.hidden = false; });

  // Language: texts by name, sentences by what they carry, verdicts by their class.
  const verdictOf = (element) => (element.className.match(/v-([a-z_]+)/) || [])[1];
  const speak = (language) => {
    const index = language === "zh" ? 1 : 0;
    root.lang = language;
    all("[data-w]").forEach((part) => { part.textContent = words.texts[part.dataset.w][index]; });
    all("[data-p]").forEach((part) => { part.textContent = words.sentences[part.dataset.p][index]; });
    all("[class^=v-]").forEach((part) => { part.textContent = words.verdicts[verdictOf(part)][index]; });
    all("[data-w-placeholder]").forEach((part) => {
      part.placeholder = words.texts[part.dataset.wPlaceholder][index];
      part.setAttribute("aria-label", part.placeholder);
    });
    byId("language").textContent = words.texts["ui.language"][index];
  };
  byId("language").addEventListener("click", () => speak(root.lang === "zh" ? "en" : "zh"));
  byId("print").addEventListener("click", () => window.print());

  // Columns: closed but for the worst, opened by a click or by a link that leads to them.
  const columns = all(".col");
  const open = (column, wanted) => {
    column.classList.toggle("closed", !wanted);
    const head = column.querySelector(".head");
    head.setAttribute("aria-expanded", String(wanted));
  };
  columns.forEach((column) => {
    const head = column.querySelector(".head");
    head.setAttribute("role", "button");
    head.addEventListener("click", () => open(column, column.classList.contains("closed")));
    head.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); head.click(); }
    });
  });
  const follow = () => {
    const column = byId(decodeURIComponent(location.hash.slice(1)));
    if (column && column.classList.contains("col")) { open(column, true); column.scrollIntoView(); }
  };
  window.addEventListener("hashchange", follow);
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href]");
    if (link && link.getAttribute("href") === location.hash) { follow(); }
  });
  // Guessed heights keep many open columns quick, and move what is below them once they are known: none for a few.
  byId("open-all").addEventListener("click", () => {
    root.classList.add("many");
    columns.forEach((column) => open(column, true));
  });
  byId("close-all").addEventListener("click", () => columns.forEach((column) => open(column, false)));

  // Filter and search.
  const rows = new Map(all("#list tbody tr").map((row) => [row.dataset.for, row]));
  const sift = () => {
    const wanted = byId("search").value.trim().toLowerCase();
    const fails = byId("fails").checked;
    let shown = 0;
    columns.forEach((column) => {
      const hide = (fails && column.dataset.verdict === "pass") || !column.dataset.search.includes(wanted);
      column.hidden = hide;
      rows.get(column.id).hidden = hide;
      shown += hide ? 0 : 1;
    });
    byId("nothing").hidden = shown > 0;
  };
  byId("search").addEventListener("input", sift);
  byId("fails").addEventListener("change", sift);

  // 3-D view: points of a column under a parallel projection, turned by dragging.
  const colours = { pass: "#00795a", fail: "#c03a00", inconclusive: "#b87a00", not_measured: "#5b6470", error: "#a0307c", not_assessed: "#5b6470" };
  const drawn = new WeakSet();
  function draw(canvas) {
    if (drawn.has(canvas)) { return; }
    drawn.add(canvas);
    const scene = views[canvas.dataset.view];
    const pen = canvas.getContext("2d");
    const state = { turn: -0.6, rise: 0.5, zoom: 1 };
    const reach = scene.reach;
    const project = (x, y, z) => {
      const c = Math.cos(state.turn), s = Math.sin(state.turn);
      const across = c * x - s * y, deep = s * x + c * y;
      const scale = (canvas.width * 0.31 * state.zoom) / reach;
      const high = Math.cos(state.rise) * (z - scene.middle) + Math.sin(state.rise) * deep;
      return [canvas.width / 2 + across * scale, canvas.height / 2 - high * scale];
    };
    const line = (points, colour, width, dash, closed) => {
      pen.beginPath();
      points.forEach((point, index) => pen[index ? "lineTo" : "moveTo"](...project(...point)));
      if (closed) { pen.closePath(); }
      pen.setLineDash(dash || []);
      pen.strokeStyle = colour;
      pen.lineWidth = width;
      pen.stroke();
    };
    const ring = (x, y, z, radius, colour, width, dash) => {
      const points = [];
      for (let step = 0; step < 32; step += 1) {
        points.push([x + radius * Math.cos((step * Math.PI) / 16), y + radius * Math.sin((step * Math.PI) / 16), z]);
      }
      line(points, colour, width, dash, true);
    };
    const paint = () => {
      pen.clearRect(0, 0, canvas.width, canvas.height);
      if (scene.size) {
        const [a, b] = [scene.size[0] / 2, scene.size[1] / 2];
        const face = (z) => [[-a, -b, z], [a, -b, z], [a, b, z], [-a, b, z]];
        line(face(scene.foot), "#6b7682", 2, null, true);
        line(face(scene.foot + scene.block), "#b3bcc4", 1, null, true);
        face(scene.foot).forEach((corner) => line([corner, [corner[0], corner[1], scene.foot + scene.block]], "#b3bcc4", 1));
      }
      pen.font = "19px sans-serif";
      pen.textAlign = "center";
      scene.points.forEach(([label, x, y, z, dx, dy, radius, length, verdict]) => {
        const colour = colours[verdict];
        ring(x, y, z, radius, "#8b97a3", 1.2, verdict === "not_measured" ? [4, 4] : null);
        if (dx !== null) {
          const [px, py] = [x + dx * scene.factor, y + dy * scene.factor];
          ring(px, py, z, radius, colour, 2);
          if (length) { line([[px, py, z], [px, py, z - length]], colour, 3.5); }
          line([[x, y, z], [px, py, z]], colour, 3);
        }
        const [tx, ty] = project(x, y, z);
        pen.fillStyle = verdict === "fail" ? "#8a2900" : "#1d2730";
        pen.fillText(label, tx, ty - 12);
      });
    };
    let from = null;
    canvas.addEventListener("pointerdown", (event) => { from = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointermove", (event) => {
      if (!from) { return; }
      state.turn += (event.clientX - from[0]) / 120;
      state.rise = Math.min(1.57, Math.max(-1.57, state.rise + (event.clientY - from[1]) / 120));
      from = [event.clientX, event.clientY];
      requestAnimationFrame(paint);
    });
    canvas.addEventListener("pointerup", () => { from = null; });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      state.zoom = Math.min(8, Math.max(0.5, state.zoom * Math.exp(-event.deltaY / 500)));
      requestAnimationFrame(paint);
    }, { passive: false });
    paint();
  }

  // Only what comes into view is drawn: a hundred at once would take seconds.
  const watcher = new IntersectionObserver((entries) => entries.forEach((entry) => {
    if (entry.isIntersecting) { draw(entry.target); }
  }), { rootMargin: "200px" });
  all("canvas").forEach((canvas) => watcher.observe(canvas));

  columns.forEach((column, index) => open(column, index === 0 && column.dataset.verdict !== "pass"));
  follow();
})();
