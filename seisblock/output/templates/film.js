// Player of an animation: clock, speed, scrubbing, and curves below a scene drawn by another script.
"use strict";
const byId = name => document.getElementById(name);
const INK = "#1c1f23", SOFT = "#626a73", FLOOR = "#c9ccd0", FONT = "11px system-ui, -apple-system, 'Hiragino Sans', 'Noto Sans JP', sans-serif";
const RIGHT = 6;
let film = null, left = 46, now = 0, playing = true, pace = 1, before = null;

function canvasOf(id, height) {
  const canvas = byId(id), ratio = window.devicePixelRatio || 1, width = canvas.clientWidth;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = FONT;
  return [pen, width, height];
}

function sample(values, place) {
  if (typeof values === "number") return values;
  const i = Math.min(Math.floor(place), film.count - 2), w = place - i;
  return values[i] * (1 - w) + values[i + 1] * w;
}

function polygon(pen, points, fill, line) {
  pen.beginPath();
  points.forEach(([x, y], i) => i ? pen.lineTo(x, y) : pen.moveTo(x, y));
  pen.closePath();
  pen.fillStyle = fill; pen.fill();
  if (line) { pen.strokeStyle = line; pen.lineWidth = 1.2; pen.stroke(); }
}

function bar(pen, width, height, scale) {
  const steps = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];
  const length = steps.filter(step => step * scale < width / 3).pop() || steps[0];
  const text = film.si || length >= 1 ? length + " m" : length >= 0.01 ? Math.round(length * 100) + " cm" : Math.round(length * 1000) + " mm";
  pen.fillStyle = INK; pen.fillRect(width - 10 - length * scale, height - 10, length * scale, 2);
  pen.textAlign = "right"; pen.fillText(text, width - 10, height - 15); pen.textAlign = "left";
}

function ticks(low, high, most) {
  const rough = (high - low) / most, decade = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(k => k * decade).find(size => size >= rough), found = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) found.push(+(k * step).toPrecision(12));
  return found;
}

const numeral = value => String(+value.toPrecision(3)).replace("-", "\u2212");

function gutter(pen) {
  // common margin for the longest axis number, so that all strips share one time axis
  pen.font = FONT;
  return Math.ceil(Math.max(38, ...film.strips.flatMap(data => data.inner.map(value => pen.measureText(numeral(value)).width))) + 8);
}

function strip(index, height) {
  const data = film.strips[index], [pen, width] = canvasOf("strip" + index, height), ends = index === film.strips.length - 1;
  const right = width - RIGHT, top = 16, bottom = height - (ends ? 16 : 4), [low, high] = data.range;
  const x = t => left + (t - film.first) / (film.last - film.first) * (right - left), y = v => bottom - (v - low) / (high - low) * (bottom - top);
  pen.save(); pen.beginPath(); pen.rect(left, top, right - left, bottom - top); pen.clip();
  film.phases.forEach(([start, end, colour]) => { pen.fillStyle = colour; pen.fillRect(x(start), top, Math.max(x(end) - x(start), .5), bottom - top); });
  pen.strokeStyle = "#333"; pen.lineWidth = .8; pen.setLineDash([6, 3]);
  data.levels.filter(level => low <= level && level <= high).forEach(level => { pen.beginPath(); pen.moveTo(left, y(level)); pen.lineTo(right, y(level)); pen.stroke(); });
  data.lines.forEach(line => {
    pen.strokeStyle = line.colour; pen.lineWidth = 1.1; pen.setLineDash(line.dashes); pen.beginPath();
    let broken = true;
    line.time.forEach((t, i) => {
      const value = line.values[i];
      if (value !== null) { broken ? pen.moveTo(x(t), y(value)) : pen.lineTo(x(t), y(value)); }
      broken = value === null;
    });
    pen.stroke();
  });
  pen.restore();
  // not clipped, so that the cursor is complete at both edges
  pen.strokeStyle = pen.fillStyle = INK; pen.lineWidth = 1.2; pen.beginPath(); pen.moveTo(x(now), top); pen.lineTo(x(now), bottom); pen.stroke();
  polygon(pen, [[x(now) - 4, top - 4], [x(now) + 4, top - 4], [x(now), top + 3]], INK, null);
  pen.fillStyle = SOFT; pen.fillText(data.label, left, 11);
  pen.textAlign = "right";
  [data.inner[1], 0, data.inner[0]].filter((v, i, all) => all.indexOf(v) === i).forEach(v => {
    if (v === 0 || Math.abs(y(v) - y(0)) > 11) pen.fillText(numeral(v), left - 5, y(v) + 4);
  });
  if (ends) {
    pen.textAlign = "center";
    ticks(film.first, film.last, Math.min(8, width / 90)).filter(t => x(t) < right - 24).forEach(t => {
      pen.fillRect(x(t), bottom, 1, 3); pen.fillText(String(t), x(t), height - 3);
    });
    pen.textAlign = "right"; pen.fillText("s", right, height - 3);
  }
  pen.textAlign = "left";
}

function draw() {
  drawScene((now - film.first) / (film.last - film.first) * (film.count - 1));
  if (film.strips.length) left = gutter(byId("strip0").getContext("2d"));
  film.strips.forEach((_, i) => strip(i, i === film.strips.length - 1 ? 108 : 96));
  const phase = film.names.filter(([start, end]) => start <= now && now <= end).pop();
  byId("clock").textContent = now.toFixed(3) + " s";
  byId("phase").textContent = phase ? phase[2] : "";
  byId("at").value = Math.round(1000 * (now - film.first) / (film.last - film.first));
  byId("play").textContent = playing ? film.words.pause : film.words.play;
}

function tick(stamp) {
  if (playing && before !== null) {
    now += (stamp - before) / 1000 * pace;
    if (now > film.last) now = film.first;
    draw();
  }
  before = stamp;
  requestAnimationFrame(tick);
}

function hold(time) { playing = false; now = Math.min(Math.max(time, film.first), film.last); draw(); }

function toggle() { playing = !playing; draw(); }

function follow(event) {
  if (event.type === "pointermove" && !event.buttons) return;
  const box = event.currentTarget.getBoundingClientRect(), share = (event.clientX - box.left - left) / (box.width - left - RIGHT);
  hold(film.first + share * (film.last - film.first));
}

function onKey(event) {
  if (["SELECT", "BUTTON"].includes(event.target.tagName)) return;
  if (event.key === " ") { toggle(); event.preventDefault(); }
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (step) { hold(now + step * pace / 25); event.preventDefault(); }
}

function play(data) {
  film = JSON.parse(data.textContent);
  now = film.first; pace = film.pace;
  playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  byId("play").onclick = toggle;
  byId("at").oninput = event => hold(film.first + event.target.value / 1000 * (film.last - film.first));
  byId("pace").onchange = event => { pace = +event.target.value; };
  document.querySelectorAll(".strip").forEach(canvas => { canvas.onpointerdown = canvas.onpointermove = follow; });
  document.onkeydown = onKey;
  window.onresize = draw;
  const asked = /[#&]t=([0-9.]+)/.exec(location.hash);
  if (asked) hold(+asked[1]); else draw();
  requestAnimationFrame(tick);
}
