// SPDX-License-Identifier: BSD-3-Clause
// The 3-D view of a report: a string in its well, or nodes of parts. Needs three.js (global THREE) with OrbitControls and the object SCENE.
"use strict";
(function () {
  const host = document.getElementById("view");
  const SIDES = 10;  // of a pipe in the picture
  const BACKGROUND = 0xffffff;
  const LABEL = 17;  // height of a text in the picture [px]
  const KINDS = {f4: Float32Array, i2: Int16Array, u4: Uint32Array};

  function unpacked(entry) {
    const bytes = Uint8Array.from(atob(entry.data), (c) => c.charCodeAt(0));
    const numbers = new KINDS[entry.kind](bytes.buffer);
    return {at: (i) => numbers[i] * (entry.scale || 1), shape: entry.shape, numbers};
  }
  const data = {};
  for (const [name, entry] of Object.entries(SCENE)) data[name] = entry && entry.data !== undefined ? unpacked(entry) : entry;
  const fields = SCENE.fields.map((f) => Object.assign({}, f, {rest: unpacked(f.rest), motion: f.motion && unpacked(f.motion)}));
  const count = data.position.shape[0];
  const samples = data.time ? data.time.shape[0] : 0;
  const state = {sample: -1, field: 0, lateral: 1, playing: false, forces: true};

  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
  } catch (error) {
    host.textContent = "This browser shows no WebGL: there is no 3-D view.";
    document.body.dataset.view = "no WebGL";
    return;
  }
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  host.appendChild(renderer.domElement);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(BACKGROUND);
  const camera = new THREE.PerspectiveCamera(40, 1, 1e-3, 1e5);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8890a0, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.55);
  camera.add(lamp);
  lamp.position.set(1, 2, 3);
  scene.add(camera);

  // Extent of the model at rest.
  const box = new THREE.Box3();
  for (let i = 0; i < count; ++i) box.expandByPoint(new THREE.Vector3(data.position.at(3 * i), data.position.at(3 * i + 1), data.position.at(3 * i + 2)));
  const size = Math.max(1e-6, box.getSize(new THREE.Vector3()).length());

  function component(values, sample, i, c) {
    return values.at((sample * count + i) * 3 + c);
  }
  function displacement(i, c) {
    return state.sample < 0 ? data.rest.at(3 * i + c) : component(data.motion, state.sample, i, c);
  }
  function fieldAt(i) {
    const f = fields[state.field];
    if (!f) return 0;
    return state.sample < 0 || !f.motion ? f.rest.at(i) : f.motion.at(state.sample * count + i);
  }
  const colours = SCENE.colours.map((c) => new THREE.Color(c[0], c[1], c[2]));
  function colourOf(value) {
    const f = fields[state.field];
    const share = f ? Math.max(0, Math.min(1, value / f.largest)) : 0;
    return colours[Math.round(share * (colours.length - 1))];
  }

  // The box around the model. Numbers and names stand beside three of its edges, in pixels away from them: they keep their room at every zoom.
  const GAP = 6;  // between an edge, its numbers and its name [px]
  const axes = [];
  let placed = [];  // texts that are shown and the room they take, from the middle of the picture [px]
  function label(text) {
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("2d");
    const high = 44;
    context.font = high * 0.8 + "px sans-serif";
    canvas.width = Math.ceil(context.measureText(text).width) + 8;
    canvas.height = high;
    context.font = high * 0.8 + "px sans-serif";
    context.fillStyle = "#444444";
    context.fillText(text, 4, high * 0.78);
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false}));
    sprite.material.map.minFilter = THREE.LinearFilter;
    scene.add(sprite);
    return {text, sprite, wide: LABEL * canvas.width / high};
  }
  function niceStep(length) {
    const raw = length / 4, power = Math.pow(10, Math.floor(Math.log10(raw)));
    return power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
  }
  function addAxes() {
    const isString = SCENE.kind === "string";
    const room = new THREE.Box3(box.min.clone().subScalar(0.06 * size), box.max.clone().addScalar(0.06 * size));
    scene.add(new THREE.Box3Helper(room, 0xc8ccd4));
    const names = isString ? ["east [m]", "depth [m]", "north [m]"] : ["x [m]", "z [m]", "y [m]"];
    const signs = [1, isString ? -1 : 1, -1];
    for (let axis = 0; axis < 3; ++axis) {
      const key = "xyz"[axis], low = room.min[key], high = room.max[key], step = niceStep(Math.max(high - low, size / 3));
      const digits = Math.max(0, Math.min(3, -Math.floor(Math.log10(step)))), ticks = [];
      for (let v = Math.ceil(low / step) * step; v <= high; v += step)
        if (!(isString && axis === 1 && v > 1e-9 * size)) ticks.push({value: v, ...label((signs[axis] * v + 0).toFixed(digits).replace(/^-(0(\.0+)?)$/, "$1"))});
      const dots = new THREE.BufferGeometry();
      dots.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * ticks.length), 3));
      const marks = new THREE.Points(dots, new THREE.PointsMaterial({size: 4, sizeAttenuation: false, color: 0x8a8a8a}));
      marks.frustumCulled = false;
      scene.add(marks);
      axes.push({key, low, high, ticks, marks, room, name: label(names[axis])});
    }
  }
  // Pixels from the middle of the picture, up positive; null behind the camera.
  function onScreen(point) {
    const p = point.clone().project(camera);
    return p.z > 1 ? null : {x: p.x * host.clientWidth / 2, y: p.y * renderer.domElement.clientHeight / 2};
  }
  // A text beside a point, as far away in the direction n as it is large there; false where it would lie on another one or outside.
  function stand(one, point, n, distance) {
    const at = onScreen(point);
    if (!at) return false;
    const away = distance + (Math.abs(n.x) * one.wide + Math.abs(n.y) * LABEL) / 2;
    const x = at.x + n.x * away, y = at.y + n.y * away;
    const own = {text: one.text, left: x - one.wide / 2, right: x + one.wide / 2, low: y - LABEL / 2, high: y + LABEL / 2};
    if (Math.max(-own.left, own.right) > host.clientWidth / 2 || Math.max(-own.low, own.high) > renderer.domElement.clientHeight / 2) return false;
    if (placed.some((other) => own.left < other.right + 4 && own.right > other.left - 4 && own.low < other.high && own.high > other.low)) return false;
    one.sprite.position.copy(point);
    one.sprite.center.set(0.5 - n.x * away / one.wide, 0.5 - n.y * away / LABEL);
    placed.push(own);
    return true;
  }
  // Of the four edges along an axis the leftmost (of the vertical axis) or the lowest, and the direction away from it.
  function edgeOf(axis) {
    const others = [..."xyz"].filter((key) => key !== axis.key), edges = [];
    for (const first of ["min", "max"])
      for (const second of ["min", "max"]) {
        const corner = axis.room.min.clone();
        corner[others[0]] = axis.room[first][others[0]];
        corner[others[1]] = axis.room[second][others[1]];
        const at = (v) => { const p = corner.clone(); p[axis.key] = v; return p; };
        const from = onScreen(at(axis.low)), to = onScreen(at(axis.high));
        if (from && to) edges.push({at, from, to, order: axis.key === "y" ? from.x + to.x : from.y + to.y});
      }
    if (!edges.length) return null;
    const edge = edges.reduce((a, b) => (a.order <= b.order ? a : b));
    const across = {x: edge.from.y - edge.to.y, y: edge.to.x - edge.from.x}, length = Math.hypot(across.x, across.y) || 1;
    const middle = onScreen(axis.room.getCenter(new THREE.Vector3())) || {x: 0, y: 0};
    const outwards = across.x * (edge.from.x - middle.x) + across.y * (edge.from.y - middle.y) < 0 ? -1 : 1;
    return {at: edge.at, n: {x: outwards * across.x / length, y: outwards * across.y / length}};
  }
  // Names first, each as near to the middle of its edge as there is room; then the numbers that have room.
  function placeLabels() {
    placed = [];
    camera.updateMatrixWorld();
    const edges = axes.map(edgeOf);
    axes.forEach((axis, i) => {
      const {n, at} = edges[i] || {};
      const widest = n && Math.max(0, ...axis.ticks.map((tick) => Math.abs(n.x) * tick.wide + Math.abs(n.y) * LABEL));
      const shares = Array.from({length: 41}, (_, k) => 0.5 + (k % 2 ? 1 : -1) * Math.ceil(k / 2) / 40);
      axis.name.sprite.visible = !!n && shares.some((share) => stand(axis.name, at(axis.low + share * (axis.high - axis.low)), n, widest + 2 * GAP));
    });
    axes.forEach((axis, i) => {
      const dots = axis.marks.geometry.attributes.position;
      axis.marks.visible = !!edges[i];
      axis.ticks.forEach((tick, k) => {
        tick.sprite.visible = !!edges[i] && stand(tick, edges[i].at(tick.value), edges[i].n, GAP);
        if (edges[i]) dots.set(edges[i].at(tick.value).toArray(), 3 * k);
      });
      dots.needsUpdate = true;
    });
  }

  // Pipes: rings of vertices around a chain of nodes.
  function tube(material, coloured) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(count * SIDES * 3), 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(count * SIDES * 3), 3));
    if (coloured) geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(count * SIDES * 3), 3));
    const index = [];
    for (let i = 0; i + 1 < count; ++i)
      for (let k = 0; k < SIDES; ++k) {
        const a = i * SIDES + k, b = i * SIDES + (k + 1) % SIDES;
        index.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
      }
    geometry.setIndex(index);
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    scene.add(mesh);
    return mesh;
  }
  const axisOf = (i, axis, c) => data.frames.at(9 * i + 3 * axis + c);
  function centre(i, moves, c) {
    let value = data.position.at(3 * i + c);
    if (moves) value += state.lateral * (displacement(i, 0) * axisOf(i, 0, c) + displacement(i, 1) * axisOf(i, 1, c)) + displacement(i, 2) * axisOf(i, 2, c);
    return value;
  }
  function shape(mesh, radii, moves) {
    const position = mesh.geometry.attributes.position.array, normal = mesh.geometry.attributes.normal.array;
    const colour = mesh.geometry.attributes.color && mesh.geometry.attributes.color.array;
    for (let i = 0; i < count; ++i) {
      const radius = state.lateral * radii.at(i);
      const shade = colour && colourOf(fieldAt(i));
      for (let k = 0; k < SIDES; ++k) {
        const angle = 2 * Math.PI * k / SIDES, cos = Math.cos(angle), sin = Math.sin(angle);
        const to = 3 * (i * SIDES + k);
        for (let c = 0; c < 3; ++c) {
          const n = cos * axisOf(i, 0, c) + sin * axisOf(i, 1, c);
          normal[to + c] = n;
          position[to + c] = centre(i, moves, c) + radius * n;
        }
        if (shade) { colour[to] = shade.r; colour[to + 1] = shade.g; colour[to + 2] = shade.b; }
      }
    }
    for (const attribute of Object.values(mesh.geometry.attributes)) attribute.needsUpdate = true;
  }

  const parts = {};
  if (SCENE.kind === "string") {
    parts.bore = tube(new THREE.MeshLambertMaterial({color: 0xb9c2d0, side: THREE.DoubleSide, transparent: true, opacity: 0.28, depthWrite: false}), false);
    parts.string = tube(new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide}), true);
    const arrows = new THREE.BufferGeometry();
    arrows.setAttribute("position", new THREE.BufferAttribute(new Float32Array(count * 6), 3));
    parts.forces = new THREE.LineSegments(arrows, new THREE.LineBasicMaterial({color: 0xD55E00}));
    parts.forces.frustumCulled = false;
    scene.add(parts.forces);
  } else {
    const points = new THREE.BufferGeometry();
    points.setAttribute("position", new THREE.BufferAttribute(new Float32Array(count * 3), 3));
    points.setAttribute("color", new THREE.BufferAttribute(new Float32Array(count * 3), 3));
    points.setIndex(Array.from(data.links.numbers));
    parts.lines = new THREE.LineSegments(points, new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors}));
    const dots = new THREE.BufferGeometry();
    dots.setAttribute("position", points.attributes.position);
    dots.setAttribute("color", points.attributes.color);
    parts.dots = new THREE.Points(dots, new THREE.PointsMaterial({size: 6, sizeAttenuation: false, vertexColors: THREE.VertexColors}));
    const rest = new THREE.BufferGeometry();
    rest.setAttribute("position", new THREE.BufferAttribute(new Float32Array(data.position.numbers), 3));
    rest.setIndex(Array.from(data.links.numbers));
    parts.rest = new THREE.LineSegments(rest, new THREE.LineBasicMaterial({color: 0xb9c2d0}));
    for (const one of Object.values(parts)) { one.frustumCulled = false; scene.add(one); }
  }
  const force = fields.find((f) => f.name === "force");

  function drawString() {
    shape(parts.string, data.radius, true);
    const to = parts.forces.geometry.attributes.position.array;
    to.fill(0);
    for (let i = 0; force && state.forces && i < count; ++i) {
      const size_ = (state.sample < 0 || !force.motion ? force.rest.at(i) : force.motion.at(state.sample * count + i)) / force.largest;
      const u = displacement(i, 0), v = displacement(i, 1), r = Math.hypot(u, v);
      if (!(size_ > 0) || r === 0) continue;
      for (let c = 0; c < 3; ++c) {
        const outwards = (u * axisOf(i, 0, c) + v * axisOf(i, 1, c)) / r;
        const wall = data.position.at(3 * i + c) + state.lateral * data.bore.at(i) * outwards;
        to[6 * i + c] = wall;
        to[6 * i + 3 + c] = wall + 0.1 * size * size_ * outwards;
      }
    }
    parts.forces.geometry.attributes.position.needsUpdate = true;
  }
  function drawParts() {
    const position = parts.dots.geometry.attributes.position.array, colour = parts.dots.geometry.attributes.color.array;
    for (let i = 0; i < count; ++i) {
      const shade = colourOf(fieldAt(i));
      for (let c = 0; c < 3; ++c) position[3 * i + c] = data.position.at(3 * i + c) + state.lateral * displacement(i, c);
      colour[3 * i] = shade.r; colour[3 * i + 1] = shade.g; colour[3 * i + 2] = shade.b;
    }
    parts.dots.geometry.attributes.position.needsUpdate = parts.dots.geometry.attributes.color.needsUpdate = true;
  }
  function draw() {
    if (SCENE.kind === "string") drawString(); else drawParts();
    render();
  }
  function render() {
    placeLabels();
    renderer.render(scene, camera);
  }

  // What the reader turns.
  const byId = (id) => document.getElementById(id);
  const number = (value) => value.toPrecision(3).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  function showTime() {
    byId("view-time").textContent = byId("view-legend-time").textContent = state.sample < 0 ? "at rest" : data.time.at(state.sample).toFixed(3) + " s";
  }
  function setSample(sample) {
    state.sample = sample;
    if (samples) byId("view-slider").value = sample;
    showTime();
    draw();
  }
  function setScale(value) {
    state.lateral = value;
    byId("view-scale-text").textContent = number(value) + " x";
    if (parts.bore) shape(parts.bore, data.bore, false);
    draw();
  }
  function showKey() {
    const f = fields[state.field];
    byId("view-key").hidden = byId("view-legend").hidden = !f;
    if (!f) return;
    const stops = SCENE.colours.filter((_, i) => i % 7 === 0).map((c) => "rgb(" + c.map((x) => Math.round(255 * x)).join(",") + ")");
    for (const bar of document.querySelectorAll(".bar")) bar.style.background = "linear-gradient(to right," + stops.join(",") + ")";
    byId("view-most").textContent = byId("view-legend-most").textContent = number(f.largest) + " " + f.unit;
    byId("view-legend-field").textContent = f.label;
  }
  function look(target, distance) {
    controls.target.copy(target);
    const from = SCENE.kind === "string" ? new THREE.Vector3(0.75, 0.3, 0.85) : new THREE.Vector3(0.6, 0.4, 0.9);
    camera.position.copy(target).addScaledVector(from.normalize(), distance);
    camera.near = distance * 1e-3;
    camera.far = distance * 100 + 10 * size;
    camera.updateProjectionMatrix();
    controls.update();
    render();
  }
  function lookAtAll() {
    const narrow = Math.min(1, camera.aspect);
    const height = renderer.domElement.clientHeight;
    look(box.getCenter(new THREE.Vector3()), 1.85 * size / narrow * height / (height - 6 * LABEL));  // numbers and names have room above and below
  }
  function lookAtDepth(depth) {
    let i = 0;
    while (i + 1 < count && data.depth.at(i) < depth) ++i;
    look(new THREE.Vector3(data.position.at(3 * i), data.position.at(3 * i + 1), data.position.at(3 * i + 2)), Math.max(30 * state.lateral * data.bore.at(i), 0.02 * size));
  }
  function fit() {
    const width = host.clientWidth, height = Math.max(300, Math.min(560, Math.round(0.75 * width)));
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    // a sprite of size 1 fills the view at the distance 1, whose height is 2 tan(fov / 2)
    const unit = LABEL / height * 2 * Math.tan(camera.fov * Math.PI / 360);
    for (const axis of axes) for (const one of [axis.name, ...axis.ticks]) one.sprite.scale.set(unit * one.wide / LABEL, unit, 1);
    render();
  }

  // A bore a hundredth of the picture wide; displacements of parts a twentieth of it.
  let largest = 1e-12;
  if (SCENE.kind === "string") for (let i = 0; i < count; ++i) largest = Math.max(largest, data.bore.at(i));
  else for (const values of [data.rest, data.motion]) if (values) for (let i = 0; i < values.numbers.length; ++i) largest = Math.max(largest, Math.abs(values.at(i)));
  const natural = (SCENE.kind === "string" ? 0.012 : 0.06) * size / largest;
  const slider = byId("view-scale");
  slider.value = Math.max(0, Math.min(100, 20 * Math.log10(Math.max(1, natural))));
  slider.addEventListener("input", () => setScale(Math.pow(10, slider.value / 20)));
  const choice = byId("view-field");
  fields.forEach((f, i) => choice.add(new Option(f.label + " [" + f.unit + "]", i)));
  choice.addEventListener("change", () => { state.field = +choice.value; showKey(); draw(); });
  const places = byId("view-place");
  places.add(new Option("everything", -1));
  (SCENE.places || []).forEach((p, i) => places.add(new Option(p[0], i)));
  places.addEventListener("change", () => { if (+places.value < 0) lookAtAll(); else lookAtDepth(SCENE.places[+places.value][1]); });
  const timing = byId("view-slider");
  timing.max = samples - 1;
  timing.addEventListener("input", () => { state.playing = false; showPlay(); setSample(+timing.value); });
  byId("view-motion").hidden = samples === 0;
  byId("view-rest").addEventListener("click", () => { state.playing = false; showPlay(); setSample(-1); });
  function showPlay() { byId("view-play").textContent = state.playing ? "pause" : "play"; }
  byId("view-play").addEventListener("click", () => {
    state.playing = !state.playing;
    if (state.playing && state.sample >= samples - 1) state.sample = -1;
    showPlay();
    let before = null;
    const start = {time: state.sample < 0 ? data.time.at(0) : data.time.at(state.sample)};
    function advance(now) {
      if (!state.playing) return;
      if (before === null) before = now;
      const time = start.time + (now - before) / 1000 * byId("view-speed").value;
      let next = Math.max(0, state.sample);
      while (next + 1 < samples && data.time.at(next + 1) <= time) ++next;
      if (next !== state.sample) setSample(next);
      if (next >= samples - 1) { state.playing = false; showPlay(); return; }
      requestAnimationFrame(advance);
    }
    requestAnimationFrame(advance);
  });
  if (byId("view-forces")) byId("view-forces").addEventListener("change", (event) => { state.forces = event.target.checked; draw(); });
  controls.addEventListener("change", render);
  window.addEventListener("resize", fit);

  addAxes();
  fit();
  showKey();
  setScale(Math.pow(10, slider.value / 20));
  showTime();
  lookAtAll();
  host.labels = () => placed;
  document.body.dataset.view = "drawn";
})();
