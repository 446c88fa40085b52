/* The page's view: what is chosen, drawn by Plotly and on a canvas. */
"use strict";

(() => {
  const POINTS = 200;
  const BOX = 1.7;
  const CUT = "rgb(204, 13, 13)";
  const data = JSON.parse(document.getElementById("scenes").textContent);
  const element = (id) => document.getElementById(id);
  const controls = ["shape", "map", "channel", "longitude", "latitude", "turn", "size"];
  let shown = null;

  function unpacked(text, type) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new type(bytes.buffer);
  }

  function fill(select, names) {
    const before = select.value;
    select.replaceChildren(...names.map((name) => new Option(name, name)));
    if (names.includes(before)) select.value = before;
  }

  /* Numbers of a scene, unpacked once. */
  const unpackedScenes = new Map();
  function sceneOf(name) {
    if (!unpackedScenes.has(name)) {
      const packed = data.scenes.find((one) => one.name === name);
      const faces = unpacked(packed.faces, Uint32Array);
      const maps = {}, channels = {};
      for (const map of packed.maps)
        maps[map.name] = {
          ...map,
          sphere: unpacked(map.sphere, Float32Array),
          ratio: unpacked(map.ratio, Float32Array),
        };
      for (const channel of packed.channels)
        channels[channel.name] = unpacked(channel.values, Float32Array);
      unpackedScenes.set(name, {
        name, faces, maps, channels,
        note: packed.note,
        vertices: unpacked(packed.vertices, Float32Array),
        across: GeometryImage.neighbours(faces),
      });
    }
    return unpackedScenes.get(name);
  }

  function valuesOf(scene, map, channel) {
    return channel === data.ratio ? map.ratio : scene.channels[channel];
  }

  function scaleOf(channel, values) {
    let low = Infinity, high = -Infinity;
    for (const value of values) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
    const signed = data.signed.includes(channel);
    if (signed) [low, high] = [-Math.max(-low, high), Math.max(-low, high)];
    if (!(high > low)) high = low + 1;
    return { low, high, colours: signed ? data.diverging : data.sequential };
  }

  function column(array, offset) {
    return Array.from({ length: array.length / 3 }, (_, i) => array[3 * i + offset]);
  }

  function surface(points, faces, values, scale) {
    return {
      type: "mesh3d",
      x: column(points, 0), y: column(points, 1), z: column(points, 2),
      i: column(faces, 0), j: column(faces, 1), k: column(faces, 2),
      intensity: Array.from(values), cmin: scale.low, cmax: scale.high,
      colorscale: scale.colours.map((rgb, n) => [n / (scale.colours.length - 1), `rgb(${rgb})`]),
      showscale: false, hoverinfo: "skip",
      lighting: { ambient: 0.75, diffuse: 0.4, specular: 0.05 },
    };
  }

  function line(paths) {
    const gaps = [[], [], []];
    for (const path of paths)
      for (let k = 0; k < 3; k++) gaps[k].push(...column(path, k), null);
    return {
      type: "scatter3d", mode: "lines", hoverinfo: "skip", showlegend: false,
      x: gaps[0], y: gaps[1], z: gaps[2], line: { color: CUT, width: 6 },
    };
  }

  /* Lengths of the sides of a box that fills a plot, in the proportions of some points. */
  function proportions(points) {
    const sides = [0, 1, 2].map((k) => {
      let low = Infinity, high = -Infinity;
      for (let i = k; i < points.length; i += 3) {
        low = Math.min(low, points[i]);
        high = Math.max(high, points[i]);
      }
      return high - low;
    });
    const [x, y, z] = sides.map((side) => (BOX * side) / Math.max(...sides));
    return { x, y, z };
  }

  function draw(id, points, traces, revision) {
    const hidden = { visible: false };
    Plotly.react(element(id), traces, {
      autosize: true, margin: { l: 0, r: 0, t: 0, b: 0 }, uirevision: revision,
      scene: {
        xaxis: hidden, yaxis: hidden, zaxis: hidden, uirevision: revision,
        aspectmode: "manual", aspectratio: proportions(points),
        camera: {
          eye: { x: 0, y: 0, z: 1.6 }, up: { x: 0, y: 1, z: 0 },
          projection: { type: "orthographic" },
        },
      },
    }, { responsive: true, displayModeBar: false });
  }

  function drawImage(canvas, values, size, scale) {
    canvas.width = canvas.height = size;
    const context = canvas.getContext("2d");
    const picture = context.createImageData(size, size);
    const last = scale.colours.length - 1;
    for (let i = 0; i < values.length; i++) {
      const share = (values[i] - scale.low) / (scale.high - scale.low);
      const colour = scale.colours[Math.round(last * Math.min(Math.max(share, 0), 1))];
      picture.data.set([...colour, 255], 4 * i);
    }
    context.putImageData(picture, 0, 0);
  }

  function update(everything) {
    const scene = sceneOf(element("shape").value);
    if (everything) {
      fill(element("map"), Object.keys(scene.maps));
      fill(element("channel"), [...Object.keys(scene.channels), data.ratio]);
    }
    const map = scene.maps[element("map").value];
    const channel = element("channel").value;
    const values = valuesOf(scene, map, channel);
    const scale = scaleOf(channel, values);
    const radians = (id) => (Number(element(id).value) * Math.PI) / 180;
    const rotation = GeometryImage.cut(radians("longitude"), radians("latitude"), radians("turn"));
    const size = Number(element("size").value);

    const pixels = GeometryImage.turnedBack(rotation, GeometryImage.pixelDirections(size));
    const located = GeometryImage.locate(map.sphere, scene.faces, scene.across, pixels);
    drawImage(
      element("image"), GeometryImage.interpolate(located, scene.faces, values, 1), size, scale,
    );

    const onSphere = GeometryImage.cutEdges(POINTS).map(
      (edge) => GeometryImage.turnedBack(rotation, edge),
    );
    const onMesh = onSphere.map((edge) => GeometryImage.interpolate(
      GeometryImage.locate(map.sphere, scene.faces, scene.across, edge),
      scene.faces, scene.vertices, 3,
    ));
    const lifted = onSphere.map((edge) => edge.map((value) => 1.01 * value));
    draw("mesh", scene.vertices, [surface(scene.vertices, scene.faces, values, scale), line(onMesh)], scene.name);
    draw("sphere", map.sphere, [surface(map.sphere, scene.faces, values, scale), line(lifted)], scene.name);

    element("note").textContent =
      `${scene.note}; ${scene.vertices.length / 3} vertices; area ratios of the map: standard ` +
      `deviation ${map.std.toPrecision(2)}, ${map.flips} flipped faces; colours from ` +
      `${scale.low.toPrecision(3)} to ${scale.high.toPrecision(3)}`;
    for (const id of ["longitude", "latitude", "turn"])
      element(`${id}-value`).textContent = `${element(id).value}°`;
  }

  function schedule(everything) {
    if (shown !== null) cancelAnimationFrame(shown.frame);
    const all = everything || (shown !== null && shown.everything);
    const frame = requestAnimationFrame(() => {
      shown = null;
      update(all);
    });
    shown = { frame, everything: all };
  }

  if (data.scenes.length) {
    fill(element("shape"), data.scenes.map((scene) => scene.name));
    for (const id of controls)
      element(id).addEventListener("input", () => schedule(id === "shape"));
    update(true);
    document.body.dataset.view = "ready";
  }
})();
