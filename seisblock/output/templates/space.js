// Orthographic 3-D scene of cuboids, cylinders, hulls and springs on a patch of ground; dragging rotates the view.
const FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], COILS = 5, WIDE = 0.35;
const MARK = "#c0392b", EDGE = "#404040";
const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map(i => [i >> 2, i >> 1 & 1, i & 1].map(bit => bit - 0.5));
const SIDES = 20, AROUND = Array.from({ length: SIDES }, (_, i) => i);
const RIMS = [-0.5, 0.5].flatMap(z => AROUND.map(i => 2 * Math.PI * i / SIDES).map(a => [Math.cos(a) / 2, Math.sin(a) / 2, z]));
const MANTLE = AROUND.map(i => [i, (i + 1) % SIDES, SIDES + (i + 1) % SIDES, SIDES + i]);
const CAPS = [AROUND.slice().reverse(), AROUND.map(i => SIDES + i)];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], plus = (a, b) => a.map((v, i) => v + b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
let azimuth = null, dragged = null;

function eye() {
  const [first, elevation] = film.scene.view, angle = azimuth === null ? first : azimuth;
  const c = Math.cos(angle), s = Math.sin(angle), ce = Math.cos(elevation), se = Math.sin(elevation);
  return { right: [-s, c, 0], up: [-c * se, -s * se, ce], ahead: [c * ce, s * ce, se] };
}

// bounding box of everything ever in sight from this azimuth
function extent() {
  const all = film.scene.extents, turned = azimuth === null ? 0 : (azimuth - film.scene.view[0]) / (2 * Math.PI) * all.length;
  const i = Math.floor(turned), after = turned - i, box = k => all[(k % all.length + all.length) % all.length];
  return box(i).map((value, k) => value * (1 - after) + box(i + 1)[k] * after);
}

function rotated(q, v) {
  const u = q.slice(1), inner = cross(u, v).map((value, i) => value + q[0] * v[i]);
  return cross(u, inner).map((value, i) => v[i] + 2 * value);
}

function drawScene(place) {
  const scene = film.scene, { right, up, ahead } = eye(), box = extent();
  const [pen, width, height] = canvasOf("scene", Math.min(Math.max(byId("scene").clientWidth * 0.9, 300), 520));
  const scale = Math.min(width / (box[1] - box[0]), height / (box[3] - box[2]));
  const put = p => [width / 2 + (dot(p, right) - (box[0] + box[1]) / 2) * scale, height / 2 - (dot(p, up) - (box[2] + box[3]) / 2) * scale];
  const vector = columns => columns.map(column => sample(column, place)), ground = vector(scene.ground);
  const patch = scene.patch.map(corner => plus(corner, ground));
  polygon(pen, patch.map(put), "#e6e6e6", "#bfbfbf");
  // x axis on the ground, for orientation
  pen.strokeStyle = SOFT; pen.fillStyle = SOFT; pen.lineWidth = 1; pen.beginPath();
  const [x0, y0] = put(ground), [x1, y1] = put(plus(ground, [scene.half, 0, 0]));
  pen.moveTo(x0, y0); pen.lineTo(x1, y1); pen.stroke(); pen.fillText(film.along, x1 + 4, y1 + 4);
  scene.springs.forEach(spring => coil(pen, put, plus(spring.foot, ground), Math.min(vector(spring.top)[2], spring.free), spring.free * scale));
  const corner = spring => {
    const top = vector(spring.top), [x, y] = put(plus(top, ground));
    pen.fillStyle = top[2] > spring.free ? MARK : EDGE; pen.beginPath(); pen.arc(x, y, 4, 0, 7); pen.fill();
  };
  // the spring farthest from the viewer is hidden behind the block
  const [behind, ...before] = [...scene.springs].sort((a, b) => dot(a.foot, ahead) - dot(b.foot, ahead));
  if (behind) corner(behind);
  faces(scene, vector, ground, ahead).forEach(face => polygon(pen, face.points.map(put), face.shade, face.edge));
  before.forEach(corner);
  bar(pen, width, height, scale);
}

function faces(scene, vector, ground, ahead) {
  const seen = [];
  scene.solids.forEach(solid => {
    const centre = plus(vector(solid.centre), ground), q = vector(solid.turn), length = Math.hypot(...q), turn = q.map(v => v / length);
    const corners = (solid.hull || (solid.round ? RIMS : CORNERS).map(corner => corner.map((v, i) => v * solid.size[i])))
      .map(corner => plus(centre, rotated(turn, corner)));
    const edge = solid.fell !== null && now >= solid.fell ? MARK : EDGE;
    (solid.hull ? solid.faces : solid.round ? [...MANTLE, ...CAPS] : FACES).forEach(face => {
      const points = face.map(i => corners[i]), minus = (a, b) => a.map((v, i) => v - b[i]);
      const across = cross(minus(points[1], points[0]), minus(points[2], points[1])), size = Math.hypot(...across);
      const normal = across.map(v => v / size);
      if (dot(normal, ahead) <= 1e-9) return;
      const light = 0.72 + 0.32 * dot(normal, scene.light);
      const shade = "rgb(" + scene.stone.map(v => Math.round(255 * Math.min(Math.max(v * light, 0), 1))).join(",") + ")";
      seen.push({ depth: points.reduce((sum, p) => sum + dot(p, ahead), 0) / points.length, points, shade, edge });
    });
  });
  return seen.sort((a, b) => a.depth - b.depth);
}

function coil(pen, put, foot, height, free) {
  const [x, low] = put(foot), [, high] = put([foot[0], foot[1], foot[2] + height]), turns = 2 * COILS + 1;
  pen.strokeStyle = SOFT; pen.lineWidth = 1; pen.beginPath(); pen.moveTo(x, low);
  for (let i = 1; i < turns; i++) pen.lineTo(x + (i % 2 ? 0.5 : -0.5) * WIDE * free, low + (high - low) * i / turns);
  pen.lineTo(x, high); pen.stroke();
}

byId("scene").onpointerdown = event => { dragged = event.clientX; byId("scene").setPointerCapture(event.pointerId); };
byId("scene").onpointermove = event => {
  if (dragged === null) return;
  azimuth = (azimuth === null ? film.scene.view[0] : azimuth) - (event.clientX - dragged) / 150;
  dragged = event.clientX; draw();
};
byId("scene").onpointerup = byId("scene").onpointercancel = () => { dragged = null; };
