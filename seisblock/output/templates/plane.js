// Side view: polygons on a moving ground, paths of points, and a close-up window.
function drawScene(place) {
  const scene = film.scene, wide = byId("scene").clientWidth, tall = Math.min(Math.max(wide * 0.8, 220), 400);
  view("scene", tall, scene.extent, true, place);
  if (scene.close) view("close", Math.min(tall, byId("close").clientWidth * 0.8), scene.close, false, place);
}

function view(id, height, box, moving, place) {
  const scene = film.scene, [pen, width] = canvasOf(id, height);
  const scale = Math.min(width / (box[1] - box[0]), height / (box[3] - box[2]));
  const middle = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2];
  const shift = moving ? sample(scene.shift, place) : 0;
  const put = ([x, z]) => [width / 2 + (x + shift - middle[0]) * scale, height / 2 - (z - middle[1]) * scale];
  scene.floors.forEach(floor => polygon(pen, floor.map(put), FLOOR, null));
  if (moving) {
    const step = (box[1] - box[0]) / 12, top = Math.max(...scene.floors[0].map(p => p[1]));
    pen.strokeStyle = SOFT; pen.lineWidth = 1; pen.beginPath();
    for (let k = -24; k <= 24; k++) {
      const [x, y] = put([middle[0] + k * step, top]);
      pen.moveTo(x, y); pen.lineTo(x - 4, y + 8);
    }
    pen.stroke();
  }
  scene.bodies.forEach(body => {
    const x = sample(body.x, place), z = sample(body.z, place), turn = sample(body.turn, place);
    const c = Math.cos(turn), s = Math.sin(turn);
    body.pieces.forEach(piece => polygon(pen, piece.corners.map(([a, b]) => put([x + a * c + b * s, z + b * c - a * s])), piece.colour, INK));
  });
  scene.trails.forEach(trail => {
    pen.strokeStyle = trail.colour; pen.lineWidth = 1.6; pen.beginPath();
    let i = 0;
    for (; i < trail.time.length && trail.time[i] <= now; i++) { const [x, y] = put([trail.x[i], trail.z[i]]); i ? pen.lineTo(x, y) : pen.moveTo(x, y); }
    const before = Math.max(i - 1, 0), after = Math.min(i, trail.time.length - 1), span = trail.time[after] - trail.time[before];
    const share = span > 0 ? (now - trail.time[before]) / span : 0, between = values => values[before] + share * (values[after] - values[before]);
    const [x, y] = put([between(trail.x), between(trail.z)]);
    pen.lineTo(x, y); pen.stroke();
    pen.fillStyle = trail.colour; pen.beginPath(); pen.arc(x, y, 3, 0, 7); pen.fill();
  });
  bar(pen, width, height, scale);
}
