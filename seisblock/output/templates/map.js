"use strict";
(() => {
  const data = JSON.parse(document.getElementById("stations").textContent);
  const map = document.getElementById("map"), layer = map.querySelector("g"), details = document.getElementById("details");
  const createSvg = (name, attributes, parent) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    if (parent) parent.append(node);
    return node;
  };
  const html = (name, text, parent) => {
    const node = document.createElement(name);
    node.textContent = text;
    parent.append(node);
    return node;
  };
  // map units: km east and south of the centre
  const bounds = [0, 1].map((axis) => [Math.min(...data.framed.map((p) => p[axis])), Math.max(...data.framed.map((p) => p[axis]))]);
  const middle = bounds.map(([low, high]) => (low + high) / 2);
  const view = { x: middle[0], y: middle[1], km: 1 };  // km per pixel
  const circles = [], squares = [];
  for (const line of data.coast) createSvg("polyline", { points: line.join(" "), class: "coast" }, layer);
  let star, name;

  const fit = () => {
    const box = map.getBoundingClientRect();
    const spans = bounds.map(([low, high]) => high - low);
    view.x = middle[0];
    view.y = middle[1];
    view.km = Math.max((spans[0] || 5) / (box.width * 0.84), (spans[1] || 5) / (box.height * 0.84), 0.005);
    draw();
  };
  const draw = () => {
    const box = map.getBoundingClientRect();
    const across = box.width * view.km, along = box.height * view.km;
    map.setAttribute("viewBox", `${view.x - across / 2} ${view.y - along / 2} ${across} ${along}`);
    for (const circle of circles) circle.setAttribute("r", 6 * view.km);
    for (const [square, at] of squares) {
      for (const [key, value] of [["x", at[0] - 6 * view.km], ["y", at[1] - 6 * view.km], ["width", 12 * view.km], ["height", 12 * view.km]]) {
        square.setAttribute(key, value);
      }
    }
    if (star) {
      star.setAttribute("transform", `translate(${data.epicentre[0]} ${data.epicentre[1]}) scale(${view.km})`);
      name.setAttribute("transform", `translate(${data.epicentre[0]} ${data.epicentre[1]}) scale(${view.km})`);
    }
    const rough = 110 * view.km, step = 10 ** Math.floor(Math.log10(rough));
    const length = [5, 2, 1].map((factor) => factor * step).find((km) => km <= rough);
    const scale = document.querySelector(".scale");
    scale.querySelector("b").textContent = `${Number(length.toPrecision(1))} km`;
    scale.querySelector("i").style.width = `${length / view.km}px`;
  };
  const zoom = (factor, px, py) => {
    const box = map.getBoundingClientRect();
    const dx = (px ?? box.left + box.width / 2) - box.left - box.width / 2, dy = (py ?? box.top + box.height / 2) - box.top - box.height / 2;
    const km = Math.min(Math.max(view.km * factor, 1e-4), 100);
    view.x += dx * (view.km - km);
    view.y += dy * (view.km - km);
    view.km = km;
    draw();
  };
  const choose = (point, circle) => {
    [...circles, ...squares.map(([square]) => square)].forEach((shape) => shape.classList.toggle("selected", shape === circle));
    details.replaceChildren();
    html("h2", point.name, details);
    if (point.failure) html("p", point.failure, details).className = "note";
    if (point.outline.length > 1) {
      const reach = Math.max(...point.outline.flat().map(Math.abs)) || 1, count = point.outline.length;
      const trace = createSvg("svg", { viewBox: "0 0 160 70", preserveAspectRatio: "none", role: "img", "aria-label": point.peak }, details);
      const at = (value, index) => `${(160 * index / (count - 1)).toFixed(2)},${(35 - 32 * value / reach).toFixed(2)}`;
      const edge = [...point.outline.map((pair, i) => at(pair[1], i)), ...point.outline.map((pair, i) => at(pair[0], i)).reverse()];
      createSvg("polygon", { points: edge.join(" "), fill: "#62697a", stroke: "#62697a", "stroke-width": "0.4" }, trace);
      html("p", `${point.peak}, ${point.end}`, details).className = "soft";
    }
    const list = html("dl", "", details);
    for (const [key, value] of point.details) {
      html("dt", key, list);
      html("dd", value, list);
    }
  };

  const pointOf = new Map();
  let dragged = 0;
  // the most severe station is drawn on top; a second click selects the one beneath
  const place = (point, circle) => {
    createSvg("title", {}, circle).textContent = point.name;
    pointOf.set(circle, point);
    circle.addEventListener("click", (event) => {
      if (event.detail && dragged > 5) return;
      const overlapping = document.elementsFromPoint(event.clientX, event.clientY).filter((node) => pointOf.has(node));
      const next = overlapping[(overlapping.indexOf(map.querySelector(".selected")) + 1) % overlapping.length] ?? circle;
      choose(pointOf.get(next), next);
    });
    circle.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") {
        event.preventDefault();
        choose(point, circle);
      }
    });
  };
  [...data.points].reverse().forEach((point) => {
    const circle = createSvg("circle", { cx: point.at[0], cy: point.at[1], fill: point.colour, tabindex: 0, role: "button", "aria-label": point.name }, layer);
    circle.classList.toggle("falls", point.falls);
    place(point, circle);
    circles.push(circle);
  });
  data.squares.forEach((point) => {
    const square = createSvg("rect", { fill: point.colour, tabindex: 0, role: "button", "aria-label": point.name }, layer);
    place(point, square);
    squares.push([square, point.at]);
  });
  if (data.epicentre) {
    const corners = Array.from({ length: 10 }, (_, i) => {
      const r = i % 2 ? 5 : 12, turn = (Math.PI * i) / 5;
      return `${(r * Math.sin(turn)).toFixed(2)},${(-r * Math.cos(turn)).toFixed(2)}`;
    });
    star = createSvg("polygon", { points: corners.join(" "), fill: "#fff", stroke: "#000", "stroke-width": 1.4, "pointer-events": "none" }, layer);
    name = createSvg("text", { y: 25, "text-anchor": "middle", "font-size": 12, "pointer-events": "none", stroke: "#f5f6f7", "stroke-width": 3, "paint-order": "stroke" }, layer);
    name.textContent = data.named;
  }

  const fingers = new Map();
  map.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    dragged = 0;
  });
  window.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    dragged += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (fingers.size === 1) {
      view.x -= (now[0] - before[0]) * view.km;
      view.y -= (now[1] - before[1]) * view.km;
      draw();
    } else if (fingers.size === 2) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      zoom(apart(before) / apart(now), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    }
    fingers.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, (event) => fingers.delete(event.pointerId));
  map.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, event.clientX, event.clientY);
  }, { passive: false });
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => (button.dataset.zoom === "0" ? fit() : zoom(Number(button.dataset.zoom))));
  }
  window.addEventListener("resize", draw);
  fit();
  choose(data.points[0], circles[circles.length - 1]);
})();
