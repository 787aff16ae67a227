// Draws a film that stands in the page as data: the scene, the enlarged window, the curves; at any size and any speed.
"use strict";
const film = JSON.parse(document.getElementById("film").textContent);
const byId = name => document.getElementById(name);
const INK = "#1c1f23", SOFT = "#626a73", FLOOR = "#c9ccd0", FONT = "11px system-ui, -apple-system, 'Hiragino Sans', 'Noto Sans JP', sans-serif";
const count = film.shift.length, first = film.first, last = film.last;
let now = first, playing = true, pace = film.pace, before = null;

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
  const i = Math.min(Math.floor(place), count - 2), w = place - i;
  return values[i] * (1 - w) + values[i + 1] * w;
}

function polygon(pen, points, fill, line) {
  pen.beginPath();
  points.forEach(([x, y], i) => i ? pen.lineTo(x, y) : pen.moveTo(x, y));
  pen.closePath();
  pen.fillStyle = fill; pen.fill();
  if (line) { pen.strokeStyle = line; pen.lineWidth = 1.2; pen.stroke(); }
}

function scene(id, height, box, moving, place) {
  const [pen, width] = canvasOf(id, height);
  const scale = Math.min(width / (box[1] - box[0]), height / (box[3] - box[2]));
  const middle = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2];
  const shift = moving ? sample(film.shift, place) : 0;
  const put = ([x, z]) => [width / 2 + (x + shift - middle[0]) * scale, height / 2 - (z - middle[1]) * scale];
  film.floors.forEach(floor => polygon(pen, floor.map(put), FLOOR, null));
  if (moving) {
    const step = (box[1] - box[0]) / 12, top = Math.max(...film.floors[0].map(p => p[1]));
    pen.strokeStyle = SOFT; pen.lineWidth = 1; pen.beginPath();
    for (let k = -24; k <= 24; k++) {
      const [x, y] = put([middle[0] + k * step, top]);
      pen.moveTo(x, y); pen.lineTo(x - 4, y + 8);
    }
    pen.stroke();
  }
  film.bodies.forEach(body => {
    const x = sample(body.x, place), z = sample(body.z, place), turn = sample(body.turn, place);
    const c = Math.cos(turn), s = Math.sin(turn);
    body.pieces.forEach(piece => polygon(pen, piece.corners.map(([a, b]) => put([x + a * c + b * s, z + b * c - a * s])), piece.colour, INK));
  });
  film.trails.forEach(trail => {
    pen.strokeStyle = trail.colour; pen.lineWidth = 1.6; pen.beginPath();
    const end = Math.min(Math.ceil(place), count - 1), skip = Math.max(1, Math.floor(count / 3000));
    for (let i = 0; i <= end; i += skip) { const [x, y] = put([trail.x[i], trail.z[i]]); i ? pen.lineTo(x, y) : pen.moveTo(x, y); }
    const [x, y] = put([sample(trail.x, place), sample(trail.z, place)]);
    pen.lineTo(x, y); pen.stroke();
    pen.fillStyle = trail.colour; pen.beginPath(); pen.arc(x, y, 3, 0, 7); pen.fill();
  });
  bar(pen, width, height, scale);
}

function bar(pen, width, height, scale) {
  const steps = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];
  const length = steps.filter(step => step * scale < width / 3).pop() || steps[0];
  const text = length >= 1 ? length + " m" : length >= 0.01 ? Math.round(length * 100) + " cm" : Math.round(length * 1000) + " mm";
  pen.fillStyle = INK; pen.fillRect(width - 10 - length * scale, height - 10, length * scale, 2);
  pen.textAlign = "right"; pen.fillText(text, width - 10, height - 15); pen.textAlign = "left";
}

function strip(index, height) {
  const data = film.strips[index], [pen, width] = canvasOf("strip" + index, height);
  const ends = index === film.strips.length - 1, left = 46, right = width - 6, top = 16, bottom = height - (ends ? 14 : 4);
  const [low, high] = data.range, x = t => left + (t - first) / (last - first) * (right - left);
  const y = v => bottom - (v - low) / (high - low) * (bottom - top);
  film.phases.forEach(([start, end, colour]) => { pen.fillStyle = colour; pen.fillRect(x(start), top, Math.max(x(end) - x(start), .5), bottom - top); });
  pen.strokeStyle = "#333"; pen.lineWidth = .8; pen.setLineDash([6, 3]);
  data.levels.filter(level => low <= level && level <= high).forEach(level => { pen.beginPath(); pen.moveTo(left, y(level)); pen.lineTo(right, y(level)); pen.stroke(); });
  pen.setLineDash([]);
  pen.strokeStyle = data.colour; pen.lineWidth = 1.1; pen.beginPath();
  data.time.forEach((t, i) => i ? pen.lineTo(x(t), y(data.values[i])) : pen.moveTo(x(t), y(data.values[i])));
  pen.stroke();
  pen.fillStyle = SOFT; pen.fillText(data.label, left, 11);
  pen.textAlign = "right";
  [data.inner[1], 0, data.inner[0]].filter((v, i, all) => all.indexOf(v) === i).forEach(v => {
    if (v === 0 || Math.abs(y(v) - y(0)) > 11) pen.fillText(String(+v.toPrecision(3)), left - 5, y(v) + 4);
  });
  pen.textAlign = "left"; if (ends) pen.fillText(first.toFixed(2), left, height - 2);
  pen.textAlign = "right"; if (ends) pen.fillText(last.toFixed(2) + " s", right, height - 2);
  pen.textAlign = "left";
  pen.strokeStyle = INK; pen.lineWidth = 1.2; pen.beginPath(); pen.moveTo(x(now), top); pen.lineTo(x(now), bottom); pen.stroke();
}

function draw() {
  const place = (now - first) / (last - first) * (count - 1);
  const wide = byId("scene").clientWidth, tall = Math.min(Math.max(wide * 0.8, 220), 400);
  scene("scene", tall, film.extent, true, place);
  if (film.close) scene("close", Math.min(tall, byId("close").clientWidth * 0.8), film.close, false, place);
  film.strips.forEach((_, i) => strip(i, i === film.strips.length - 1 ? 106 : 96));
  const phase = film.names.filter(([start, end]) => start <= now && now <= end).pop();
  byId("clock").textContent = now.toFixed(3) + " s";
  byId("phase").textContent = phase ? phase[2] : "";
  byId("at").value = Math.round(1000 * (now - first) / (last - first));
  byId("play").textContent = playing ? film.words.pause : film.words.play;
}

function tick(stamp) {
  if (playing && before !== null) {
    now += (stamp - before) / 1000 * pace;
    if (now > last) now = first;
    draw();
  }
  before = stamp;
  requestAnimationFrame(tick);
}

function hold(time) { playing = false; now = Math.min(Math.max(time, first), last); draw(); }

byId("play").onclick = () => { playing = !playing; draw(); };
byId("at").oninput = event => hold(first + event.target.value / 1000 * (last - first));
byId("pace").onchange = event => { pace = +event.target.value; };
document.onkeydown = event => {
  if (event.target.tagName === "SELECT") return;
  if (event.key === " ") { playing = !playing; draw(); event.preventDefault(); }
  if (event.key === "ArrowRight") hold(now + pace / 25);
  if (event.key === "ArrowLeft") hold(now - pace / 25);
};
window.onresize = draw;
const asked = /[#&]t=([0-9.]+)/.exec(location.hash);
if (asked) hold(+asked[1]); else draw();
requestAnimationFrame(tick);
