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

  // The box around the model with ticks on three edges.
  const labels = [];
  function label(text, position, align) {
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("2d");
    const high = 44;
    context.font = high * 0.8 + "px sans-serif";
    canvas.width = Math.ceil(context.measureText(text).width) + 8;
    canvas.height = high;
    context.font = high * 0.8 + "px sans-serif";
    context.fillStyle = "#444444";
    context.fillText(text, 4, high * 0.78);
    const material = new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false});
    material.map.minFilter = THREE.LinearFilter;
    const sprite = new THREE.Sprite(material);
    sprite.userData.ratio = canvas.width / high;
    labels.push(sprite);
    sprite.position.copy(position);
    sprite.center.set(align, 0.5);
    scene.add(sprite);
  }
  function niceStep(length) {
    const raw = length / 4, power = Math.pow(10, Math.floor(Math.log10(raw)));
    return power * (raw / power > 5 ? 10 : raw / power > 2 ? 5 : raw / power > 1 ? 2 : 1);
  }
  function addAxes() {
    const isString = SCENE.kind === "string";
    const low = box.min.clone().subScalar(0.06 * size), high = box.max.clone().addScalar(0.06 * size);
    const frame = new THREE.Box3Helper(new THREE.Box3(low, high), 0xc8ccd4);
    scene.add(frame);
    const names = isString ? ["east [m]", "depth [m]", "north [m]"] : ["x [m]", "z [m]", "y [m]"];
    const points = [];
    const digits = (step) => Math.max(0, Math.min(3, -Math.floor(Math.log10(step))));
    for (let axis = 0; axis < 3; ++axis) {
      const key = "xyz"[axis], length = high[key] - low[key], step = niceStep(Math.max(length, size / 3));
      const sign = axis === 0 ? 1 : axis === 1 ? (isString ? -1 : 1) : -1;
      const corner = new THREE.Vector3(low.x, low.y, high.z);
      const out = new THREE.Vector3(axis === 0 ? 0 : -0.02 * size, axis === 1 ? 0 : -0.02 * size, 0);
      const place = (v) => { const p = corner.clone(); p[key] = v; return p; };
      for (let v = Math.ceil(low[key] / step) * step; v <= high[key]; v += step) {
        if (isString && axis === 1 && v > 1e-9 * size) continue;
        if (length < 0.25 * size) break;  // the box is too narrow there for numbers beside each other
        const at = place(v);
        points.push(at, at.clone().add(out));
        label((sign * v + 0).toFixed(digits(step)).replace(/^-(0(\.0+)?)$/, "$1"), at.clone().addScaledVector(out, 1.6), axis === 0 ? 0.5 : 1);
      }
      const away = [new THREE.Vector3(0, -0.075, 0), new THREE.Vector3(-0.14, 0, 0), new THREE.Vector3(-0.1, -0.1, 0)][axis];
      label(names[axis], place((low[key] + high[key]) / 2).addScaledVector(away, size), axis === 0 ? 0.5 : 1);
    }
    scene.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(points), new THREE.LineBasicMaterial({color: 0x8a8a8a})));
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
    renderer.render(scene, camera);
  }

  // What the reader turns.
  const byId = (id) => document.getElementById(id);
  const number = (value) => value.toPrecision(3).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
  function showTime() {
    byId("view-time").textContent = state.sample < 0 ? "at rest" : data.time.at(state.sample).toFixed(3) + " s";
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
    byId("view-key").hidden = !f;
    if (!f) return;
    const stops = SCENE.colours.filter((_, i) => i % 7 === 0).map((c) => "rgb(" + c.map((x) => Math.round(255 * x)).join(",") + ")");
    byId("view-bar").style.background = "linear-gradient(to right," + stops.join(",") + ")";
    byId("view-most").textContent = number(f.largest) + " " + f.unit;
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
    look(box.getCenter(new THREE.Vector3()), 1.85 * size / narrow);
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
    for (const sprite of labels) sprite.scale.set(unit * sprite.userData.ratio, unit, 1);
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
  document.body.dataset.view = "drawn";
})();
