"use strict";
// 3-D view: draws room_lit.glb with WebGL 2 and shows the irradiance of the tile under the pointer.
//
// Reads only the subset of glTF that lichtmc writes: no transforms but the offset of a room far from the origin, which
// moves everything alike and is left out; one buffer, triangles with a tile map as texture, or
// lines with colours. This keeps the page small and without third-party code.
function lichtmcView(container, glb) {
  const canvas = container.appendChild(document.createElement("canvas"));
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) {
    container.textContent = "This browser does not support WebGL 2. The pictures above show the same results.";
    container.dataset.state = "unavailable";
    return;
  }

  // ---- the file
  const words = new DataView(glb);
  const jsonLength = words.getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(new Uint8Array(glb, 20, jsonLength)));
  const binary = 28 + jsonLength;
  const bytesOf = index => {
    const view = gltf.bufferViews[index];
    return [binary + (view.byteOffset || 0), view.byteLength];
  };
  const floats = index => new Float32Array(glb, bytesOf(index)[0], bytesOf(index)[1] / 4);
  const accessor = index => floats(gltf.accessors[index].bufferView);
  const indices = index => {
    const [start, length] = bytesOf(gltf.accessors[index].bufferView);
    return new Uint32Array(glb, start, length / 4);
  };
  const parts = [];
  const emitters = [];
  for (const node of gltf.nodes) {
    if (node.extras?.lichtmc?.kind === "emitter") emitters.push({ ...node.extras.lichtmc, place: node.translation });
    if (node.mesh === undefined) continue;
    for (const primitive of gltf.meshes[node.mesh].primitives) {
      const material = gltf.materials[primitive.material];
      parts.push({
        lines: primitive.mode === 1,
        transparent: material.alphaMode === "BLEND",
        twoSided: material.doubleSided === true,
        tint: material.pbrMetallicRoughness.baseColorFactor || [1, 1, 1, 1],
        texture: material.pbrMetallicRoughness.baseColorTexture?.index,
        numbers: material.extras?.lichtmc,
        positions: accessor(primitive.attributes.POSITION),
        uvs: primitive.attributes.TEXCOORD_0 === undefined ? null : accessor(primitive.attributes.TEXCOORD_0),
        colours: primitive.attributes.COLOR_0 === undefined ? null : accessor(primitive.attributes.COLOR_0),
        indices: primitive.indices === undefined ? null : indices(primitive.indices),
      });
    }
  }

  // ---- shaders, buffers and textures
  const program = gl.createProgram();
  const shader = (kind, source) => {
    const one = gl.createShader(kind);
    gl.shaderSource(one, "#version 300 es\nprecision highp float;\n" + source);
    gl.compileShader(one);
    gl.attachShader(program, one);
  };
  shader(gl.VERTEX_SHADER, `
    uniform mat4 view; in vec3 position; in vec2 place; in vec3 colour; out vec2 at; out vec3 light;
    void main() { at = place; light = colour; gl_Position = view * vec4(position, 1.0); }`);
  shader(gl.FRAGMENT_SHADER, `
    uniform sampler2D picture; uniform int kind; uniform vec4 tint; in vec2 at; in vec3 light; out vec4 pixel;
    void main() {
      // Textures are in sRGB already; the colours of lines are linear.
      if (kind == 0) pixel = vec4(texture(picture, at).rgb, 1.0);
      else if (kind == 1) pixel = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
      else pixel = tint;
    }`);
  for (const [place, name] of ["position", "place", "colour"].entries()) gl.bindAttribLocation(program, place, name);
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = name => gl.getUniformLocation(program, name);
  const attribute = (place, size, data) => {
    if (!data) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  };
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const part of parts) {
    part.vertices = gl.createVertexArray();
    gl.bindVertexArray(part.vertices);
    attribute(0, 3, part.positions);
    attribute(1, 2, part.uvs);
    attribute(2, 3, part.colours);
    if (part.indices) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, part.indices, gl.STATIC_DRAW);
    }
    if (part.lines || part.transparent) continue;
    for (let k = 0; k < part.positions.length; ++k) {
      low[k % 3] = Math.min(low[k % 3], part.positions[k]);
      high[k % 3] = Math.max(high[k % 3], part.positions[k]);
    }
  }
  const textures = (gltf.textures || []).map(({ source }) => {
    const [start, length] = bytesOf(gltf.images[source].bufferView);
    const texture = gl.createTexture();
    const decoding = createImageBitmap(new Blob([new Uint8Array(glb, start, length)], { type: "image/png" }),
      { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    const ready = decoding.then(image => {
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, gl.RGB, gl.UNSIGNED_BYTE, image);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);  // a tile has one uniform colour
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    });
    return { texture, ready };
  });

  // ---- the camera: on a sphere about a target
  const size = Math.hypot(...high.map((h, k) => h - low[k])) || 1;
  const field = 0.6;  // rad, vertical field of view
  const start = () => ({ yaw: 0.5, pitch: 0.7, distance: 0.54 * size / Math.tan(field / 2), target: low.map((l, k) => (l + high[k]) / 2) });
  let eye = start();
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const frame = () => {
    const { yaw, pitch, distance, target } = eye;
    const back = [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
    const right = [Math.cos(yaw), 0, -Math.sin(yaw)];
    const up = cross(back, right);
    return { back, right, up, place: target.map((t, k) => t + distance * back[k]) };
  };
  const viewMatrix = ({ back, right, up, place }) => {
    const f = 1 / Math.tan(field / 2);
    const aspect = canvas.width / canvas.height;
    const near = Math.max(eye.distance - size, 0.002 * size);
    const far = eye.distance + size;
    const a = -(far + near) / (far - near);
    const b = -2 * far * near / (far - near);
    const row = (axis, factor) => [...axis.map(x => x * factor), -factor * dot(axis, place)];
    const depth = row(back, 1);
    const rows = [row(right, f / aspect), row(up, f), depth.map((d, k) => a * d + (k === 3 ? b : 0)), depth.map(d => -d)];
    return [0, 1, 2, 3].flatMap(column => rows.map(r => r[column]));
  };

  // ---- drawing, only after a change
  const bar = container.appendChild(document.createElement("div"));
  bar.className = "bar";
  const reset = bar.appendChild(document.createElement("button"));
  reset.type = "button";
  reset.textContent = "Reset view";
  reset.addEventListener("click", () => { eye = start(); redraw(); });
  let showPaths = true;
  if (parts.some(part => part.lines)) {
    const label = bar.appendChild(document.createElement("label"));
    const box = label.appendChild(document.createElement("input"));
    box.type = "checkbox";
    box.checked = true;
    label.append(" photon paths");
    box.addEventListener("change", () => { showPaths = box.checked; redraw(); });
  }
  const readout = container.appendChild(document.createElement("div"));
  readout.className = "readout";
  for (const emitter of emitters) {
    emitter.mark = container.appendChild(document.createElement("div"));
    emitter.mark.className = "emitter";
  }
  let background = [1, 1, 1];
  const readBackground = () => {
    const hex = getComputedStyle(container).getPropertyValue("--picture-background").trim().match(/^#([0-9a-f]{6})$/i);
    if (hex) background = [0, 2, 4].map(k => parseInt(hex[1].slice(k, k + 2), 16) / 255);
  };
  const draw = () => {
    const pose = frame();
    const matrix = viewMatrix(pose);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.uniformMatrix4fv(uniform("view"), false, matrix);
    gl.cullFace(gl.BACK);
    // Transparent parts come last.
    for (const part of [...parts.filter(p => !p.transparent), ...parts.filter(p => p.transparent)]) {
      if (part.lines && !showPaths) continue;
      gl.bindVertexArray(part.vertices);
      (part.twoSided || part.lines ? gl.disable : gl.enable).call(gl, gl.CULL_FACE);
      (part.transparent ? gl.enable : gl.disable).call(gl, gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(!part.transparent);
      gl.uniform1i(uniform("kind"), part.lines ? 1 : part.texture === undefined ? 2 : 0);
      gl.uniform4fv(uniform("tint"), part.tint);
      if (part.texture !== undefined) gl.bindTexture(gl.TEXTURE_2D, textures[part.texture].texture);
      if (part.indices) gl.drawElements(gl.TRIANGLES, part.indices.length, gl.UNSIGNED_INT, 0);
      else gl.drawArrays(part.lines ? gl.LINES : gl.TRIANGLES, 0, part.positions.length / 3);
    }
    gl.depthMask(true);
    for (const emitter of emitters) {
      const p = [...emitter.place, 1];
      const [x, y, , w] = [0, 1, 2, 3].map(r => p.reduce((sum, c, k) => sum + matrix[4 * k + r] * c, 0));
      emitter.mark.style.display = w > 0 ? "" : "none";
      emitter.mark.style.left = `${(50 + 50 * x / w).toFixed(2)}%`;
      emitter.mark.style.top = `${(50 - 50 * y / w).toFixed(2)}%`;
    }
  };
  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  };

  // ---- the tile under the pointer: intersection with the nearest visible triangle (T. Möller, B. Trumbore, Fast,
  // Minimum Storage Ray/Triangle Intersection, 1997)
  const find = (x, y) => {
    const { back, right, up, place } = frame();
    const scale = Math.tan(field / 2);
    const across = (2 * x / canvas.clientWidth - 1) * scale * canvas.clientWidth / canvas.clientHeight;
    const along = (1 - 2 * y / canvas.clientHeight) * scale;
    const ray = back.map((b, k) => -b + across * right[k] + along * up[k]);
    let nearest = Infinity;
    let found = null;
    for (const part of parts) {
      if (part.lines || part.transparent) continue;
      const p = part.positions;
      for (let k = 0; k < part.indices.length; k += 3) {
        const [i, j, l] = [3 * part.indices[k], 3 * part.indices[k + 1], 3 * part.indices[k + 2]];
        const e1x = p[j] - p[i], e1y = p[j + 1] - p[i + 1], e1z = p[j + 2] - p[i + 2];
        const e2x = p[l] - p[i], e2y = p[l + 1] - p[i + 1], e2z = p[l + 2] - p[i + 2];
        const hx = ray[1] * e2z - ray[2] * e2y, hy = ray[2] * e2x - ray[0] * e2z, hz = ray[0] * e2y - ray[1] * e2x;
        const area = e1x * hx + e1y * hy + e1z * hz;
        if (area === 0 || (area < 0 && !part.twoSided)) continue;
        const sx = place[0] - p[i], sy = place[1] - p[i + 1], sz = place[2] - p[i + 2];
        const u = (sx * hx + sy * hy + sz * hz) / area;
        if (u < 0 || u > 1) continue;
        const qx = sy * e1z - sz * e1y, qy = sz * e1x - sx * e1z, qz = sx * e1y - sy * e1x;
        const v = (ray[0] * qx + ray[1] * qy + ray[2] * qz) / area;
        const distance = (e2x * qx + e2y * qy + e2z * qz) / area;
        if (v < 0 || u + v > 1 || distance <= 0 || distance >= nearest) continue;
        nearest = distance;
        found = { part, k, u, v };
      }
    }
    return found;
  };
  const digits = value => Number(value.toPrecision(3)).toString();
  const describe = ({ part, k, u, v }) => {
    const { surface, unit, columns, rows, irradiance, standard_error } = part.numbers;
    const at = axis => {
      const [a, b, c] = [0, 1, 2].map(n => part.uvs[2 * part.indices[k + n] + axis]);
      return a + u * (b - a) + v * (c - a);
    };
    const column = Math.min(columns - 1, Math.max(0, Math.floor(at(0) * columns)));
    const row = Math.min(rows - 1, Math.max(0, Math.floor(at(1) * rows)));
    const value = floats(irradiance)[row * columns + column];
    const error = floats(standard_error)[row * columns + column];
    if (Number.isNaN(value)) return `${surface}: no tile here`;
    const name = unit === "W/m^2" ? "W/m²" : unit;
    const accuracy = Number.isNaN(error) ? "error unknown" : `± ${digits(error)} ${name}`;
    return `${surface}: ${digits(value)} ${name} ${accuracy} (column ${column}, row ${row})`;
  };
  let pointer = null;
  const read = event => {
    const box = canvas.getBoundingClientRect();
    if (pointer === null) requestAnimationFrame(() => {
      const found = find(...pointer);
      pointer = null;
      readout.textContent = found ? describe(found) : "";
    });
    pointer = [event.clientX - box.left, event.clientY - box.top];
  };

  // ---- input
  const rotate = (x, y) => {
    eye.yaw -= 0.008 * x;
    eye.pitch = Math.min(1.55, Math.max(-1.55, eye.pitch + 0.008 * y));
  };
  const move = (x, y) => {
    const { right, up } = frame();
    const metres = 2 * eye.distance * Math.tan(field / 2) / canvas.clientHeight;
    eye.target = eye.target.map((t, k) => t + metres * (y * up[k] - x * right[k]));
  };
  const zoom = factor => { eye.distance = Math.min(20 * size, Math.max(0.01 * size, eye.distance * factor)); };
  const pointers = new Map();
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  for (const kind of ["pointerup", "pointercancel"])
    canvas.addEventListener(kind, event => pointers.delete(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    const before = pointers.get(event.pointerId);
    if (!before) return read(event);
    const [x, y] = [event.clientX - before[0], event.clientY - before[1]];
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const distance = point => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
      zoom(distance(before) / distance([event.clientX, event.clientY]));
      move(x / 2, y / 2);
    } else if (event.shiftKey || event.buttons & 2) {
      move(x, y);
    } else {
      rotate(x, y);
    }
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    redraw();
  });
  canvas.addEventListener("pointerleave", () => { readout.textContent = ""; });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(0.001 * event.deltaY));
    redraw();
  }, { passive: false });
  container.addEventListener("keydown", event => {
    const keys = {
      ArrowLeft: () => rotate(12, 0), ArrowRight: () => rotate(-12, 0), ArrowUp: () => rotate(0, 12), ArrowDown: () => rotate(0, -12),
      "+": () => zoom(0.9), "-": () => zoom(1.1), Home: () => { eye = start(); },
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
    redraw();
  });

  const fit = () => {
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    draw();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readBackground(); redraw(); });
  readBackground();
  Promise.all(textures.map(({ ready }) => ready)).then(() => {
    new ResizeObserver(fit).observe(canvas);
    fit();
    container.dataset.state = "ready";
  });
}
