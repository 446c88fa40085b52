/* Geometry images in a reader's browser: the arithmetic of gipkg.images, and nothing of the page.

   The sphere is cut along the four edges of an octahedron that meet at the south pole and laid on
   the square [-1, 1]²; areas are kept. Matrices are arrays of nine numbers, row by row. */
"use strict";

const GeometryImage = (() => {
  /* Unit vector of a point of the square (gipkg.images.octahedron.square_to_sphere). */
  function squareToSphere(u, v) {
    let a = Math.abs(u), b = Math.abs(v);
    const south = a + b > 1;
    if (south) [a, b] = [1 - b, 1 - a];
    const r = a + b;
    const quarter = Math.PI / 2;
    const rho = r * Math.sqrt(Math.max(2 - r * r, 0));
    const x = r > 0 ? rho * Math.sin((a / r) * quarter) : 0;
    const y = r > 0 ? rho * Math.sin((b / r) * quarter) : 0;
    const z = 1 - r * r;
    return [u < 0 ? -x : x, v < 0 ? -y : y, south ? -z : z];
  }

  /* Directions of the pixels of an image of size x size, row 0 on top. */
  function pixelDirections(size) {
    const directions = new Float64Array(3 * size * size);
    for (let row = 0; row < size; row++) {
      for (let column = 0; column < size; column++) {
        const u = (2 * column - (size - 1)) / (size - 1);
        const v = -(2 * row - (size - 1)) / (size - 1);
        directions.set(squareToSphere(u, v), 3 * (row * size + column));
      }
    }
    return directions;
  }

  /* Rotation that brings the direction at a longitude and latitude to the north pole and then
     turns about it; angles in radians. */
  function cut(longitude, latitude, turn) {
    const tilt = Math.PI / 2 - latitude;
    return product(aboutZ(turn), product(aboutY(-tilt), aboutZ(-longitude)));
  }

  function aboutZ(angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [c, -s, 0, s, c, 0, 0, 0, 1];
  }

  function aboutY(angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [c, 0, s, 0, 1, 0, -s, 0, c];
  }

  function product(p, q) {
    const result = new Array(9).fill(0);
    for (let i = 0; i < 3; i++)
      for (let j = 0; j < 3; j++)
        for (let k = 0; k < 3; k++) result[3 * i + j] += p[3 * i + k] * q[3 * k + j];
    return result;
  }

  /* Turn directions back: where on the sphere is, before the rotation, what is here after it. */
  function turnedBack(rotation, directions) {
    const result = new Float64Array(directions.length);
    for (let i = 0; i < directions.length; i += 3)
      for (let j = 0; j < 3; j++)
        result[i + j] =
          rotation[j] * directions[i] +
          rotation[3 + j] * directions[i + 1] +
          rotation[6 + j] * directions[i + 2];
    return result;
  }

  /* For each of a face's edges, opposite to its corners, the face on the other side. */
  function neighbours(faces) {
    const across = new Int32Array(faces.length).fill(-1);
    const open = new Map();
    for (let i = 0; i < faces.length; i++) {
      const face = 3 * Math.floor(i / 3);
      const from = faces[face + ((i + 1) % 3)], to = faces[face + ((i + 2) % 3)];
      const twin = open.get(to * 4294967296 + from);
      if (twin === undefined) {
        open.set(from * 4294967296 + to, i);
      } else {
        across[i] = Math.floor(twin / 3);
        across[twin] = face / 3;
      }
    }
    return across;
  }

  /* Determinant of two corners and a direction: positive to the left of the edge between them. */
  function side(sphere, p, q, x, y, z) {
    const i = 3 * p, j = 3 * q;
    const a = sphere[i] - x, b = sphere[i + 1] - y, c = sphere[i + 2] - z;
    const d = sphere[j] - x, e = sphere[j + 1] - y, f = sphere[j + 2] - z;
    return x * (b * f - c * e) + y * (c * d - a * f) + z * (a * e - b * d);
  }

  /* Walk to the face of each direction, over the edge that it is farthest beyond. Where a map is
     folded the walk may not arrive: it stays at the last face after as many steps as faces. */
  function locate(sphere, faces, across, directions) {
    const count = directions.length / 3;
    const face = new Int32Array(count);
    const weights = new Float64Array(3 * count);
    let here = 0;
    for (let i = 0; i < count; i++) {
      const x = directions[3 * i], y = directions[3 * i + 1], z = directions[3 * i + 2];
      let left = faces.length / 3;
      for (;;) {
        const a = faces[3 * here], b = faces[3 * here + 1], c = faces[3 * here + 2];
        const sides = [
          side(sphere, b, c, x, y, z),
          side(sphere, c, a, x, y, z),
          side(sphere, a, b, x, y, z),
        ];
        let least = 0;
        if (sides[1] < sides[least]) least = 1;
        if (sides[2] < sides[least]) least = 2;
        left -= 1;
        if (sides[least] >= 0 || left < 0) {
          const clipped = sides.map((value) => Math.max(value, 0));
          const total = clipped[0] + clipped[1] + clipped[2] || 1;
          for (let k = 0; k < 3; k++) weights[3 * i + k] = clipped[k] / total;
          face[i] = here;
          break;
        }
        here = across[3 * here + least];
      }
    }
    return { face, weights };
  }

  /* Values at located points, linear within a face; `stride` numbers a vertex. */
  function interpolate(located, faces, values, stride) {
    const { face, weights } = located;
    const result = new Float64Array(face.length * stride);
    for (let i = 0; i < face.length; i++)
      for (let corner = 0; corner < 3; corner++)
        for (let k = 0; k < stride; k++)
          result[i * stride + k] +=
            weights[3 * i + corner] * values[faces[3 * face[i] + corner] * stride + k];
    return result;
  }

  /* The four edges that are opened, from the south pole to the equator: points of each. */
  function cutEdges(points) {
    return [[1, 0], [0, 1], [-1, 0], [0, -1]].map(([x, y]) => {
      const path = new Float64Array(3 * points);
      for (let i = 0; i < points; i++) {
        const share = i / (points - 1);
        const length = Math.hypot(share, 1 - share);
        path.set([(share * x) / length, (share * y) / length, (share - 1) / length], 3 * i);
      }
      return path;
    });
  }

  return { squareToSphere, pixelDirections, cut, turnedBack, neighbours, locate, interpolate, cutEdges };
})();

if (typeof module !== "undefined") module.exports = GeometryImage;
